"""What is counted and measured, for Prometheus; docs/operating.md has the table.

Everything here is of the whole server: no name of a session, of a file or of somebody who asks is a label, so
that their number is bounded. What is counted on the event loop many thousand times a second stands in `tally`
as plain numbers, which cost next to nothing; they are read when somebody asks for the metrics.
"""

from __future__ import annotations

import time
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

from prometheus_client import CollectorRegistry, Counter, Gauge, Histogram, disable_created_metrics
from prometheus_client.core import CounterMetricFamily
from prometheus_client.registry import Collector

if TYPE_CHECKING:
    from collections.abc import Generator, Iterable, Iterator

    from prometheus_client import Metric

disable_created_metrics()
REGISTRY = CollectorRegistry(auto_describe=False)


@dataclass(slots=True)
class Tally:
    """What the event loop counts, and nobody but it.

    Attributes:
        frames_sent: Frames in messages that were handed to viewers' connections.
        frames_late: Frames that were given out after they were due, once for each viewer.
        frames_lost: Frames that viewers were too slow for.
        stream_bytes: Bytes of messages handed to viewers' connections.
        answer_bytes: Bytes of bodies of HTTP answers.
    """

    frames_sent: int = 0
    frames_late: int = 0
    frames_lost: int = 0
    stream_bytes: int = 0
    answer_bytes: int = 0


tally = Tally()

EVALUATION = Histogram(
    "reina_block_evaluation_seconds",
    "Time to evaluate and encode a block of 60 frames, which last a second.",
    buckets=(0.0025, 0.005, 0.01, 0.02, 0.04, 0.08, 0.16, 0.32, 0.64, 1.28),
    registry=REGISTRY,
)
LOOP_DELAY = Histogram(
    "reina_loop_delay_seconds",
    "How much later than asked for the event loop wakes a sleeper, ten times a second.",
    buckets=(0.001, 0.0025, 0.005, 0.01, 0.02, 0.04, 0.06, 0.1, 0.25, 0.5, 1, 2.5, 5),
    registry=REGISTRY,
)
REQUESTS = Counter(
    "reina_requests",
    "Requests that were answered, by the route's template.",
    ("route", "method", "status"),
    registry=REGISTRY,
)
REQUEST_SECONDS = Histogram(
    "reina_request_seconds",
    "Time from a request's headers to the end of its answer.",
    ("route",),
    buckets=(0.005, 0.025, 0.1, 0.5, 2.5, 10, 60),
    registry=REGISTRY,
)
LIMITS = Counter(
    "reina_limits_hit",
    "Requests and streams that were refused or cut because of a limit, by the limit.",
    ("limit",),
    registry=REGISTRY,
)
LOGGED = Counter(
    "reina_logged",
    "Events for the log from warnings on, those included that are only counted there.",
    ("level",),
    registry=REGISTRY,
)
WORK = Gauge(
    "reina_work",
    "Pieces of long work that are under way or wait for their turn.",
    ("queue",),
    registry=REGISTRY,
)
WORK_SECONDS = Histogram(
    "reina_work_seconds",
    "Time of a piece of long work, with its wait for its turn.",
    ("queue",),
    buckets=(0.1, 0.5, 1, 2.5, 5, 10, 30, 60, 300, 900),
    registry=REGISTRY,
)
VIEWERS = Gauge("reina_viewers", "Streams that are open.", registry=REGISTRY)
SESSIONS_LOADED = Gauge("reina_sessions_loaded", "Sessions in memory.", registry=REGISTRY)
READY = Gauge("reina_ready", "1 while the server is ready, else 0.", registry=REGISTRY)

QUEUES = ("readings", "recordings", "renderings", "alignments", "transcriptions", "laboratory")
"""The kinds of long work: scores and shows read, recordings decoded, songs rendered, and so on."""
for _queue in QUEUES:
    WORK.labels(_queue)
    WORK_SECONDS.labels(_queue)


def limit_hit(limit: str) -> None:
    """Count that a limit has refused or cut somebody.

    Args:
        limit: Its name: one of a fixed number, never with anything in it that somebody has sent.
    """
    LIMITS.labels(limit).inc()


@contextmanager
def in_queue(queue: str) -> Generator[None]:
    """Measure a piece of long work, from before it waits for its turn to its end.

    Args:
        queue: One of `QUEUES`.
    """
    waiting = WORK.labels(queue)
    waiting.inc()
    begun = time.perf_counter()
    try:
        yield
    finally:
        waiting.dec()
        WORK_SECONDS.labels(queue).observe(time.perf_counter() - begun)


class _Tallied(Collector):
    """The tally as metrics."""

    def collect(self) -> Iterable[Metric]:
        """Each number as it is now."""
        yield from _counters(tally)


def _counters(counted: Tally) -> Iterator[Metric]:
    rows = (
        ("reina_frames_sent", "Frames handed to viewers' connections.", counted.frames_sent),
        ("reina_frames_late", "Frames given out after they were due.", counted.frames_late),
        ("reina_frames_lost", "Frames that viewers were too slow for.", counted.frames_lost),
    )
    for name, documentation, value in rows:
        yield CounterMetricFamily(name, documentation, value=value)
    sent = CounterMetricFamily("reina_sent_bytes", "Bytes sent, by what carried them.", labels=("by",))
    sent.add_metric(("stream",), counted.stream_bytes)
    sent.add_metric(("answer",), counted.answer_bytes)
    yield sent


REGISTRY.register(_Tallied())
