"""The server's end: whoever still sends or waits is told so, and nothing holds it up."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

import anyio

from reina.api.http.problems import ProblemError

if TYPE_CHECKING:
    from starlette.types import ASGIApp, Message, Receive, Scope, Send

WORKING_S = 1.5
"""How long what has been sent whole is still worked at."""
RETRY_S = 5
"""When to try again: a server that is started anew is there by then."""


def server_ends() -> ProblemError:
    """The problem of a request that the server will not come to."""
    return ProblemError(
        503,
        "server-ends",
        "The server is being stopped",
        "nothing of this request was kept; try again when the server is there again",
        headers={"Retry-After": str(RETRY_S)},
    )


class Ending:
    """Whether the server ends, for those who would go on otherwise."""

    def __init__(self) -> None:
        self.announced = False
        """Whether it will end: it is not ready any more, and still answers."""
        self.begun = asyncio.Event()
        self.working: set[anyio.CancelScope] = set()
        """What is under way."""

    def begin(self) -> None:
        """Say so: uploads end at once, what is worked at soon."""
        self.announced = True
        self.begun.set()
        asyncio.get_running_loop().call_later(WORKING_S, self._stop)

    def _stop(self) -> None:
        for scope in self.working:
            scope.cancel()


class UntilTheEnd:
    """ASGI middleware: a request whose body is not there yet, or which takes too long, has 503 at the end.

    Args:
        app: What answers.
        ending: Says when it comes.
    """

    def __init__(self, app: ASGIApp, ending: Ending) -> None:
        self._app = app
        self._ending = ending

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on, until the end."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        complete = started = False

        async def received() -> Message:
            nonlocal complete
            message = await (receive() if complete else self._received(receive))
            complete = complete or not message.get("more_body", False)
            return message

        async def sent(message: Message) -> None:
            nonlocal started
            started = True
            await send(message)

        with anyio.CancelScope() as working:
            self._ending.working.add(working)
            try:
                await self._app(scope, received, sent)
            finally:
                self._ending.working.discard(working)
        if working.cancelled_caught and not started:
            await server_ends().response()(scope, receive, send)

    async def _received(self, receive: Receive) -> Message:
        """The next message.

        Raises:
            ProblemError: 503, the server ends before it comes.
        """
        message = asyncio.ensure_future(receive())
        end = asyncio.ensure_future(self._ending.begun.wait())
        try:
            await asyncio.wait({message, end}, return_when=asyncio.FIRST_COMPLETED)
        finally:
            message.cancel()
            end.cancel()
        if message.done() and not message.cancelled():
            return message.result()
        raise server_ends()
