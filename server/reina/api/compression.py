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
ANEW = re.compile(r"/api/v1/sessions/")
"""Answers that are written anew each time and waited for: a fifth larger, in less than half the time."""


class Compression:
    """ASGI middleware: gzip for all but `PLAIN`, and quickly for `ANEW`."""

    def __init__(self, app: ASGIApp) -> None:
        self._plain = app
        self._compressed = GZipMiddleware(app, minimum_size=LEAST_BYTES, compresslevel=5)
        self._quickly = GZipMiddleware(app, minimum_size=LEAST_BYTES, compresslevel=1)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on, compressing the answer or not."""
        if scope["type"] != "http" or PLAIN.match(scope["path"]):
            way = self._plain
        else:
            way = self._quickly if ANEW.match(scope["path"]) else self._compressed
        await way(scope, receive, send)
