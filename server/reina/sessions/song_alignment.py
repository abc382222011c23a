"""A session's song in time with its score: the search for it, what was found, and what people put right."""

from __future__ import annotations

import asyncio
import logging
from typing import TYPE_CHECKING, Literal

from reina.errors import InputError
from reina.protocol.alignment import AlignmentState

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable
    from pathlib import Path

    from reina.music import Score
    from reina.sound.alignment.aligner_process import Aligner
    from reina.sound.alignment.alignment import Alignment

TOLD_STEP = 0.05
"""Progress that is told is so much further than what was told before."""

_log = logging.getLogger(__name__)

Status = Literal["none", "searching", "found", "unlike", "failed"]


class SongAlignment:
    """What is known of where the score is heard in the song.

    Attributes:
        alignment: What was found and put right; None until then.
        progress: Of a search that is under way, 0..1.
        error: Why the last search came to nothing.
        is_heard: Whether the server can listen to the song; what is known of one that it cannot is by hand.
    """

    def __init__(self, alignment: Alignment | None = None, *, is_heard: bool = True) -> None:
        self.alignment = alignment
        self.is_heard = is_heard
        self.elsewhere: float | None = None
        """How far another server's search is, 0..1; None where there is none."""
        self.progress = 0.0
        self.error: str | None = None
        self._search: asyncio.Task[None] | None = None

    @property
    def is_searching(self) -> bool:
        """Whether a search is under way."""
        return self._search is not None and not self._search.done()

    def state(self) -> AlignmentState:
        """What viewers are told of it."""
        found = self.alignment
        status: Status = "none"
        if self.is_searching or self.elsewhere is not None:
            status = "searching"
        elif found is not None and (found.is_same_music or self.is_heard):
            status = "found" if found.is_same_music else "unlike"
        elif self.error is not None:
            status = "failed"
        return AlignmentState(
            status=status,
            progress=self._progress(),
            confidence=None if found is None else round(found.confidence, 3),
            detail=self.error,
        )

    def _progress(self) -> float:
        if self.is_searching:
            return self.progress
        return float(self.alignment is not None) if self.elsewhere is None else self.elsewhere

    def search(
        self,
        aligner: Aligner,
        song: Callable[[], Path],
        score: Score,
        *,
        found: Callable[[Alignment], Awaitable[None]],
        tell: Callable[[], None],
    ) -> None:
        """Look for the score in the song, in the background; a search that is under way is given up.

        Args:
            aligner: Does it.
            song: Where the recording is; called on a thread.
            score: As it is written.
            found: Called with what was found.
            tell: Called when there is more to tell: progress, and the end.
        """
        self.close()
        self.progress, self.error = 0.0, None
        told = 0.0

        def follow(share: float) -> None:
            nonlocal told
            self.progress = share
            if share >= told + TOLD_STEP:
                told = share
                tell()

        async def run() -> None:
            try:
                await found(await aligner.align(await asyncio.to_thread(song), score, follow))
            except InputError as error:
                self.error = str(error)

        self._search = asyncio.create_task(run())
        self._search.add_done_callback(lambda task: None if task.cancelled() else tell())

    def close(self) -> None:
        """Give up a search that is under way."""
        if self._search is not None:
            self._search.cancel()
            # What ended it holds where it was, and that holds this.
            self._search = None
