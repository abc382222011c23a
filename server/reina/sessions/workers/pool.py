"""Long work in pure Python, in processes of its own: in a thread it would hold up every stream.

One interpreter runs one thread at a time. Whoever reads 20 MB of JSON in a thread takes turns with the event
loop, which has to wait for its turn at each of its hundreds of small calls a second.
"""

from __future__ import annotations

import asyncio
import contextlib
import contextvars
import logging
import queue
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any, TypeVar, cast

from reina.errors import InputError
from reina.system.metrics import in_queue
from reina.system.parcel import receive, send
from reina.system.turns import Turns

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Sequence
    from typing import BinaryIO

T = TypeVar("T")

PROGRAM = (sys.executable, "-m", "reina.sessions.workers.worker")
MAX_AT_ONCE = 2
TIMEOUT_S = 300.0
"""Thirty times what the largest score or show takes on a core that nobody else uses; others may use it."""

log = logging.getLogger(__name__)


class WorkerPool:
    """Processes that work for the server; each is started when it is first needed, and kept.

    Args:
        shared: What work and its outcome refer to and both ends keep: it is sent once.
        program: What is started.
        most_at_once: How many there are; other work waits for its turn.
        timeout_s: How long a piece of work may take before its process is stopped.
        name: What its work is called in the metrics.
    """

    def __init__(
        self,
        shared: Sequence[object] = (),
        *,
        program: Sequence[str] = PROGRAM,
        most_at_once: int = MAX_AT_ONCE,
        timeout_s: float = TIMEOUT_S,
        name: str = "readings",
    ) -> None:
        self._name = name
        self._shared = tuple(shared)
        self._program = tuple(program)
        self._timeout_s = timeout_s
        self._turns = Turns(most_at_once)
        self._threads = ThreadPoolExecutor(most_at_once, thread_name_prefix="worker")
        self._idle: queue.LifoQueue[_Worker] = queue.LifoQueue()
        self._alive: set[_Worker] = set()
        self._closed = threading.Event()
        self.fails = False
        """Whether the last process that was started could not be, or ended before it had done anything."""

    async def run(self, function: Callable[..., T], *arguments: object, owner: Hashable = None) -> T:
        """Do a piece of work.

        Args:
            function: A function of a module; it runs in another process.
            arguments: Its arguments; they and what it returns can be pickled.
            owner: For whom it is, a session say; work that waits is done owner by owner.

        Raises:
            InputError: What `function` raises, or it took too long, or its process ended.
        """
        loop = asyncio.get_running_loop()
        # What is logged on the thread belongs to who asked.
        context = contextvars.copy_context()

        def work() -> object:
            return context.run(self._work, function, arguments)

        with in_queue(self._name):
            async with self._turns.of(owner):
                return cast("T", await loop.run_in_executor(self._threads, work))

    async def aclose(self) -> None:
        """Stop the processes, whatever they do."""
        self._closed.set()
        await asyncio.to_thread(self._close)

    def _close(self) -> None:
        for worker in self._alive:
            worker.stop()
        # Who waits for one of them hears that it has ended, and no thread reads from its pipes then.
        self._threads.shutdown(cancel_futures=True)
        for worker in self._alive:
            worker.end()

    def _work(self, function: Callable[..., Any], arguments: tuple[object, ...]) -> Any:
        try:
            worker = self._idle.get_nowait()
        except queue.Empty:
            try:
                worker = _Worker(self._program, self._shared)
            except OSError as error:
                self.fails = True
                log.exception("no worker can be started")
                raise InputError("the server cannot read it at present; try again later") from error
            self._alive.add(worker)
            if self._closed.is_set():
                worker.stop()
        try:
            result, error = worker.ask((function, arguments), self._timeout_s)
        except InputError:
            self._alive.discard(worker)
            self.fails = self.fails or not worker.has_worked
            raise
        self.fails = False
        self._idle.put(worker)
        if error is not None:
            raise error
        return result


class _Worker:
    """One process."""

    def __init__(self, program: tuple[str, ...], shared: tuple[object, ...]) -> None:
        self._shared = shared
        self._begun = False
        self.has_worked = False
        """Whether it has done a piece of work, or was still at its first when it was stopped."""
        self._process = subprocess.Popen(program, stdin=subprocess.PIPE, stdout=subprocess.PIPE)  # noqa: S603

    def ask(self, work: object, timeout_s: float) -> tuple[Any, Exception | None]:
        """What a piece of work returned and raised; waits for it.

        Raises:
            InputError: It took too long, or the process ended; it is gone then.
        """
        late = threading.Event()

        def stop() -> None:
            late.set()
            self.stop()

        timer = threading.Timer(timeout_s, stop)
        timer.start()
        try:
            to, back = cast("BinaryIO", self._process.stdin), cast("BinaryIO", self._process.stdout)
            if not self._begun:
                send(to, self._shared)
                self._begun = True
            send(to, work, self._shared)
            outcome = receive(back, self._shared)
        except (OSError, EOFError) as error:
            self.end()
            if late.is_set():
                detail = f"reading it took over {timeout_s:g} s and was stopped; make it smaller"
                self.has_worked = True
                raise InputError(detail) from error
            log.warning("a worker ended with status %s", self._process.returncode)
            raise InputError(
                "the process that read it has ended; it may be too large, or try again"
            ) from error
        else:
            self.has_worked = True
            return outcome
        finally:
            timer.cancel()

    def stop(self) -> None:
        """Have it end, whatever it does."""
        self._process.kill()

    def end(self) -> None:
        """Stop it, and let its pipes go, which nobody may be reading from."""
        self.stop()
        self._process.wait()
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                with contextlib.suppress(OSError):
                    pipe.close()
