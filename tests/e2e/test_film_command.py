"""`reina film`: a film without a window, and what it says where there can be none."""

from __future__ import annotations

import os
import subprocess
import sys
from typing import TYPE_CHECKING

import httpx
import pytest
from tests.e2e.films import decode
from tests.integration.scores import scale, song
from tests.integration.server import serve, upload
from tests.kept import sql

if TYPE_CHECKING:
    from pathlib import Path

    from tests.integration.server import Running

pytestmark = pytest.mark.browser

PROGRAM = "from reina.cli import main; sys.exit(main())"
PATIENCE_S = 300.0
"""Software GL on a busy machine."""


@pytest.fixture
def score(tmp_path: Path) -> Path:
    file = tmp_path / "scale.mid"
    file.write_bytes(scale(8))
    return file


def command(*arguments: str, before: str = "", **environment: str) -> subprocess.CompletedProcess[str]:
    """Run `reina film` as people do: in a process of its own."""
    return subprocess.run(
        [sys.executable, "-c", f"import sys; {before}{PROGRAM}", "film", *arguments],
        env=os.environ | environment,
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )


def refusal(*arguments: str, before: str = "", **environment: str) -> str:
    """The one line that is said."""
    done = command(*arguments, before=before, **environment)
    assert done.returncode == 1, done.stderr
    assert done.stdout == ""
    [line] = done.stderr.splitlines()
    assert line.startswith("reina film: ")
    return line


def test_a_film_of_a_score_and_its_song(score: Path, tmp_path: Path) -> None:
    output, recording = tmp_path / "scale.webm", tmp_path / "scale.wav"
    recording.write_bytes(song(4.0))
    span = ("--fps", "30", "--start", "0:01", "--end", "1.5")
    picture = ("--aspect", "1:1", "--height", "144", "--detail", "low")
    done = command(str(score), "-o", str(output), "--song", str(recording), *span, *picture)
    assert (done.returncode, done.stdout) == (0, f"{output}: 15 frames of 144 × 144, WebM, VP9 and Opus\n"), (
        done.stderr
    )
    assert "frame 15 of 15, 100 %" in done.stderr.splitlines()
    film = decode(output.read_bytes())
    assert film.size == (144, 144)
    assert len(film.pictures) == 15
    assert film.codecs == ("vp9", "opus")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["scale.mid", "scale.wav", "scale.webm"]


def test_a_server_that_runs_is_used_and_left_as_it_was(score: Path, tmp_path: Path) -> None:
    output = tmp_path / "scale.mp4"
    picture = ("--height", "144", "--end", "0.2", "--detail", "low", "--silent")
    with serve(tmp_path / "data") as running:
        kept = upload_one(running)
        done = command(str(score), "-o", str(output), *picture, "--server", running.address)
        assert sql(tmp_path / "data", "SELECT id FROM sessions") == [(kept,)]
    assert done.stdout == f"{output}: 12 frames of 256 × 144, MP4, H.264, silent\n", done.stderr
    assert decode(output.read_bytes()).codecs == ("h264",)


def upload_one(running: Running) -> str:
    """The id of a session that was there before."""
    with httpx.Client(base_url=running.address, timeout=PATIENCE_S) as client:
        return upload(client, scale(8), song=("song.wav", song(4.0))).id


def test_what_the_server_refuses_is_said_in_its_words(score: Path, tmp_path: Path, server: Running) -> None:
    score.write_bytes(b"this is no MIDI file")
    assert "MIDI" in refusal(str(score), "-o", str(tmp_path / "film.mp4"), "--server", server.address)
    assert list(tmp_path.iterdir()) == [score]


def test_what_the_page_refuses_is_said_in_its_words(score: Path, tmp_path: Path, server: Running) -> None:
    output = tmp_path / "film.mp4"
    said = refusal(str(score), "-o", str(output), "--start", "100", "--server", server.address)
    assert "The film begins after the music has ended; the music lasts" in said
    assert list(tmp_path.iterdir()) == [score]


def test_where_no_server_is(score: Path, tmp_path: Path) -> None:
    said = refusal(str(score), "-o", str(tmp_path / "film.mp4"), "--server", "http://127.0.0.1:9")
    assert said == "reina film: no server answers at http://127.0.0.1:9"


def test_without_a_browser(score: Path, tmp_path: Path) -> None:
    said = refusal(str(score), "-o", str(tmp_path / "film.mp4"), REINA_BROWSER=str(tmp_path / "none"))
    assert "REINA_BROWSER" in said


def test_without_playwright(score: Path, tmp_path: Path) -> None:
    missing = "sys.modules['playwright.sync_api'] = None; "
    said = refusal(str(score), "-o", str(tmp_path / "film.mp4"), before=missing)
    assert "Playwright" in said
    assert "`make film` installs it" in said
