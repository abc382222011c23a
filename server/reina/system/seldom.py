"""A log that nobody can flood: of each kind of event one line in a while, with how many there were."""

from __future__ import annotations

import logging
import threading
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

EVERY_S = 60.0
"""How long a kind is not spoken of again."""
MOST_KINDS = 1000
"""Of more kinds the one that was spoken of longest ago is forgotten."""


@dataclass
class _Kind:
    said_s: float
    unsaid: int = 0


class Seldom:
    """Counts events by kind, and says which of them is to be spoken of. May be used from any thread.

    Args:
        every_s: How long a kind is not spoken of again, seconds.
        now: A clock, seconds, that never goes back.
    """

    def __init__(self, every_s: float = EVERY_S, now: Callable[[], float] = time.monotonic) -> None:
        self._every_s = every_s
        self._now = now
        self._kinds: dict[str, _Kind] = {}
        self._lock = threading.Lock()

    def count(self, kind: str) -> int | None:
        """Take note of an event; None when nothing is said of it.

        Returns:
            How many of its kind nothing was said of since the last line.
        """
        with self._lock:
            now = self._now()
            known = self._kinds.pop(kind, None)
            if known is not None and now - known.said_s < self._every_s:
                known.unsaid += 1
                self._kinds[kind] = known
                return None
            while len(self._kinds) >= MOST_KINDS:
                del self._kinds[next(iter(self._kinds))]
            self._kinds[kind] = _Kind(now)
            return known.unsaid if known else 0


class SeldomLog:
    """Warnings of a logger that strangers can bring about as often as they like.

    Args:
        name: The logger's name.
        seldom: Which of them are said; one line a minute and kind by default.
    """

    def __init__(self, name: str, seldom: Seldom | None = None) -> None:
        self._log = logging.getLogger(name)
        self._seldom = seldom or Seldom()

    def warning(self, kind: str, message: str, *values: object) -> None:
        """Say that something has happened, unless it was just said of another event of its kind.

        Args:
            kind: What belongs together.
            message: With places for the values, as `logging` has them.
            values: They are worked into the message where it is said.
        """
        unsaid = self._seldom.count(kind)
        if unsaid is not None:
            self._log.warning(message + _more(unsaid), *values)


class SeldomFilter(logging.Filter):
    """Lets pass one warning of each wording in a while, for a logger that is not ours.

    Errors pass all: each may be another.
    """

    def __init__(self, seldom: Seldom | None = None) -> None:
        super().__init__()
        self._seldom = seldom or Seldom()

    def filter(self, record: logging.LogRecord) -> bool:
        """Whether it is said."""
        if record.levelno > logging.WARNING:
            return True
        unsaid = self._seldom.count(str(record.msg))
        if unsaid:
            record.msg = str(record.msg) + _more(unsaid)
        return unsaid is not None


def _more(unsaid: int) -> str:
    return f" (and {unsaid} more since the last such line)" if unsaid else ""
