"""Compression where it pays: JSON and the page, never frames, sound or models."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from starlette.datastructures import MutableHeaders
from starlette.middleware.gzip import GZipMiddleware

if TYPE_CHECKING:
    from starlette.types import ASGIApp, Message, Receive, Scope, Send

MIN_BYTES = 1000
PLAIN = re.compile(r"/api/v1/(sessions/[^/]+/(frames|song|blocks/.+)|rigs/[^/]+/.+|examples/.+|lab/bvh)$")
"""Floats, sound and models hardly shrink, and their ranges and lengths are to stay what they are."""
REFUSED = re.compile(rb"(^|,)\s*gzip\s*;\s*q=0(\.0*)?\s*(,|$)", re.IGNORECASE)
"""gzip is named as what is not wanted (RFC 9110, 12.4.2)."""
ANEW = re.compile(r"/api/v1/sessions/")
"""Answers that are written anew each time and waited for: a fifth larger, in less than half the time."""


class Compression:
    """ASGI middleware: gzip for all but `PLAIN`, and quickly for `ANEW`."""

    def __init__(self, app: ASGIApp) -> None:
        self._plain = app
        self._compressed = GZipMiddleware(app, minimum_size=MIN_BYTES, compresslevel=5)
        self._quickly = GZipMiddleware(app, minimum_size=MIN_BYTES, compresslevel=1)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on, compressing the answer or not."""
        if scope["type"] != "http" or PLAIN.match(scope["path"]):
            await self._plain(scope, receive, send)
            return
        headers = [
            (name, value)
            for name, value in scope["headers"]
            if name != b"accept-encoding" or not REFUSED.search(value)
        ]
        scope = {**scope, "headers": headers}
        if ANEW.match(scope["path"]):
            # These validators name a state, in whatever form it is sent, and writes are made on top of it.
            await self._quickly(scope, receive, send)
            return

        async def marked(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(raw=message["headers"])
                etag = headers.get("etag")
                if etag and headers.get("content-encoding") == "gzip":
                    # Other bytes, another validator (RFC 9110, 8.8.3.3).
                    headers["ETag"] = f'{etag[:-1]}+gzip"'
            await send(message)

        await self._compressed(scope, receive, marked)
