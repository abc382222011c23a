"""Songs that are rendered, and recordings that are listened to, on a cluster, which is this process here."""

from __future__ import annotations

import asyncio
from importlib import import_module
from typing import TYPE_CHECKING, Any

import pytest
from tests.unit.sound.material import a_score, write_click_soundfont

from reina.errors import InputError
from reina.sound.alignment.aligner_process import Aligner
from reina.sound.renderer import SongRenderer, SoundError
from reina.system.cluster import AwayError, LostError

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from reina.sound.alignment import Alignment

SHORT = a_score([(0, 0.5, 0.15, 60, 1.0), (0, 1.25, 0.15, 60, 1.0)])


class ThisProcess:
    """An `Elsewhere` that does the work itself, or is away, or loses it."""

    def __init__(self, error: Exception | None = None) -> None:
        self._error = error
        self.asked: list[str] = []
        self.shares: list[float] = []

    async def run(
        self, place: str, *arguments: object, tell: Callable[[float], None], timeout_s: float
    ) -> Any:
        self.asked.append(place)
        if self._error is not None:
            raise self._error

        def told(share: float) -> None:
            self.shares.append(share)
            tell(share)

        module, _, function = place.partition(":")
        return await asyncio.to_thread(getattr(import_module(module), function), *arguments, told)


@pytest.fixture
def soundfont(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """That of the server and of its workers."""
    path = write_click_soundfont(tmp_path / "click.sf2")
    monkeypatch.setenv("REINA_SOUNDFONT", str(path))
    return path


def song(data_dir: Path, soundfont: Path, elsewhere: ThisProcess | None) -> dict[str, bytes]:
    """The files of a song."""

    async def made() -> Path:
        there: Any = elsewhere
        renderer = SongRenderer(data_dir, soundfont=soundfont, elsewhere=there)
        try:
            request = await renderer.request(SHORT)
            path = await request.wait()
            assert request.progress == 1
            assert await request.segment(0, within_s=1) is not None
            return path
        finally:
            await renderer.aclose()

    return {path.name: path.read_bytes() for path in asyncio.run(made()).parent.iterdir()}


def test_a_song_that_is_made_elsewhere_is_the_same(tmp_path: Path, soundfont: Path) -> None:
    there = ThisProcess()
    made, own = song(tmp_path / "there", soundfont, there), song(tmp_path / "here", soundfont, None)
    assert there.asked == ["reina.sound.render_elsewhere:render_files"]
    assert there.shares == sorted(there.shares)
    assert 0 < there.shares[0] < 1
    assert made.keys() == own.keys() == {"song.flac", "song.peaks", "0.opus"}
    assert made["song.flac"] == own["song.flac"]
    assert made["song.peaks"] == own["song.peaks"]


def test_where_nobody_is_there_it_is_made_here(tmp_path: Path, soundfont: Path) -> None:
    away = ThisProcess(AwayError("nobody"))
    assert song(tmp_path, soundfont, away).keys() == {"song.flac", "song.peaks", "0.opus"}
    assert len(away.asked) == 1


def test_a_worker_with_another_soundfont_is_nobody(
    tmp_path: Path, soundfont: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    other = write_click_soundfont(tmp_path / "other.sf2")
    other.write_bytes(other.read_bytes() + b"\0\0")
    monkeypatch.setenv("REINA_SOUNDFONT", str(other))
    there = ThisProcess()
    assert song(tmp_path / "data", soundfont, there).keys() == {"song.flac", "song.peaks", "0.opus"}
    assert there.shares == []


def test_what_ends_every_worker_has_no_sound_and_leaves_nothing(tmp_path: Path, soundfont: Path) -> None:
    with pytest.raises(SoundError, match="every process that worked at it ended"):
        song(tmp_path / "data", soundfont, ThisProcess(LostError("every process that worked at it ended")))
    assert not list((tmp_path / "data" / "songs").iterdir())


def aligned(path: Path, elsewhere: ThisProcess, heard: list[float]) -> Alignment:
    async def found() -> Alignment:
        there: Any = elsewhere
        aligner = Aligner(elsewhere=there)
        try:
            return await aligner.align(path, SHORT, heard.append)
        finally:
            await aligner.aclose()

    return asyncio.run(found())


def test_a_recording_is_listened_to_elsewhere_and_here_where_nobody_is_there(
    tmp_path: Path, soundfont: Path
) -> None:
    path = tmp_path / "song.flac"
    path.write_bytes(song(tmp_path / "data", soundfont, None)["song.flac"])
    there, heard = ThisProcess(), list[float]()
    found = aligned(path, there, heard)
    assert there.asked == ["reina.sound.alignment.worker:align_recording"]
    assert heard == there.shares != []
    assert aligned(path, ThisProcess(AwayError("nobody")), []) == found


def test_what_is_no_recording_is_refused_from_elsewhere_too(tmp_path: Path) -> None:
    path = tmp_path / "song.wav"
    path.write_bytes(b"RIFF and nothing else")
    there = ThisProcess()
    with pytest.raises(InputError):
        aligned(path, there, [])
    assert len(there.asked) == 1
