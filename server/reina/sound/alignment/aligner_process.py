"""Has recordings put in time with their scores by processes of their own, which a server outlives."""

from __future__ import annotations

import asyncio
import logging
import subprocess
import sys
from typing import TYPE_CHECKING, cast

from reina.errors import InputError
from reina.sound.alignment.alignment import Alignment
from reina.system.parcel import receive, send

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path
    from typing import BinaryIO

    from reina.music import Score

PROGRAM = (sys.executable, "-m", "reina.sound.alignment.worker")
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
    """

    def __init__(
        self,
        *,
        program: Sequence[str] = PROGRAM,
        timeout_s: float = TIMEOUT_S,
        most_at_once: int = MAX_AT_ONCE,
    ) -> None:
        self._program = tuple(program)
        self._timeout_s = timeout_s
        self._turns = asyncio.Semaphore(most_at_once)
        self._under_way: set[asyncio.Task[Alignment | InputError]] = set()

    async def align(self, song: Path, score: Score, tell: Callable[[float], None]) -> Alignment:
        """Find where a score is heard in a recording. Cancelled, it stops the process.

        Args:
            song: The recording's file.
            score: What is played in it.
            tell: Called with the share that is done, 0..1.

        Raises:
            InputError: The recording cannot be decoded, or it takes too long, or its process ended.
        """
        loop = asyncio.get_running_loop()
        async with self._turns:
            process = await asyncio.to_thread(
                subprocess.Popen, (*self._program, str(song)), stdin=subprocess.PIPE, stdout=subprocess.PIPE
            )

            def tell_loop(share: float) -> None:
                loop.call_soon_threadsafe(tell, share)

            following = asyncio.create_task(asyncio.to_thread(_follow, process, score, tell_loop))
            self._under_way.add(following)
            following.add_done_callback(self._under_way.discard)
            try:
                async with asyncio.timeout(self._timeout_s):
                    # Shielded: the thread reads on until the process is gone, and is waited for below.
                    outcome = await asyncio.shield(following)
            except TimeoutError as error:
                detail = f"looking for the music in the recording took over {self._timeout_s:.0f} s"
                raise InputError(detail) from error
            except EOFError as error:
                log.warning("the aligner of %s ended early", song.parent.name)
                raise InputError("the search for the music in the recording failed") from error
            finally:
                process.kill()
                await asyncio.wait([following])
                await asyncio.to_thread(_end, process)
        if isinstance(outcome, InputError):
            raise outcome
        return outcome

    async def aclose(self) -> None:
        """Wait until the processes of searches that were cancelled are gone."""
        if self._under_way:
            await asyncio.wait(self._under_way)


def _follow(
    process: subprocess.Popen[bytes], score: Score, tell: Callable[[float], None]
) -> Alignment | InputError:
    """Send the score, and hear what comes back.

    Raises:
        EOFError: The process ended before it had told an outcome.
    """
    to, back = cast("BinaryIO", process.stdin), cast("BinaryIO", process.stdout)
    try:
        send(to, score)
    except OSError as error:
        raise EOFError(str(error)) from error
    while True:
        told: object = receive(back)
        if isinstance(told, Alignment | InputError):
            return told
        tell(cast("float", told))


def _end(process: subprocess.Popen[bytes]) -> None:
    for pipe in (process.stdin, process.stdout):
        if pipe is not None:
            try:
                pipe.close()
            except OSError:
                continue
    process.wait()
