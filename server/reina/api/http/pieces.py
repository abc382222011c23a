"""Large answers go out piece by piece: what somebody does not take is not handed to the connection."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from starlette.types import ASGIApp, Message, Receive, Scope, Send

PIECE = 64 * 1024
"""Bytes; as many wait in a connection anyway."""


class InPieces:
    """ASGI middleware: a long body is sent in pieces, each when the connection takes it.

    The server hands a body to the connection as a whole, which keeps what the other end does not read, and
    takes the answer for sent. So an answer ends when it has been taken, nearly, and counts until then.
    """

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on."""

        async def sent(message: Message) -> None:
            body = message.get("body", b"") if message["type"] == "http.response.body" else b""
            if len(body) <= PIECE:
                await send(message)
                return
            whole = memoryview(body)
            last = (len(body) - 1) // PIECE * PIECE
            for first in range(0, last, PIECE):
                await send({**message, "body": bytes(whole[first : first + PIECE]), "more_body": True})
            await send({**message, "body": bytes(whole[last:])})

        await self._app(scope, receive, sent if scope["type"] == "http" else send)
