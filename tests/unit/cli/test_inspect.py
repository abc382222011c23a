"""`reina inspect`."""

import gzip
import json
import subprocess
import sys
from pathlib import Path

import pytest
from tests.unit.music.midi_bytes import midi, name, off, on

from reina.cli import main

SCORES = Path(__file__).parents[3] / "examples" / "scores"
MARCH = SCORES / "prince-of-denmarks-march.mid"


def output(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    assert main(["inspect", *arguments]) == 0
    printed = capsys.readouterr()
    assert printed.err == ""
    return printed.out


def test_tables(capsys: pytest.CaptureFixture[str]):
    text = output(capsys, str(MARCH))
    lines = text.splitlines()
    assert lines[0] == "Prince of Denmark's March  1:09.31  503 notes"
    assert "Tempo" in lines
    assert "  0      0.000   112.00" in lines
    assert "  0     4/4" in lines
    assert any(
        line.startswith("  ▶  0     Trumpet  56") and "named “Trumpet” (+6.0)" in line for line in lines
    )
    assert "Warnings: none" in lines
    first = lines.index("Fingerings of part 0, transposed by 0") + 2
    assert lines[first].split() == [
        "1",
        "0",
        "0.000",
        "0.985",
        "E5",
        "D5",
        "○",
        "○",
        "○",
        "open:",
        "usual",
        "for",
        "written",
        "E5",
    ]
    assert "2-3: usual for written G♯5" in lines[first + 1]
    assert "○ ● ●" in lines[first + 1]


def test_json(capsys: pytest.CaptureFixture[str]):
    described = json.loads(output(capsys, str(MARCH), "--json"))
    assert described["title"] == "Prince of Denmark's March"
    assert len(described["notes"]) == 503
    assert described["notes"][0].keys() >= {
        "part",
        "onset_s",
        "onset_beats",
        "written_pitch",
        "valves",
        "reason",
    }
    assert [part["index"] for part in described["parts"]] == [0, 1, 2, 3]


def test_another_part_and_transposition(capsys: pytest.CaptureFixture[str]):
    described = json.loads(
        output(capsys, str(MARCH), "--json", "--part", "2", "--transposition", "12", "--octave-fit")
    )
    assert (described["part"], described["transposition"]) == (2, 24)
    assert "octave_fit" in {warning["kind"] for warning in described["warnings"]}
    written = json.loads(output(capsys, str(MARCH), "--json", "--written"))
    assert written["transposition"] == -2


def test_joined_parts(capsys: pytest.CaptureFixture[str]):
    described = json.loads(output(capsys, str(MARCH), "--json", "--part", "1", "--joined-parts", "2,0"))
    assert (described["part"], described["joined_parts"]) == (1, [0, 2])
    others = [note for note in described["notes"] if note["reason"] == "nobody plays this part"]
    assert {note["part"] for note in others} == {3}
    lines = output(capsys, str(MARCH), "--joined-parts", "1").splitlines()
    assert "Fingerings of parts 0, 1, transposed by 0" in lines
    assert [line[2] for line in lines if line[2:3] in ("▶", "+")] == ["▶", "+"]


def test_joined_parts_that_cannot_be_are_refused(capsys: pytest.CaptureFixture[str]):
    assert main(["inspect", str(MARCH), "--joined-parts", "1,9"]) == 1
    told = "joined_parts/1: there is no part 9; parts that can be joined to part 0: 1 to 3"
    assert capsys.readouterr().err.endswith(f"{told}\n")
    with pytest.raises(SystemExit):
        main(["inspect", str(MARCH), "--joined-parts", "1;2"])
    assert "'1;2' is no list of parts as 1,2" in capsys.readouterr().err


def test_another_instrument(capsys: pytest.CaptureFixture[str]):
    described = json.loads(output(capsys, str(MARCH), "--json", "--instrument", "tuba"))
    assert described["instrument"] == "tuba"
    assert described["part"] == 2


def test_warnings_and_sequences(capsys: pytest.CaptureFixture[str], tmp_path: Path):
    path = tmp_path / "two.mid"
    path.write_bytes(midi((name("A"), on(0, 60), off(480, 60)), (name("B"), on(0, 30), on(480, 30)), form=2))
    text = output(capsys, str(path), "--sequence", "1")
    assert "sequence 1 of 2" in text
    assert "unreleased_note" in text
    assert "F♯1 lies below the lowest note" in text
    assert " –  " in text


def test_a_compressed_score(capsys: pytest.CaptureFixture[str], tmp_path: Path):
    path = tmp_path / "Call.mid.gz"
    path.write_bytes(gzip.compress(midi((on(0, 60), off(480, 60)))))
    assert main(["inspect", str(path)]) == 0
    text = capsys.readouterr().out
    assert text.startswith("Call  0:00.50  1 notes")
    assert "a gzip'd file was unpacked" in text


def test_a_score_of_many_bars(capsys: pytest.CaptureFixture[str]):
    text = output(capsys, str(SCORES / "taps.mid"))
    assert "  0    0     0.000" in text


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (None, "No such file"),
        (b"", "empty"),
        (b"nonsense", "no MIDI file"),
        (b'{"parts": []}', "format: field required"),
    ],
)
def test_what_cannot_be_read(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, content: bytes | None, why: str
):
    path = tmp_path / "score.mid"
    if content is not None:
        path.write_bytes(content)
    assert main(["inspect", str(path)]) == 1
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith(f"reina inspect: {path}: ")
    assert why in printed.err
    assert len(printed.err.splitlines()) == 1


def test_a_part_that_is_not_there(capsys: pytest.CaptureFixture[str]):
    assert main(["inspect", str(MARCH), "--part", "9"]) == 1
    assert "there is no part 9; there are 0 to 3" in capsys.readouterr().err


def test_commands_are_listed(capsys: pytest.CaptureFixture[str]):
    with pytest.raises(SystemExit) as ended:
        main(["--help"])
    assert ended.value.code == 0
    assert {"serve", "inspect"} <= set(capsys.readouterr().out.split())
    with pytest.raises(SystemExit) as ended:
        main([])
    assert ended.value.code == 2


def test_a_reader_may_stop_reading():
    program = "from reina.cli import main; raise SystemExit(main())"
    command = [sys.executable, "-c", program, "inspect", str(MARCH), "--json"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        assert process.stdout.read(1) == b"{"
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == 0


def on_drums(*keys: int) -> list[tuple[int, bytes]]:
    """A beat of keys that are struck at once."""
    begun = [on(0, key, channel=9) for key in keys]
    return [*begun, off(480, keys[0], channel=9), *(off(0, key, channel=9) for key in keys[1:])]


def test_drums_alone_are_played_on_the_kit(capsys: pytest.CaptureFixture[str], tmp_path: Path):
    path = tmp_path / "groove.mid"
    path.write_bytes(midi((*on_drums(36, 42), *on_drums(38, 42))))
    described = json.loads(output(capsys, str(path), "--json"))
    assert (described["instrument"], described["further_players"]) == ("drums", [])
    assert {note["fingering"]["piece"] for note in described["notes"]} == {"kick", "snare", "hi_hat"}
    lines = output(capsys, str(path)).splitlines()
    assert "Parts, the best for drums first" in lines
    assert any(line.startswith("  1    0     0.000") and "right foot" in line for line in lines)


def test_every_player_of_a_band_is_told_unless_one_is_asked_for(capsys: pytest.CaptureFixture[str]):
    band = str(SCORES / "when-the-saints.mid")
    lines = output(capsys, band).splitlines()
    assert "Fingerings of part 0, transposed by 0" in lines
    assert "Player 2: drum kit, part 3" in lines
    assert "Fingerings of part 3, transposed by 0" in lines
    described = json.loads(output(capsys, band, "--json"))
    (drummer,) = described["further_players"]
    assert (described["instrument"], drummer["instrument"], drummer["part"]) == ("trumpet", "drums", 3)
    assert drummer["warnings"] == []
    for asked in (("--instrument", "trumpet"), ("--transposition", "2"), ("--part", "0")):
        assert json.loads(output(capsys, band, "--json", *asked))["further_players"] == []
    assert json.loads(output(capsys, band, "--json", "--part", "3"))["instrument"] == "drums"


def test_who_leads_with_the_left_hand(capsys: pytest.CaptureFixture[str]):
    saints = str(MARCH.with_name("when-the-saints.mid"))
    described = json.loads(output(capsys, saints, "--json", "--instrument", "drums", "--handedness", "left"))
    struck = [note["fingering"] for note in described["notes"] if note["fingering"]]
    assert {one["hand"] for one in struck if one["piece"] == "ride"} == {"left"}
    assert main(["inspect", saints, "--handedness", "left"]) == 1
    assert "the B♭ trumpet is played right-handed, not left-handed" in capsys.readouterr().err
