"""Server time that is the same on several machines: seconds since 1970, without the calendar's leaps."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

SLEWING = 0.01
"""It runs at most by so much faster or slower than time does, to come to where the calendar is."""


class WallTime:
    """Tells the time of the calendar, and never goes back.

    It runs as the monotonic clock does. Where the calendar is set (by NTP, say), it comes there bit by bit.

    Args:
        steady: A clock that never goes back, seconds.
        wall: The calendar, seconds since 1970.
    """

    def __init__(
        self, *, steady: Callable[[], float] = time.monotonic, wall: Callable[[], float] = time.time
    ) -> None:
        self._steady = steady
        self._wall = wall
        self._looked_s = steady()
        self._ahead_s = wall() - self._looked_s

    def __call__(self) -> float:
        """The present, seconds since 1970."""
        now = self._steady()
        most = SLEWING * (now - self._looked_s)
        self._looked_s = now
        apart = self._wall() - now - self._ahead_s
        self._ahead_s += min(max(apart, -most), most)
        return now + self._ahead_s
