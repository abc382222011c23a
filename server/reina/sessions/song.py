"""A session's song: uploaded, or rendered from the score."""

from __future__ import annotations

import asyncio
import logging
from typing import TYPE_CHECKING, Literal

from reina.errors import InputError
from reina.protocol.messages import SongSegments, SongState
from reina.sound.encode import SEGMENT_MEDIA_TYPE, SONG_MEDIA_TYPE
from reina.sound.events import SAMPLE_RATE
from reina.sound.hearing import AS_WRITTEN
from reina.sound.renderer import NoRoomError, SongRenderer, SongRequest, SoundError
from reina.sound.segments import OVERLAP, SEGMENT

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from reina.music import Score
    from reina.sessions.record import SongRecord
    from reina.sound.hearing import Hearing
    from reina.sound.plan import PlayedParts

ROOM_LOOKED_FOR_S = 2.0
"""How often it is looked whether there is room for a song, where there was none."""

_log = logging.getLogger(__name__)


class UploadedSong:
    """A song that came with the score.

    Args:
        path: Its file.
        record: What is known of it.
    """

    source: Literal["uploaded", "rendered"] = "uploaded"
    error: str | None = None
    lacks_room = False
    request: SongRequest | None = None

    def __init__(self, path: Path, record: SongRecord) -> None:
        self.path: Path | None = path
        self.media_type = record.media_type
        self.duration_s = record.duration_s
        self.progress = 1.0

    def close(self) -> None:
        """Nothing is under way."""


class RenderedSong:
    """A song that the server makes from the score, in the background.

    Args:
        renderer: Makes it.
        score: From this.
        played: What the players play.
        hearing: What of it is to be heard.
        owner: For whom; renderings go round by owner.
        ready: Called when it can be fetched, or has failed.
    """

    source: Literal["uploaded", "rendered"] = "rendered"
    media_type = SONG_MEDIA_TYPE
    duration_s: float | None = None

    def __init__(
        self,
        renderer: SongRenderer,
        score: Score,
        played: Sequence[PlayedParts],
        *,
        hearing: Hearing = AS_WRITTEN,
        owner: str,
        ready: Callable[[], None],
    ) -> None:
        self.path: Path | None = None
        self.error: str | None = None
        self.lacks_room = False
        """Whether there will be one once there is room on the disk: the error is only for now."""
        self.request: SongRequest | None = None
        """What is there of it; None until it is planned."""
        self._making: asyncio.Task[None] | None = asyncio.create_task(
            self._make(renderer, score, played, hearing, owner, ready)
        )

    @property
    def progress(self) -> float:
        """Share of the work that is done, 0 to 1."""
        return self.request.progress if self.request else 0.0

    def close(self) -> None:
        """Give it up, unless it is there."""
        if self._making is not None:
            self._making.cancel()
            # What ended it holds where it was, and that holds this.
            self._making = None

    async def _make(
        self,
        renderer: SongRenderer,
        score: Score,
        played: Sequence[PlayedParts],
        hearing: Hearing,
        owner: str,
        ready: Callable[[], None],
    ) -> None:
        try:
            while self.path is None:
                try:
                    self.request = await renderer.request(score, played, hearing, owner=owner)
                    self.path = await self.request.wait()
                except NoRoomError as error:
                    await self._wait_for_room(renderer, str(error), ready)
        except (SoundError, InputError) as error:
            self.error = str(error)
            _log.warning("no song for a score: %s", error)
        except asyncio.CancelledError:
            if self.request:
                self.request.cancel()
            raise
        except Exception as error:
            # Whoever waits for the song is to hear that there will be none, whatever went wrong.
            self.error = "the server made a mistake while it planned the sound, and has noted it"
            _log.error("no song for a score", exc_info=error)
        ready()

    async def _wait_for_room(self, renderer: SongRenderer, why: str, ready: Callable[[], None]) -> None:
        """Say that there is no sound for now, and wait until there may be."""
        self.error, self.lacks_room = why, True
        ready()
        _log.warning("no song for now: %s", why)
        has_room = False
        while not has_room:
            await asyncio.sleep(ROOM_LOOKED_FOR_S)
            has_room = await asyncio.to_thread(renderer.has_room)
        self.error, self.lacks_room = None, False


Song = UploadedSong | RenderedSong


def song_state(song: Song, href: str, segments_href: str) -> SongState:
    """What the wire says of a song.

    Args:
        song: The song.
        href: Where the whole of it is.
        segments_href: Below which its segments are, whatever the rendering.
    """
    status: Literal["ready", "rendering", "failed"] = "rendering"
    if song.error is not None:
        status = "failed"
    elif song.path is not None:
        status = "ready"
    return SongState(
        href=href,
        status=status,
        source=song.source,
        media_type=song.media_type,
        progress=1.0 if status == "ready" else min(song.progress, 0.99),
        segments=None if song.request is None else _segments(song.request, segments_href),
    )


def _segments(request: SongRequest, segments_href: str) -> SongSegments:
    return SongSegments(
        href=f"{segments_href}/{request.rendering_id}",
        media_type=SEGMENT_MEDIA_TYPE,
        count=request.segments.count,
        segment_s=SEGMENT / SAMPLE_RATE,
        overlap_s=OVERLAP / SAMPLE_RATE,
        song_s=request.segments.frames / SAMPLE_RATE,
    )
