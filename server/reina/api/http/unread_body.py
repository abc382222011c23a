"""What is left of a body when it has been answered already."""

from __future__ import annotations

import asyncio
import contextlib
from typing import TYPE_CHECKING

from reina.api.http.problems import ProblemError

if TYPE_CHECKING:
    from starlette.types import ASGIApp, Message, Receive, Scope, Send

READ_ON = 32_000_000
"""Bytes that are still taken, and thrown away, so that a sender who reads afterwards hears the answer."""
READ_ON_S = 10.0


class UnreadBody:
    """ASGI middleware: who is refused in the middle of a body is answered at once, and the connection closed.

    Most senders read no answer before they have sent everything, and an answer is lost when the connection is
    closed under them. So a bounded rest is taken in before it is.
    """

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on, and see to the rest."""
        if scope["type"] != "http" or not _has_body(scope):
            await self._app(scope, receive, send)
            return
        left = True

        async def received() -> Message:
            nonlocal left
            message = await receive()
            left = message.get("more_body", False)
            return message

        closing = False

        async def answered(message: Message) -> None:
            nonlocal closing
            if message["type"] == "http.response.start" and left:
                closing = True
                message = {**message, "headers": [*message.get("headers", ()), (b"connection", b"close")]}
            if closing and message["type"] == "http.response.body" and not message.get("more_body", False):
                await send({**message, "more_body": True})
                # No rest is waited for when the server ends.
                with contextlib.suppress(TimeoutError, ProblemError):
                    async with asyncio.timeout(READ_ON_S):
                        taken = 0
                        while left and taken <= READ_ON:
                            taken += len((await received()).get("body", b""))
                message = {"type": "http.response.body", "body": b""}
            await send(message)

        await self._app(scope, received, answered)


def _has_body(scope: Scope) -> bool:
    headers = dict(scope["headers"])
    # Who waits for "100 Continue" sends nothing once he is answered (RFC 9110, 10.1.1).
    sends = headers.get(b"content-length", b"0") != b"0" or b"transfer-encoding" in headers
    return sends and b"expect" not in headers
