"""`reina film`: a film without a window, and what it says where there can be none."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import pytest
from tests.e2e.films import decode
from tests.integration.scores import scale, song

from reina.cli import main

if TYPE_CHECKING:
    from pathlib import Path

    from tests.integration.server import Running

pytestmark = pytest.mark.browser


@pytest.fixture
def score(tmp_path: Path) -> Path:
    file = tmp_path / "scale.mid"
    file.write_bytes(scale(8))
    return file


def test_a_film_of_a_score_and_its_song(
    score: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    output, recording = tmp_path / "scale.webm", tmp_path / "scale.wav"
    recording.write_bytes(song(4.0))
    arguments = ["--aspect", "1:1", "--height", "144", "--fps", "30", "--start", "0:01", "--end", "1.5"]
    assert (
        main(["film", str(score), "-o", str(output), "--song", str(recording), "--detail", "low", *arguments])
        == 0
    )
    said = capsys.readouterr()
    assert said.out == f"{output}: 15 frames of 144 × 144, WebM, VP9 and Opus\n"
    assert "frame 15 of 15, 100 %" in said.err.splitlines()
    film = decode(output.read_bytes())
    assert film.size == (144, 144)
    assert len(film.pictures) == 15
    assert film.codecs == ("vp9", "opus")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["scale.mid", "scale.wav", "scale.webm"]


def test_a_server_that_runs_is_used_and_left_as_it_was(
    score: Path, tmp_path: Path, server: Running, capsys: pytest.CaptureFixture[str]
) -> None:
    output = tmp_path / "scale.mp4"
    arguments = ["--height", "144", "--end", "0.2", "--detail", "low", "--silent", "--server", server.address]
    assert main(["film", str(score), "-o", str(output), *arguments]) == 0
    assert "12 frames of 256 × 144, MP4, H.264, silent" in capsys.readouterr().out
    assert decode(output.read_bytes()).codecs == ("h264",)


def refusal(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    """The last line that is said."""
    assert main(["film", *arguments]) == 1
    line = capsys.readouterr().err.splitlines()[-1]
    assert line.startswith("reina film: ")
    return line


def test_what_the_server_refuses_is_said_in_its_words(
    score: Path, tmp_path: Path, server: Running, capsys: pytest.CaptureFixture[str]
) -> None:
    score.write_bytes(b"this is no MIDI file")
    output = tmp_path / "film.mp4"
    assert "MIDI" in refusal(capsys, str(score), "-o", str(output), "--server", server.address)
    assert not output.exists()


def test_what_the_page_refuses_is_said_in_its_words(
    score: Path, tmp_path: Path, server: Running, capsys: pytest.CaptureFixture[str]
) -> None:
    output = tmp_path / "film.mp4"
    said = refusal(capsys, str(score), "-o", str(output), "--start", "100", "--server", server.address)
    assert "The film begins after the music has ended; the music lasts" in said
    assert list(tmp_path.iterdir()) == [score]


def test_where_no_server_is(score: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    said = refusal(capsys, str(score), "-o", str(tmp_path / "film.mp4"), "--server", "http://127.0.0.1:9")
    assert said == "reina film: no server answers at http://127.0.0.1:9"


def test_without_a_browser(
    score: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("REINA_BROWSER", str(tmp_path / "none"))
    assert "REINA_BROWSER" in refusal(capsys, str(score), "-o", str(tmp_path / "film.mp4"))


def test_without_playwright(
    score: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "playwright.sync_api", None)
    said = refusal(capsys, str(score), "-o", str(tmp_path / "film.mp4"))
    assert "Playwright" in said
    assert "make film" in said
