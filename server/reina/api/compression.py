"""Compression where it pays: JSON and the page, never frames, sound or models."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from starlette.middleware.gzip import GZipMiddleware

if TYPE_CHECKING:
    from starlette.types import ASGIApp, Receive, Scope, Send

LEAST_BYTES = 1000
PLAIN = re.compile(r"/api/v1/(sessions/[^/]+/(frames|song)|rigs/[^/]+/.+|examples/.+|lab/bvh)$")
"""Floats, sound and models hardly shrink, and their ranges and lengths are to stay what they are."""


class Compression:
    """ASGI middleware: gzip for all but `PLAIN`."""

    def __init__(self, app: ASGIApp) -> None:
        self._plain = app
        self._compressed = GZipMiddleware(app, minimum_size=LEAST_BYTES, compresslevel=5)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on, compressing the answer or not."""
        is_plain = scope["type"] != "http" or PLAIN.match(scope["path"])
        await (self._plain if is_plain else self._compressed)(scope, receive, send)
