"""What is due when, of all sessions of a process: one timer for all of them."""

from __future__ import annotations

import asyncio
import heapq
import itertools
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

TURN_S = 0.001
"""So long what is due is seen to at once; then whoever else waits for the event loop has it first."""


class Deadline:
    """A time at which something is to be done, once."""

    __slots__ = ("turn",)

    def __init__(self, turn: Callable[[], None]) -> None:
        self.turn: Callable[[], None] | None = turn
        """What is done; None when it is not to be done any more."""

    def cancel(self) -> None:
        """Do nothing then."""
        self.turn = None


class Ticker:
    """A heap of deadlines. Belongs to the event loop that runs.

    What is done sees to its own errors; one that is raised all the same holds up none of the others.
    """

    def __init__(self) -> None:
        self._loop: asyncio.AbstractEventLoop | None = None
        self._deadlines: list[tuple[float, int, Deadline]] = []
        self._count = itertools.count()
        self._timer: asyncio.TimerHandle | None = None
        self._ticking = False

    def __len__(self) -> int:
        """How many deadlines are to come."""
        return sum(deadline.turn is not None for _, _, deadline in self._deadlines)

    def at(self, time_s: float, turn: Callable[[], None]) -> Deadline:
        """Have something done.

        Args:
            time_s: Time of the event loop; what has gone by is as soon as possible.
            turn: What is done.

        Returns:
            By which it can be called off.
        """
        loop = asyncio.get_running_loop()
        if loop is not self._loop:
            # What another loop left is nobody's any more.
            self._loop, self._deadlines, self._timer, self._ticking = loop, [], None, False
        deadline = Deadline(turn)
        heapq.heappush(self._deadlines, (time_s, next(self._count), deadline))
        if not self._ticking:
            self._wait(loop)
        return deadline

    def _wait(self, loop: asyncio.AbstractEventLoop) -> None:
        """Come back at the first deadline."""
        while self._deadlines and self._deadlines[0][2].turn is None:
            heapq.heappop(self._deadlines)
        timer = self._timer
        if not self._deadlines:
            if timer is not None:
                timer.cancel()
            self._timer = None
        elif timer is None or timer.when() > self._deadlines[0][0]:
            if timer is not None:
                timer.cancel()
            self._timer = loop.call_at(self._deadlines[0][0], self._tick, loop)

    def _tick(self, loop: asyncio.AbstractEventLoop) -> None:
        if loop is not self._loop:
            return
        self._timer = None
        self._ticking = True
        deadlines, begun = self._deadlines, loop.time()
        try:
            while deadlines and deadlines[0][0] <= begun:
                turn = heapq.heappop(deadlines)[2].turn
                if turn is not None:
                    turn()
                    if loop.time() - begun > TURN_S:
                        break
        finally:
            self._ticking = False
            self._wait(loop)


TICKER = Ticker()
"""Of the whole process."""
