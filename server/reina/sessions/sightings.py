"""When sessions were seen: noted in memory, and kept now and then."""

from __future__ import annotations

import asyncio
from datetime import UTC, datetime
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from reina.sessions.storage.session_storage import SessionStorage

DAY_S = 86_400.0
NEAR_S = 14 * DAY_S
"""So long before its end a session says so, and a third of the time that is waited at most."""


class Sightings:
    """Remembers who has been seen since it was kept last.

    Args:
        storage: Where it is kept.
        wall: The present, seconds since 1970.
    """

    def __init__(self, storage: SessionStorage, *, wall: Callable[[], float]) -> None:
        self._storage = storage
        self._wall = wall
        self._seen: set[str] = set()

    def note(self, session_id: str) -> None:
        """Somebody sees a session: watches it, or asks for it with its token."""
        self._seen.add(session_id)

    async def ends_s(self, session_id: str, after_s: float) -> float | None:
        """When a session will be ended if nobody sees it again, seconds since 1970.

        Args:
            session_id: Which.
            after_s: How long after it was seen last.
        """
        if session_id in self._seen:
            return self._wall() + after_s
        seen_s = await asyncio.to_thread(self._storage.seen_s, session_id)
        return None if seen_s is None else seen_s + after_s

    async def keep(self, watched: Iterable[str]) -> None:
        """Keep who has been seen.

        Args:
            watched: Those that are being watched.
        """
        seen, self._seen = self._seen, set()
        await asyncio.to_thread(self._storage.note_seen, seen.union(watched), self._wall())


def near_end(ends_s: float, now_s: float, after_s: float) -> str | None:
    """The end of a session that nobody sees, if it is near: ISO 8601, UTC.

    Args:
        ends_s: When it is, seconds since 1970.
        now_s: The present.
        after_s: How long is waited.
    """
    if ends_s - now_s > min(NEAR_S, after_s / 3):
        return None
    return datetime.fromtimestamp(ends_s, UTC).isoformat(timespec="seconds")
