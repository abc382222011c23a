"""What is heard and seen in a page, beside the clock that page and server share on one machine."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from tests.e2e.opened import Opened

SAMPLED = """() => {
  const [reina, at] = [window.reina, performance.now() / 1000];
  return [at, reina.heard, reina.soundAhead, reina.clockOffset];
}"""
QUESTIONS = 40
DRAWN_IN_TIME_S = 1 / 60
"""A machine that takes longer for a picture shows it as much later, which no clock can mend."""


@dataclass(frozen=True)
class Heard:
    """What one page hears, at times of the server's clock."""

    server_time_s: NDArray[np.float64]
    song_time_s: NDArray[np.float64]

    def late_s(self, transport: dict[str, Any]) -> NDArray[np.float64]:
        """How far behind the server's own song time it is, seconds; at rate 1, without a loop."""
        due = transport["song_time_s"] + self.server_time_s - transport["server_time_s"]
        return due - self.song_time_s


def true_offset(opened: Opened) -> tuple[float, float]:
    """Seconds from the page's clock to the server's, and by how much that may be wrong.

    The test runs on the server's machine and reads the server's clock itself, around a question to the page.
    """
    best = (0.0, float("inf"))
    for _ in range(QUESTIONS):
        before = time.monotonic()
        page_s = opened.page.evaluate("performance.now() / 1000")
        after = time.monotonic()
        if (after - before) / 2 < best[1]:
            best = ((before + after) / 2 - page_s, (after - before) / 2)
    return best


def hear(opened: Opened, samples: int = 20) -> Heard:
    """Listen for a while."""
    offset, _ = true_offset(opened)
    times: list[tuple[float, float]] = []
    while len(times) < samples:
        at, heard, _, _ = opened.page.evaluate(SAMPLED)
        if heard is not None:
            times.append((at + offset, heard))
        opened.page.wait_for_timeout(30)
    columns = np.array(times).T
    return Heard(columns[0], columns[1])


def apart(opened: Opened) -> NDArray[np.float64]:
    """The last pictures' distance from the sound, seconds, positive where the picture was ahead.

    Where a picture took longer than DRAWN_IN_TIME_S until it was seen, that is taken off the distance.
    """
    recent = np.array(opened.measure("sync")["recent"]).reshape(-1, 2)
    excess = np.maximum(recent[:, 1] - DRAWN_IN_TIME_S, 0.0)
    return np.sign(recent[:, 0]) * np.maximum(np.abs(recent[:, 0]) - excess, 0.0)
