"""A song that cannot be made is told as one, whatever went wrong."""

import asyncio
from pathlib import Path

import pytest
from tests.unit.sound.material import a_score

from reina.sessions.song import RenderedSong, song_state
from reina.sound.plan import PlayedParts
from reina.sound.renderer import SongRenderer, SoundError


@pytest.mark.parametrize(
    ("fault", "told"),
    [
        (SoundError("the soundfont is none"), "the soundfont is none"),
        (OverflowError("int too big to convert"), "the server made a mistake"),
        (OSError(28, "No space left on device"), "the server made a mistake"),
    ],
)
def test_any_failure_is_told_as_one(
    fault: Exception, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    score = a_score([(0, 0.0, 1.0, 60, 0.8)])

    async def fail(*_: object, **__: object) -> None:
        raise fault

    monkeypatch.setattr(SongRenderer, "request", fail)

    async def make() -> RenderedSong:
        heard = asyncio.Event()
        parts = [PlayedParts((0,))]
        song = RenderedSong(SongRenderer(tmp_path), score, parts, owner="somebody", ready=heard.set)
        await asyncio.wait_for(heard.wait(), 10)
        return song

    song = asyncio.run(make())
    assert song.error is not None
    assert told in song.error
    assert song_state(song, "/song", "/song/segments").status == "failed"
