"""Has recordings put in time with their scores by processes of their own, which a server outlives."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import subprocess
import sys
import threading
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
        self._under_way: set[asyncio.Future[Alignment | InputError | None]] = set()

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
            search = _Search((*self._program, str(song)), score, lambda share: _tell_loop(loop, tell, share))
            # The thread's own future: a task would be cancelled with all others before the thread ends.
            outcome = loop.run_in_executor(None, search.run)
            self._under_way.add(outcome)
            outcome.add_done_callback(self._under_way.discard)
            try:
                async with asyncio.timeout(self._timeout_s):
                    told = await asyncio.shield(outcome)
            except TimeoutError as error:
                detail = f"looking for the music in the recording took over {self._timeout_s:.0f} s"
                raise InputError(detail) from error
            finally:
                search.stop()
                await asyncio.wait([outcome])
        if told is None:
            log.warning("the aligner of %s ended early", song.parent.name)
            raise InputError("the search for the music in the recording failed")
        if isinstance(told, InputError):
            raise told
        return told

    async def aclose(self) -> None:
        """Wait until the processes of searches that were cancelled are gone."""
        if self._under_way:
            await asyncio.wait(self._under_way)


def _tell_loop(loop: asyncio.AbstractEventLoop, tell: Callable[[float], None], share: float) -> None:
    # A loop that is closed meanwhile wants no news.
    with contextlib.suppress(RuntimeError):
        loop.call_soon_threadsafe(tell, share)


class _Search:
    """One process, from its start to its end, on a thread; another may stop it at any time."""

    def __init__(self, program: tuple[str, ...], score: Score, tell: Callable[[float], None]) -> None:
        self._program = program
        self._score = score
        self._tell = tell
        self._lock = threading.Lock()
        self._stopped = False
        self._process: subprocess.Popen[bytes] | None = None

    def run(self) -> Alignment | InputError | None:
        """Send the score and hear what comes back; None if the process ended before it told an outcome."""
        with self._lock:
            if self._stopped:
                return None
            self._process = process = subprocess.Popen(  # noqa: S603
                self._program, stdin=subprocess.PIPE, stdout=subprocess.PIPE
            )
        try:
            return self._followed(cast("BinaryIO", process.stdin), cast("BinaryIO", process.stdout))
        except (OSError, EOFError):
            return None
        finally:
            process.kill()
            for pipe in (process.stdin, process.stdout):
                if pipe is not None:
                    with contextlib.suppress(OSError):
                        pipe.close()
            process.wait()

    def stop(self) -> None:
        """End the process, or let it not begin."""
        with self._lock:
            self._stopped = True
            if self._process is not None:
                self._process.kill()

    def _followed(self, to: BinaryIO, back: BinaryIO) -> Alignment | InputError:
        send(to, self._score)
        while True:
            told: object = receive(back)
            if isinstance(told, Alignment | InputError):
                return told
            self._tell(cast("float", told))
