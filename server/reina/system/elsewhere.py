"""Long work of a server on a Dask cluster: where that is away, whoever asked does it."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from importlib import import_module
from typing import TYPE_CHECKING, Any

from reina.system.cluster import AwayError, ClusterError, LostError, cluster_at, threads_of
from reina.system.digest import code_digest

if TYPE_CHECKING:
    from collections.abc import Callable

    from distributed import Client

MAX_AT_ONCE = 8
"""So many pieces of work are there at once; a song of 200 MB may be with each."""
CONNECTING_S = 3.0
"""How long a scheduler may take to answer: somebody waits for the work."""
AWAY_S = 30.0
"""So long nobody is asked again where nobody was there, or none who would make the same."""
LOOKED_S = 5.0
"""How often it is looked whether anybody works, while nothing comes."""
TOLD_S = 0.5
"""How often a worker tells how far it is."""

log = logging.getLogger(__name__)


class CalledOffError(Exception):
    """Nobody wants a piece of work any more."""


class Elsewhere:
    """Has work done on a cluster.

    Args:
        address: Its scheduler's, ``tcp://host:8786``.
    """

    def __init__(self, address: str) -> None:
        self._address = address
        self._turns = asyncio.Semaphore(MAX_AT_ONCE)
        self._threads = ThreadPoolExecutor(MAX_AT_ONCE, thread_name_prefix="elsewhere")
        self._connecting = threading.Lock()
        self._held = ExitStack()
        self._client: Client | None = None
        self._away_until_s = 0.0
        self._is_away = False
        self._heard: dict[str, Callable[[float], None]] = {}

    async def run(
        self, place: str, *arguments: object, tell: Callable[[float], None], timeout_s: float
    ) -> Any:
        """Have a function called on a worker. Cancelled, it is called off.

        Args:
            place: A module and a function of it, as ``reina.sound.render_elsewhere:render_files``. It is
                called with the arguments and with what tells the share that is done.
            arguments: What can be pickled.
            tell: Called with that share, 0..1.
            timeout_s: How long it may take.

        Returns:
            What it returned.

        Raises:
            AwayError: There is nobody to do it, which the log tells.
            LostError: It has ended every worker that it was given to.
            TimeoutError: It took too long.
        """
        loop = asyncio.get_running_loop()

        def heard(share: float) -> None:
            with contextlib.suppress(RuntimeError):  # a loop that is closed wants no news
                loop.call_soon_threadsafe(tell, share)

        async with self._turns:
            news, stopped = threading.Event(), threading.Event()
            outcome = loop.run_in_executor(self._threads, self._work, place, arguments, heard, news, stopped)
            try:
                async with asyncio.timeout(timeout_s):
                    return await asyncio.shield(outcome)
            finally:
                stopped.set()
                news.set()
                await asyncio.wait([outcome])

    async def aclose(self) -> None:
        """Leave the cluster."""
        await asyncio.to_thread(self._leave)
        self._threads.shutdown(wait=False)

    def _work(
        self,
        place: str,
        arguments: tuple[object, ...],
        heard: Callable[[float], None],
        news: threading.Event,
        stopped: threading.Event,
    ) -> Any:
        if time.monotonic() < self._away_until_s:
            raise AwayError("it was away just now")
        try:
            done = self._done(self._reached(), place, arguments, heard, news, stopped)
        except AwayError as error:
            self._away_until_s = time.monotonic() + AWAY_S
            self._is_gone(str(error))
            raise
        if self._is_away:
            self._is_away = False
            log.warning("the Dask scheduler at %s works again", self._address)
        return done

    def _done(
        self,
        client: Client,
        place: str,
        arguments: tuple[object, ...],
        heard: Callable[[float], None],
        news: threading.Event,
        stopped: threading.Event,
    ) -> Any:
        distributed = import_module("distributed")
        if not threads_of(client):
            raise AwayError("it has no workers")
        future = client.submit(work_at, code_digest(), self._topic(client), place, arguments, pure=False)
        self._heard[future.key] = heard
        future.add_done_callback(lambda _: news.set())
        try:
            while not news.wait(LOOKED_S):
                if client.status != "running" or not threads_of(client):
                    raise AwayError("its workers are gone")
            if stopped.is_set():
                raise CalledOffError
            return future.result()
        except distributed.client.FutureCancelledError as error:
            raise AwayError("it is gone") from error
        except distributed.KilledWorker as error:
            raise LostError("every process that worked at it ended") from error
        finally:
            del self._heard[future.key]
            # Of what is done that is no more than to let go of it.
            future.cancel()

    def _reached(self) -> Client:
        """The cluster, entered anew where it was left or lost."""
        with self._connecting:
            if self._client is None or self._client.status != "running":
                self._held.close()
                try:
                    client = self._held.enter_context(cluster_at(self._address, within_s=CONNECTING_S))
                except ClusterError as error:
                    raise AwayError(str(error)) from error
                client.subscribe_topic(self._topic(client), self._hear)
                self._client = client
            return self._client

    def _is_gone(self, why: str) -> None:
        if not self._is_away:
            self._is_away = True
            log.warning("the Dask scheduler at %s does not work, this server does: %s", self._address, why)

    def _hear(self, event: tuple[float, tuple[str, float]]) -> None:
        key, share = event[1]
        if (heard := self._heard.get(key)) is not None:
            heard(share)

    def _topic(self, client: Client) -> str:
        return f"reina {client.id}"

    def _leave(self) -> None:
        with self._connecting:
            self._client = None
            self._held.close()


def work_at(code: str, topic: str, place: str, arguments: tuple[object, ...]) -> Any:
    """What a worker does.

    Args:
        code: `code_digest` of the server.
        topic: Under which the server hears how far it is.
        place: As for `Elsewhere.run`.
        arguments: The same.
    """
    if code != code_digest():
        raise AwayError("a worker has another version of Reina; every machine needs the same")
    distributed = import_module("distributed")
    worker = distributed.get_worker()
    key, told_s = worker.get_current_task(), 0.0

    def tell(share: float) -> None:
        nonlocal told_s
        task = worker.state.tasks.get(key)
        if task is None or task.state == "cancelled":
            raise CalledOffError
        now_s = time.monotonic()
        if now_s - told_s >= TOLD_S:
            told_s = now_s
            worker.log_event(topic, (key, share))

    module, _, function = place.partition(":")
    return getattr(import_module(module), function)(*arguments, tell)
