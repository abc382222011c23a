"""A session's song: uploaded, or rendered from the score."""

from __future__ import annotations

import asyncio
import logging
from typing import TYPE_CHECKING, Literal

from reina.errors import InputError
from reina.protocol.messages import SongState
from reina.sound.renderer import SONG_MEDIA_TYPE, SongRenderer, SongRequest, SoundError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from reina.music import Score
    from reina.sessions.record import SongRecord
    from reina.sound.plan import PlayedParts

_log = logging.getLogger(__name__)


class UploadedSong:
    """A song that came with the score."""

    source: Literal["uploaded", "rendered"] = "uploaded"
    error: str | None = None

    def __init__(self, folder: Path, record: SongRecord) -> None:
        self.path: Path | None = folder / record.file
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
        ready: Callable[[], None],
    ) -> None:
        self.path: Path | None = None
        self.error: str | None = None
        self._request: SongRequest | None = None
        self._making = asyncio.create_task(self._make(renderer, score, played, ready))

    @property
    def progress(self) -> float:
        """Share of the work that is done, 0 to 1."""
        return self._request.progress if self._request else 0.0

    def close(self) -> None:
        """Give it up, unless it is there."""
        self._making.cancel()

    async def _make(
        self, renderer: SongRenderer, score: Score, played: Sequence[PlayedParts], ready: Callable[[], None]
    ) -> None:
        try:
            self._request = await renderer.request(score, played)
            self.path = await self._request.wait()
        except (SoundError, InputError) as error:
            self.error = str(error)
            _log.warning("no song for the score %r: %s", score.title, error)
        except asyncio.CancelledError:
            if self._request:
                self._request.cancel()
            raise
        except Exception as error:
            # Whoever waits for the song is to hear that there will be none, whatever went wrong.
            self.error = "the server made a mistake while it planned the sound, and has noted it"
            _log.error("no song for the score %r: %r", score.title, error)
        ready()


Song = UploadedSong | RenderedSong


def song_state(song: Song, href: str) -> SongState:
    """What the wire says of a song."""
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
    )
