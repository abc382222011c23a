"""Large answers that are under way: so many at once, of all who ask and of one."""

import asyncio
from collections.abc import AsyncGenerator
from contextlib import asynccontextmanager

from fastapi import Depends, Request

from reina.api.http.proxies import client_address
from reina.sessions.limit_errors import ServerBusyError
from reina.system.room import NoRoomLeftError, Room

MOST_AT_ONCE = 32
"""Each holds 20 MB at most, which it is made of or has not sent yet."""
MOST_OF_ONE = 12
PATIENCE_S = 5.0
"""How long it is waited for one to end."""
RETRY_S = 5


class Answers:
    """Counts the large answers that are being computed or sent, until the last of their bytes is taken.

    Args:
        most: How many at once.
        most_of_one: How many of them go to one address.
        patience_s: How long a request waits before it is refused.
    """

    def __init__(
        self, most: int = MOST_AT_ONCE, most_of_one: int = MOST_OF_ONE, *, patience_s: float = PATIENCE_S
    ) -> None:
        self._room = Room(most, most_of_one)
        self._patience_s = patience_s
        self._ended = asyncio.Event()

    @asynccontextmanager
    async def under_way(self, sender: str) -> AsyncGenerator[None]:
        """An answer, from its begin to its end.

        Raises:
            ServerBusyError: Too many are under way.
        """
        try:
            async with asyncio.timeout(self._patience_s):
                while not self._has_taken(sender):
                    await self._ended.wait()
        except TimeoutError as error:
            raise ServerBusyError(
                f"{self._room.of(sender)} large answers are on their way to your address and "
                f"{self._room.held} in all, of {self._room.most_of_one} and {self._room.most}: take them "
                "first, and ask again",
                retry_after_s=RETRY_S,
            ) from error
        try:
            yield
        finally:
            self._room.give_back(sender, 1)
            ended, self._ended = self._ended, asyncio.Event()
            ended.set()

    def _has_taken(self, sender: str) -> bool:
        try:
            self._room.take(sender, 1)
        except NoRoomLeftError:
            return False
        return True


async def _large(request: Request) -> AsyncGenerator[None]:
    answers: Answers = request.app.state.answers
    async with answers.under_way(client_address(request.scope)):
        yield


LARGE_ANSWER = Depends(_large)
"""Of a route whose answer may be large: it is one of so many."""
