"""Whose turn it is to work: so many at once, and owner by owner."""

from __future__ import annotations

import asyncio
from collections import OrderedDict, deque
from contextlib import asynccontextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import AsyncGenerator, Hashable


class Turns:
    """Lets a number of pieces of work go on at once; those that wait are let in owner by owner.

    So whoever asks a hundred times waits for himself, and somebody who asks once for one piece of each other.

    Args:
        most_at_once: How many may work at once.
    """

    def __init__(self, most_at_once: int = 1) -> None:
        self._free = most_at_once
        self._waiting: OrderedDict[Hashable, deque[asyncio.Future[None]]] = OrderedDict()

    @asynccontextmanager
    async def of(self, owner: Hashable) -> AsyncGenerator[None]:
        """A turn of an owner, waited for and held.

        Args:
            owner: For whom the work is: a session's id, say.
        """
        await self._begin(owner)
        try:
            yield
        finally:
            self._end()

    async def _begin(self, owner: Hashable) -> None:
        if self._free:
            self._free -= 1
            return
        turn: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._waiting.setdefault(owner, deque()).append(turn)
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
            turn = turns.popleft()
            if turns:
                self._waiting[owner] = turns
            if not turn.done():
                turn.set_result(None)
                return
        self._free += 1
