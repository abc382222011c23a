"""`reina inspect --cast`."""

import json
from pathlib import Path

import pytest

from reina.cli import main

DUET = str(Path(__file__).parents[3] / "examples" / "scores" / "trumpet-duet.mid")


def output(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    assert main(["inspect", DUET, *arguments]) == 0
    printed = capsys.readouterr()
    assert printed.err == ""
    return printed.out


def test_tables_of_each_player(capsys: pytest.CaptureFixture[str]) -> None:
    lines = output(capsys, "--cast", "auto").splitlines()
    assert "Cast, as the score asks for it" in lines
    assert any("soloist" in line and "Trumpet 2" in line and "108 of 108" in line for line in lines)
    assert any("no player for church organ yet" in line for line in lines)
    first, second = lines.index("Player 1: part 0"), lines.index("Player 2: part 1")
    assert "Fingerings of part 0, transposed by 0" in lines[first:second]
    assert "Fingerings of part 1, transposed by 0" in lines[second:]


def test_json_and_a_cast_from_a_file(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    asked = {"castings": [{"part": 1, "instrument": "cornet", "octave_fit": True}, {"part": 0}]}
    file = tmp_path / "cast.json"
    file.write_text(json.dumps(asked))
    for cast in (str(file), json.dumps(asked)):
        described = json.loads(output(capsys, "--json", "--cast", cast))
        assert described["auto"] is False
        assert [one["instrument"] for one in described["castings"]] == ["cornet", "trumpet"]
        notes = described["castings"][0]["played_notes"]
        assert len(notes) == 108
        assert {note["part"] for note in notes} == {1}
        assert described["castings"][0]["warnings"] == []


@pytest.mark.parametrize(
    ("cast", "told"),
    [
        ("{}", "castings: Field required"),
        ('{"castings": [{"hand": 1}]}', "castings/0/hand: Extra inputs are not permitted"),
        ('{"cast": "best"}', "cast: Input should be 'auto'"),
        ("{", "the cast is no JSON"),
        ("/nowhere/cast.json", "the cast /nowhere/cast.json: No such file or directory"),
        ('{"castings": [{"part": 9}]}', "part: there is no part 9"),
        ('{"castings": [{"seat": "moon"}]}', "there is no seat 'moon'"),
    ],
)
def test_a_cast_that_cannot_play_is_told(capsys: pytest.CaptureFixture[str], cast: str, told: str) -> None:
    assert main(["inspect", DUET, "--cast", cast]) == 1
    assert told in capsys.readouterr().err


def test_a_cast_and_what_one_player_plays_is_too_much(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["inspect", DUET, "--cast", "auto", "--part", "1", "--octave-fit"]) == 1
    assert "leave out --part, --octave-fit" in capsys.readouterr().err
