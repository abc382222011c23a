"""Long work on processes and machines of a Dask cluster; `distributed` is imported when one is asked for."""

from __future__ import annotations

import logging
import queue
import signal
import time
from contextlib import contextmanager
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from reina.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterator
    from pathlib import Path

    from distributed import Client, Future

T = TypeVar("T")

HOW_TO_INSTALL = 'pip install "reina[cluster]"; in a checkout `make cluster`'
CONNECTING_S = 10.0
"""How long a scheduler may take to answer."""
ALIVE_S = 5.0
"""How often it is looked whether anybody is there to work, while nothing comes."""
AT_ONCE = 2
"""So many pieces of work are at a worker's, or wait for it: one is always there when another ends."""
COUNTED_S = 1.0
"""How often workers are counted: they come and go."""
LIVES = 1
"""So many workers may end under a piece of work before it is tried alone, beside the first."""


class ClusterError(InputError):
    """There is no cluster to work on; the message says why and what would help."""


class AwayError(ClusterError):
    """There is nobody to work now: whoever asked does it."""


class LostError(InputError):
    """Every worker that had a piece of work ended under it."""


@dataclass(frozen=True)
class Work(Generic[T]):
    """A piece of work.

    Attributes:
        about: What it belongs to.
        function: A function of a module, which workers import.
        arguments: What it is given; sent there.
    """

    about: T
    function: Callable[..., Any]
    arguments: tuple[object, ...] = ()


@contextmanager
def local_cluster(workers: int, scratch: Path) -> Generator[Client]:
    """Processes on this machine; they end with this one, however it ends.

    What they say to one another is encrypted, with keys that nobody else has: any other user of this machine
    could have them run anything else.

    Args:
        workers: How many.
        scratch: A folder for what they keep aside.

    Raises:
        ClusterError: The extra `cluster` is not installed, or none can be started.
    """
    dask, distributed = _modules()
    settings: dict[str, object] = {
        # A worker is given a piece when it can begin it: who dies takes none along that only waited.
        "distributed.scheduler.worker-saturation": 1.0,
        "distributed.scheduler.allowed-failures": LIVES,
        # Else each says at its start, and at its end, what nobody asked.
        "distributed.nanny.pre-spawn-environ.DASK_LOGGING__DISTRIBUTED": "critical",
        # What one that is killed leaves goes with the folder.
        "distributed.nanny.pre-spawn-environ.TMPDIR": str(scratch),
        "distributed.scheduler.http.routes": [],
        "distributed.worker.http.routes": [],
    }
    with dask.config.set(settings):
        try:
            with _interrupts_held():
                cluster = distributed.LocalCluster(
                    n_workers=workers,
                    threads_per_worker=1,
                    host="127.0.0.1",
                    dashboard_address="127.0.0.1:0",
                    security=distributed.Security.temporary(),
                    local_directory=str(scratch),
                    silence_logs=logging.CRITICAL,
                )
        except (OSError, RuntimeError) as error:
            raise ClusterError(f"no processes can be started: {error}") from error
        with cluster, distributed.Client(cluster, set_as_default=False) as client:
            yield client


@contextmanager
def _interrupts_held() -> Generator[None]:
    """Threads and processes that are begun meanwhile hear of no Ctrl-C: it is for the main thread alone."""
    if not hasattr(signal, "pthread_sigmask"):  # on Windows
        yield
        return
    from multiprocessing import resource_tracker

    # Python's own, which would lift it where a thread begins the first process.
    resource_tracker.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def cluster_at(address: str, *, within_s: float = CONNECTING_S) -> Generator[Client]:
    """The cluster of a scheduler that runs somewhere.

    Args:
        address: `tcp://host:8786`, or `tls://…` with the certificates that Dask's configuration names.
        within_s: How long it may take to answer.

    Raises:
        ClusterError: Nobody answers there, or the extra `cluster` is not installed.
    """
    dask, distributed = _modules()
    # Scores, songs and soundless plans are large, and meant to be sent.
    dask.config.set({"distributed.admin.large-graph-warning-threshold": "1GB"})
    for name in ("distributed", "distributed.client"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    try:
        client = distributed.Client(address, timeout=within_s, set_as_default=False)
    except (OSError, TimeoutError, ValueError, TypeError) as error:
        raise ClusterError(f"no Dask scheduler answers at {address}: {error}") from error
    with client:
        yield client


def outcomes(
    client: Client, another: Callable[[], Work[T] | None], tell: Callable[[str], None]
) -> Iterator[tuple[Work[T], Any, BaseException | None]]:
    """Have work done.

    Not more is sent out than `AT_ONCE` a thread of the cluster's, so that what waits at the scheduler and
    what comes back at once stays small, however much there is. What ends its worker is done again by Dask;
    what does so time and again is tried once more when all else is done, alone: what stood beside it is not
    to blame.

    Args:
        client: The cluster.
        another: Gives the next piece of work; None where there is none now. What an outcome leads to may be
            given later.
        tell: Hears in a line when there is nobody to work, and when there is again.

    Yields:
        A piece of work, what it returned, and what it raised.

    Raises:
        ClusterError: The scheduler is gone.
    """
    _, distributed = _modules()
    done: queue.SimpleQueue[Future[Any]] = queue.SimpleQueue()
    under_way: dict[str, tuple[Work[T], Future[Any]]] = {}
    suspects: list[Work[T]] = []
    alone = ""
    """The key of what is tried alone."""
    most, counted_s = AT_ONCE, -COUNTED_S
    try:
        while True:
            if time.monotonic() - counted_s > COUNTED_S:
                most, counted_s = AT_ONCE * max(1, threads_of(client)), time.monotonic()
            while not alone and len(under_way) < most:
                work = another()
                if work is None:
                    break
                _send(client, work, under_way, done)
            if not under_way:
                if not suspects:
                    return
                alone = _send(client, suspects.pop(), under_way, done)
            future = _next(client, done, tell)
            work, _ = under_way.pop(future.key)
            was_alone, alone = future.key == alone, ""
            try:
                result, error = future.result(), None
            except distributed.client.FutureCancelledError as gone:
                raise ClusterError("the Dask scheduler is gone") from gone
            except distributed.KilledWorker as lost:
                if not was_alone:
                    suspects.append(work)
                    continue
                told = "every process that worked at it ended: it takes too much memory, or crashes"
                result, error = None, LostError(told)
                error.__cause__ = lost
            except Exception as raised:
                result, error = None, raised
            del future
            yield work, result, error
    finally:
        for _, future in under_way.values():
            future.cancel()


def threads_of(client: Client) -> int:
    """How many pieces of work can be done at the same time."""
    try:
        return sum(client.nthreads().values())
    except OSError as error:
        raise ClusterError("the Dask scheduler is gone") from error


def _send(
    client: Client,
    work: Work[T],
    under_way: dict[str, tuple[Work[T], Future[Any]]],
    done: queue.SimpleQueue[Future[Any]],
) -> str:
    future: Future[Any] = client.submit(work.function, *work.arguments, pure=False)
    under_way[future.key] = work, future
    future.add_done_callback(done.put)
    return future.key


def _next(client: Client, done: queue.SimpleQueue[Future[Any]], tell: Callable[[str], None]) -> Future[Any]:
    told = False
    while True:
        try:
            future = done.get(timeout=ALIVE_S)
        except queue.Empty:
            if client.status != "running":
                raise ClusterError("the Dask scheduler is gone") from None
            if not told and not threads_of(client):
                tell("the Dask scheduler has no workers; waiting for one")
                told = True
        else:
            if told:
                tell("the Dask scheduler has workers again")
            return future


def _modules() -> tuple[Any, Any]:
    try:
        # What processes of one machine encrypt by; Dask does without where nobody asks for it.
        import_module("cryptography")
        return import_module("dask"), import_module("distributed")
    except ImportError as error:
        told = f"this needs dask.distributed, which is not installed: {HOW_TO_INSTALL}"
        raise ClusterError(told) from error
