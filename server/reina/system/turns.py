"""Whose turn it is to work: so many at once, and owner by owner."""

from __future__ import annotations

import asyncio
from collections import OrderedDict
from contextlib import asynccontextmanager
from heapq import heappop, heappush
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import AsyncGenerator, Hashable


_Waiting = tuple[float, int, "asyncio.Future[None]"]
"""How long the work is, a number that tells the earlier from the later, and the turn."""


class Turns:
    """Lets a number of pieces of work go on at once; those that wait are let in owner by owner.

    So whoever asks a hundred times waits for himself, and somebody who asks once for one piece of each other.
    Of an owner's own work the short goes first.

    Args:
        most_at_once: How many may work at once.
    """

    def __init__(self, most_at_once: int = 1) -> None:
        self._free = most_at_once
        self._waiting: OrderedDict[Hashable, list[_Waiting]] = OrderedDict()
        self._count = 0

    @asynccontextmanager
    async def of(self, owner: Hashable, length: float = 0.0) -> AsyncGenerator[None]:
        """A turn of an owner, waited for and held.

        Args:
            owner: For whom the work is: a session's id, say.
            length: How long the work is, in any unit; of one owner's the shortest is first, then the oldest.
        """
        await self._begin(owner, length)
        try:
            yield
        finally:
            self._end()

    async def _begin(self, owner: Hashable, length: float) -> None:
        if self._free:
            self._free -= 1
            return
        turn: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._count += 1
        heappush(self._waiting.setdefault(owner, []), (length, self._count, turn))
        try:
            await turn
        except asyncio.CancelledError:
            if turn.done() and not turn.cancelled():
                # It was given the turn just before it went.
                self._end()
            raise

    def _end(self) -> None:
        """Give the turn to the next owner who waits, who then stands behind all others."""
        while self._waiting:
            owner, turns = self._waiting.popitem(last=False)
            _, _, turn = heappop(turns)
            if turns:
                self._waiting[owner] = turns
            if not turn.done():
                turn.set_result(None)
                return
        self._free += 1
