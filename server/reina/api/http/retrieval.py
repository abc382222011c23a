"""What holds of every GET: HEAD beside it, a validator, and conditions (RFC 9110, 9.3.2 and 13)."""

from __future__ import annotations

import asyncio
import hashlib
from typing import TYPE_CHECKING

import anyio
from starlette.datastructures import Headers, MutableHeaders

from reina.api.http.conditions import NOT_MODIFIED, PRECONDITION_FAILED, precondition
from reina.api.http.problems import ProblemError

if TYPE_CHECKING:
    from starlette.types import ASGIApp, Message, Receive, Scope, Send

READING = frozenset({"GET", "HEAD"})
CONDITIONAL = frozenset({200, 206, NOT_MODIFIED, 416})
"""What a request would be answered with, were it not for its conditions: those come before its range."""
SENT_UNMODIFIED = frozenset(
    {b"cache-control", b"content-location", b"content-security-policy", b"etag", b"expires", b"vary"}
)
"""What stays of the headers (15.4.5), and a page's policy: what was kept by an older server may have none."""
AT_ONCE = 256 * 1024
"""Bytes that are hashed without a thread, within a fraction of a millisecond."""


class Retrieval:
    """ASGI middleware around everything that answers: GET is answered under its conditions, HEAD as GET is.

    What names no validator of its own and comes in one piece is given one by its bytes. Where there is no
    body to be sent, work on the answer ends with its headers.
    """

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on, or answer without a body."""
        if scope["type"] != "http" or scope["method"] not in READING:
            await self._app(scope, receive, send)
            return
        asked = Headers(scope=scope)
        head = scope["method"] == "HEAD"
        if head:
            # Ranges are defined for GET alone (14.2).
            headers = [(name, value) for name, value in scope["headers"] if name != b"range"]
            scope = {**scope, "method": "GET", "headers": headers}
        held: Message | None = None

        async def begin(start: Message) -> None:
            headers = Headers(raw=start["headers"])
            status = precondition(asked, headers) if start["status"] in CONDITIONAL else None
            if status == PRECONDITION_FAILED:
                await _changed(headers).response()(scope, receive, send)
                answered.cancel()
            elif status == NOT_MODIFIED or head:
                if status == NOT_MODIFIED:
                    kept = [header for header in start["headers"] if header[0].lower() in SENT_UNMODIFIED]
                    start = {**start, "status": status, "headers": kept}
                await send(start)
                await send({"type": "http.response.body"})
                answered.cancel()
            else:
                await send(start)

        async def checked(message: Message) -> None:
            nonlocal held
            if answered.cancel_called:
                return
            if message["type"] == "http.response.start":
                if _wants_validator(message):
                    held = message
                else:
                    await begin(message)
                return
            if held is not None:
                start, held = held, None
                if not message.get("more_body", False):
                    await _validate(start, message.get("body", b""))
                await begin(start)
            if not answered.cancel_called:
                await send(message)

        with anyio.CancelScope() as answered:
            await self._app(scope, receive, checked)


def _wants_validator(start: Message) -> bool:
    headers = Headers(raw=start["headers"])
    return start["status"] == 200 and "etag" not in headers and headers.get("cache-control") != "no-store"


async def _validate(start: Message, body: bytes) -> None:
    """Give an answer a validator by its bytes."""
    digest = hashlib.sha256(body) if len(body) <= AT_ONCE else await asyncio.to_thread(hashlib.sha256, body)
    headers = MutableHeaders(raw=start["headers"])
    headers["ETag"] = f'"{digest.hexdigest()[:24]}"'
    headers.setdefault("Cache-Control", "no-cache")


def _changed(headers: Headers) -> ProblemError:
    etag = headers.get("etag")
    return ProblemError(
        PRECONDITION_FAILED,
        "precondition-failed",
        "It is not what the request means",
        f"If-Match or If-Unmodified-Since does not hold: its validator is {etag or 'none'} now",
        headers={"ETag": etag} if etag else None,
    )
