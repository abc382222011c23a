"""A line a minute: what happens very often is told once and counted."""

from __future__ import annotations

import threading
from collections import OrderedDict
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable

PERIOD_S = 60.0
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
        now: Seconds; never goes back.
        period_s: Of one kind nothing is told for so long after it was told.
    """

    def __init__(self, now: Callable[[], float], *, period_s: float = PERIOD_S) -> None:
        self._now = now
        self._period_s = period_s
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
            if told is not None and now < told.at + self._period_s:
                told.since += 1
                return None
            self._told[kind] = _Told(now)
            self._told.move_to_end(kind)
            while len(self._told) > MOST_KINDS:
                self._told.popitem(last=False)
            return told.since if told else 0

    def untold(self) -> list[tuple[Hashable, int]]:
        """The kinds that have happened since they were told, and how often; they count as told then."""
        with self._lock:
            since = [(kind, told.since) for kind, told in self._told.items() if told.since]
            for told in self._told.values():
                told.since = 0
            return since
