"""Has recordings put in time with their scores by processes of their own, which a server outlives."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import sys
from typing import TYPE_CHECKING

from reina.errors import InputError
from reina.sound.alignment.alignment import Alignment
from reina.system.cluster import AwayError
from reina.system.told_process import ToldProcesses

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from reina.music import Score
    from reina.system.elsewhere import Elsewhere

PROGRAM = (sys.executable, "-m", "reina.sound.alignment.worker")
ELSEWHERE = "reina.sound.alignment.worker:align_recording"
TIMEOUT_S = 600.0
"""Ten times what an hour of music takes on a core that nobody else uses."""
MAX_AT_ONCE = 1

log = logging.getLogger(__name__)


class Aligner:
    """Aligns recordings, one after the other.

    Args:
        program: What is started, with the recording's path as its argument.
        timeout_s: How long one may take before it is stopped.
        most_at_once: How many run at once; others wait for their turn.
        elsewhere: Where it is done while somebody is there; in processes of this machine when None.
    """

    def __init__(
        self,
        *,
        program: Sequence[str] = PROGRAM,
        timeout_s: float = TIMEOUT_S,
        most_at_once: int = MAX_AT_ONCE,
        elsewhere: Elsewhere | None = None,
    ) -> None:
        self._elsewhere = elsewhere
        self._program = tuple(program)
        self._timeout_s = timeout_s
        self._processes = ToldProcesses(queue="alignments", timeout_s=timeout_s, most_at_once=most_at_once)

    async def align(self, song: Path, score: Score, tell: Callable[[float], None]) -> Alignment:
        """Find where a score is heard in a recording. Cancelled, it stops the process.

        Args:
            song: The recording's file.
            score: What is played in it.
            tell: Called with the share that is done, 0..1.

        Raises:
            InputError: The recording cannot be decoded, or it takes too long, or its process ended.
        """
        try:
            told = await self._told(song, score, tell)
        except TimeoutError as error:
            detail = f"looking for the music in the recording took over {self._timeout_s:.0f} s"
            raise InputError(detail) from error
        if isinstance(told, InputError):
            raise told
        if not isinstance(told, Alignment):
            log.warning("an aligner ended early")
            raise InputError("the search for the music in the recording failed")
        return told

    async def _told(self, song: Path, score: Score, tell: Callable[[float], None]) -> object:
        if self._elsewhere is not None:
            with contextlib.suppress(AwayError):
                data = await asyncio.to_thread(song.read_bytes)
                return await self._elsewhere.run(ELSEWHERE, data, score, tell=tell, timeout_s=self._timeout_s)
        return await self._processes.run((*self._program, str(song)), score, tell)

    async def aclose(self) -> None:
        """Wait until the processes of searches that were cancelled are gone."""
        await self._processes.aclose()
