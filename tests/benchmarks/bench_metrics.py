"""What it costs to count: processor time of what is done for each message, block, request and scrape."""

from __future__ import annotations

import time
import timeit
from typing import TYPE_CHECKING

from prometheus_client import generate_latest

import reina.system.process_metrics  # pyright: ignore[reportUnusedImport]  # noqa: F401 - what is told of processes belongs to a scrape
from reina.system.metrics import EVALUATION, REGISTRY, REQUEST_SECONDS, REQUESTS, tally

if TYPE_CHECKING:
    from collections.abc import Callable

MESSAGE = bytes(3000)
FRAMES_A_SECOND = 60


def message() -> None:
    """As `Viewer` counts each message that it has sent."""
    tally.frames_sent += 1
    tally.stream_bytes += len(MESSAGE)


def block() -> None:
    """As `EncodedFrames` measures each block of a second."""
    with EVALUATION.time():
        pass


def request() -> None:
    """As `Observed` counts each request."""
    REQUESTS.labels("/sessions/{session_id}", "GET", "200").inc()
    REQUEST_SECONDS.labels("/sessions/{session_id}").observe(0.01)


def nothing() -> None:
    """What a call alone takes."""


def cost_s(work: Callable[[], object], number: int) -> float:
    """Processor time of one call, seconds; the least of several rounds."""
    return min(timeit.repeat(work, timer=time.process_time, number=number, repeat=5)) / number


def main() -> None:
    """Measure, and print the figures."""
    call_s = cost_s(nothing, 1_000_000)
    message_s = cost_s(message, 1_000_000) - call_s
    print(f"a message to a viewer: {message_s * 1e9:.0f} ns")
    print(f"300 viewers at 60 frames a second: {message_s * 300 * FRAMES_A_SECOND:.3%} of a core")
    print(f"a block of 60 frames: {cost_s(block, 20_000) * 1e6:.1f} µs")
    print(f"a request: {cost_s(request, 20_000) * 1e6:.1f} µs")
    print(f"a scrape: {cost_s(lambda: generate_latest(REGISTRY), 50) * 1e3:.1f} ms, on a thread of its own")


if __name__ == "__main__":
    main()
