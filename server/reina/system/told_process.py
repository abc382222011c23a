"""Long work in processes of their own that tell how far they are, one after the other."""

from __future__ import annotations

import asyncio
import contextlib
import subprocess
import threading
from typing import TYPE_CHECKING, cast

from reina.system.parcel import receive, send

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import BinaryIO


class ToldProcesses:
    """Starts a process for each piece of work.

    It is sent an object (`reina.system.parcel`) and sends back numbers, the share that is done, and at the
    end any other object, which is the outcome.

    Args:
        queue: What this work is called in the metrics.
        timeout_s: How long one may take before it is stopped.
        most_at_once: How many run at once; others wait for their turn.
    """

    def __init__(self, *, queue: str, timeout_s: float, most_at_once: int = 1) -> None:
        self._queue = queue
        self._timeout_s = timeout_s
        self._turns = asyncio.Semaphore(most_at_once)
        self._under_way: set[asyncio.Future[object]] = set()

    async def run(self, program: Sequence[str], request: object, tell: Callable[[float], None]) -> object:
        """Have a piece of work done. Cancelled, it stops the process.

        Args:
            program: What is started, with its arguments.
            request: What it is sent.
            tell: Called with the share that is done, 0..1.

        Returns:
            The outcome; None if the process ended before it told one.

        Raises:
            TimeoutError: It took too long.
        """
        loop = asyncio.get_running_loop()
        async with self._turns:
            work = _Work(tuple(program), request, lambda share: _tell_loop(loop, tell, share))
            # The thread's own future: a task would be cancelled with all others before the thread ends.
            outcome = loop.run_in_executor(None, work.run)
            self._under_way.add(outcome)
            outcome.add_done_callback(self._under_way.discard)
            try:
                async with asyncio.timeout(self._timeout_s):
                    return await asyncio.shield(outcome)
            finally:
                work.stop()
                await asyncio.wait([outcome])

    async def aclose(self) -> None:
        """Wait until the processes of work that was cancelled are gone."""
        if self._under_way:
            await asyncio.wait(self._under_way)


def _tell_loop(loop: asyncio.AbstractEventLoop, tell: Callable[[float], None], share: float) -> None:
    # A loop that is closed meanwhile wants no news.
    with contextlib.suppress(RuntimeError):
        loop.call_soon_threadsafe(tell, share)


class _Work:
    """One process, from its start to its end, on a thread; another may stop it at any time."""

    def __init__(self, program: tuple[str, ...], request: object, tell: Callable[[float], None]) -> None:
        self._program = program
        self._request = request
        self._tell = tell
        self._lock = threading.Lock()
        self._stopped = False
        self._process: subprocess.Popen[bytes] | None = None

    def run(self) -> object:
        """Send the request and hear what comes back; None if the process ended before it told an outcome."""
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

    def _followed(self, to: BinaryIO, back: BinaryIO) -> object:
        send(to, self._request)
        while isinstance(told := cast("object", receive(back)), int | float):
            self._tell(told)
        return told
