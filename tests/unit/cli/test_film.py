"""`reina film`'s arguments and its words on the terminal; the films themselves are made in tests/e2e."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

import pytest

from reina.cli import main
from reina.cli.film_progress import FilmProgress
from reina.cli.progress_line import length_of_time

if TYPE_CHECKING:
    from pathlib import Path


@pytest.fixture
def score(tmp_path: Path) -> Path:
    file = tmp_path / "score.mid"
    file.write_bytes(b"")
    return file


@pytest.mark.parametrize(
    ("output", "arguments", "why"),
    [
        ("film.avi", (), "a film's file ends with .mp4 or .webm"),
        ("film", (), "a film's file ends with .mp4 or .webm"),
        ("nowhere/film.mp4", (), "there is no folder"),
        ("film.mp4", ("--start", "2", "--end", "1.5"), "the film ends at 1.5 s, not after its start at 2 s"),
        ("film.mp4", ("--song", "missing.wav"), "missing.wav: No such file or directory"),
    ],
)
def test_what_cannot_be_is_said_before_anything_is_started(
    score: Path, output: str, arguments: tuple[str, ...], why: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["film", str(score), "-o", str(score.parent / output), *arguments]) == 1
    said = capsys.readouterr()
    assert said.out == ""
    [line] = said.err.splitlines()
    assert line.startswith("reina film: ")
    assert why in line


@pytest.mark.parametrize(
    ("arguments", "why"),
    [
        (("--height", "143"), "'143' is no even number from 144 to 2160"),
        (("--height", "145"), "'145' is no even number"),
        (("--height", "tall"), "'tall' is no even number"),
        (("--height", "4320"), "'4320' is no even number"),
        (("--start", "-1"), "'-1' is no time as 62.5 or 1:02.5"),
        (("--start", "1:2:3"), "'1:2:3' is no time as 62.5 or 1:02.5"),
        (("--end", "nan"), "'nan' is no time"),
        (("--fps", "25"), "invalid choice: 25"),
        (("--aspect", "4:3"), "invalid choice: '4:3'"),
        (("--server", "localhost"), "'localhost' is no address as http://localhost:8000"),
    ],
)
def test_arguments_that_are_none(
    score: Path, arguments: tuple[str, ...], why: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["film", str(score), "-o", "film.mp4", *arguments])
    assert ended.value.code == 2
    assert why in capsys.readouterr().err


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_progress_is_a_line_a_tenth_in_a_file_and_one_line_on_a_terminal() -> None:
    lines, terminal = io.StringIO(), Terminal()
    for out in (lines, terminal):
        progress = FilmProgress(out)
        progress.tell("sound", 0.5, 100, None)
        for done in range(1, 101):
            progress.tell("pictures", done, 100, (100 - done) / 2)
        progress.tell("closing", 100, 100, None)
        progress.end()
    said = lines.getvalue().splitlines()
    assert said[:3] == [
        "the sound is made",
        "frame 1 of 100, 1 %, 0:50 left",
        "frame 10 of 100, 10 %, 0:45 left",
    ]
    assert said[-2:] == ["frame 100 of 100, 100 %", "the file is closed"]
    assert len(said) == 13
    assert "\n" not in terminal.getvalue()
    assert "frame 57 of 100, 57 %, 0:22 left" in terminal.getvalue()


def test_lengths_of_time() -> None:
    assert [length_of_time(seconds) for seconds in (0.4, 45, 723, 3730)] == [
        "0:00",
        "0:45",
        "12:03",
        "1:02:10",
    ]
