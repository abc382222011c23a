"""A song that cannot be made is told as one, whatever went wrong; what only lacks room is made later."""

import asyncio
from pathlib import Path

import pytest
from tests.unit.sound.material import a_score

from reina.sessions import song as song_module
from reina.sessions.song import RenderedSong, song_state
from reina.sound.plan import PlayedParts
from reina.sound.renderer import NoRoomError, SongRenderer, SoundError


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


def test_a_song_that_finds_no_room_is_made_once_there_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = tmp_path / "song.flac"
    looks = [False, False, True]
    room_is_there: list[bool] = []
    told: list[tuple[str | None, bool]] = []

    class Request:
        async def wait(self) -> Path:
            if not room_is_there:
                raise NoRoomError
            return made

    async def request(*_: object, **__: object) -> Request:
        return Request()

    monkeypatch.setattr(SongRenderer, "request", request)

    def has_room(_: SongRenderer) -> bool:
        if looks[0]:
            room_is_there.append(True)
        return looks.pop(0)

    monkeypatch.setattr(SongRenderer, "has_room", has_room)
    monkeypatch.setattr(song_module, "ROOM_LOOKED_FOR_S", 0.0)

    async def make() -> RenderedSong:
        heard = asyncio.Event()

        def ready() -> None:
            told.append((song.error, song.lacks_room))
            if song.path is not None:
                heard.set()

        score = a_score([(0, 0.0, 1.0, 60, 0.8)])
        song = RenderedSong(SongRenderer(tmp_path), score, [PlayedParts((0,))], owner="somebody", ready=ready)
        await asyncio.wait_for(heard.wait(), 10)
        return song

    song = asyncio.run(make())
    assert song.path == made
    assert looks == []
    assert told == [(str(NoRoomError()), True), (None, False)]
