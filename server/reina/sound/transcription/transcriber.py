"""Has the notes of recordings found by processes of their own, which a server outlives."""

from __future__ import annotations

import logging
import sys
from typing import TYPE_CHECKING

from reina.errors import InputError
from reina.music import Score
from reina.system.told_process import ToldProcesses

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from reina.sound.transcription.transcribe import Line

PROGRAM = (sys.executable, "-m", "reina.sound.transcription.worker")
TIMEOUT_S = 300.0
"""Ten times what the longest recording takes on a core that nobody else uses."""

log = logging.getLogger(__name__)


class Transcriber:
    """Finds notes, in one recording after the other.

    Args:
        program: What is started, with the recording's path as its argument.
        timeout_s: How long one may take before it is stopped.
    """

    def __init__(self, *, program: Sequence[str] = PROGRAM, timeout_s: float = TIMEOUT_S) -> None:
        self._program = tuple(program)
        self._timeout_s = timeout_s
        self._processes = ToldProcesses(queue="transcriptions", timeout_s=timeout_s)

    async def transcribe(self, song: Path, line: Line, title: str, tell: Callable[[float], None]) -> Score:
        """Find the notes of a recording. Cancelled, it stops the process.

        Args:
            song: The recording's file.
            line: What is looked for.
            title: What the score is called.
            tell: Called with the share that is done, 0..1.

        Raises:
            InputError: As `transcribe` raises it, or it takes too long, or its process ended.
        """
        try:
            told = await self._processes.run((*self._program, str(song)), (line, title), tell)
        except TimeoutError as error:
            detail = f"looking for the notes of the recording took over {self._timeout_s:.0f} s"
            raise InputError(detail) from error
        if isinstance(told, InputError):
            raise told
        if not isinstance(told, Score):
            log.warning("a search for notes ended early")
            raise InputError("the search for the notes of the recording failed")
        return told

    async def aclose(self) -> None:
        """Wait until the processes of searches that were cancelled are gone."""
        await self._processes.aclose()
