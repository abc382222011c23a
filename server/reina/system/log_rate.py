"""A line a minute: what happens very often is told once and counted."""

from __future__ import annotations

import threading
import time
from collections import OrderedDict
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable

EVERY_S = 60.0
MOST_KINDS = 1000
"""So many kinds are remembered; of more, those that were told the longest ago are forgotten."""


@dataclass
class _Told:
    at: float
    since: int = 0
    """How often it has happened since without being told."""


class Seldom:
    """Says of each kind of event whether it is to be told now, at most once in a period.

    May be used by several threads.

    Args:
        every_s: Of one kind nothing is told for so long after it was told.
        now: Seconds; never goes back.
    """

    def __init__(self, every_s: float = EVERY_S, now: Callable[[], float] = time.monotonic) -> None:
        self._now = now
        self._every_s = every_s
        self._told: OrderedDict[Hashable, _Told] = OrderedDict()
        self._lock = threading.Lock()

    def count(self, kind: Hashable) -> int | None:
        """Note that something has happened.

        Returns:
            None if it is not to be told now; else how often it has happened since it was told last without
            being told, 0 the first time.
        """
        with self._lock:
            now = self._now()
            told = self._told.get(kind)
            if told is not None and now < told.at + self._every_s:
                told.since += 1
                return None
            self._told[kind] = _Told(now)
            self._told.move_to_end(kind)
            while len(self._told) > MOST_KINDS:
                self._told.popitem(last=False)
            return told.since if told else 0
