"""No request is read into memory beyond a bound, whatever it is sent to and by whom."""

from __future__ import annotations

from typing import TYPE_CHECKING

from starlette.exceptions import HTTPException

from reina.api.problems import ProblemError
from reina.api.upload import MEGABYTE
from reina.protocol.links import API

if TYPE_CHECKING:
    from starlette.types import ASGIApp, Message, Receive, Scope, Send

MOST_BYTES = 32 * MEGABYTE
"""More than any body may have that is read as a whole; most are held to less by their routes."""
STREAMED = frozenset({f"{API}/sessions"})
"""Uploads go to files as they come, and have limits of their own."""


class BodyLimit:
    """ASGI middleware that refuses bodies over `MOST_BYTES`, declared or not."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on, counting what is read."""
        if scope["type"] != "http" or scope["path"] in STREAMED:
            await self._app(scope, receive, send)
            return
        declared = dict(scope["headers"]).get(b"content-length", b"")
        if declared.isdigit() and int(declared) > MOST_BYTES:
            problem = ProblemError(413, "content-too-large", "Content Too Large", _detail())
            await problem.response()(scope, receive, send)
            return
        read = 0

        async def counted() -> Message:
            nonlocal read
            message = await receive()
            read += len(message.get("body", b""))
            if read > MOST_BYTES:
                raise HTTPException(413, _detail())
            return message

        await self._app(scope, counted, send)


def _detail() -> str:
    return f"the body is larger than {MOST_BYTES // MEGABYTE} MB"
