"""An amount that is shared out: so much in all, and so much of it to one owner."""

from __future__ import annotations

from collections import Counter
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Generator, Hashable


class NoRoomLeftError(Exception):
    """There is not so much left.

    Args:
        to_owner: Whether it is the owner who has too much, rather than all together.
    """

    def __init__(self, *, to_owner: bool) -> None:
        super().__init__("one owner has too much" if to_owner else "all together have too much")
        self.to_owner = to_owner


class Room:
    """Counts what is held; nothing waits here. For one thread.

    Args:
        most: How much all may hold together; None for as much as they like.
        most_of_one: How much one owner may; None for as much as all.
    """

    def __init__(self, most: int | None, most_of_one: int | None = None) -> None:
        self.most = most
        self.most_of_one = most_of_one
        self._held: Counter[Hashable] = Counter()
        self.held = 0
        """How much all hold."""

    def of(self, owner: Hashable) -> int:
        """How much one holds."""
        return self._held.get(owner, 0)

    def take(self, owner: Hashable, amount: int) -> None:
        """Hold so much more; who holds nothing yet is not refused as one who has too much.

        Raises:
            NoRoomLeftError: There is not so much; nothing is held of it then.
        """
        if self.most is not None and self.held and self.held + amount > self.most:
            raise NoRoomLeftError(to_owner=False)
        has = self.of(owner)
        if self.most_of_one is not None and has and has + amount > self.most_of_one:
            raise NoRoomLeftError(to_owner=True)
        self._held[owner] += amount
        self.held += amount

    def give_back(self, owner: Hashable, amount: int) -> None:
        """Hold so much less."""
        self.held -= amount
        self._held[owner] -= amount
        if not self._held[owner]:
            del self._held[owner]

    @contextmanager
    def holding(self, owner: Hashable, amount: int = 1) -> Generator[None]:
        """Hold so much for a while.

        Raises:
            NoRoomLeftError: There is not so much.
        """
        self.take(owner, amount)
        try:
            yield
        finally:
            self.give_back(owner, amount)
