"""Request bodies: who may send one is decided first, then how large it may be, and then it is read."""

from __future__ import annotations

import asyncio
import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from fastapi import Request
from fastapi.routing import APIRoute
from starlette.routing import compile_path

from reina.api.http import paths
from reina.api.http.access import admit
from reina.api.http.problems import ProblemError
from reina.api.http.upload_limits import FILE_LIMITS, MAX_BYTES, MEGABYTE
from reina.protocol.links import API

if TYPE_CHECKING:
    from collections.abc import AsyncGenerator, Callable, Coroutine

    from starlette.responses import Response

READING = frozenset({"GET", "HEAD"})


@dataclass(frozen=True)
class BodyLimit:
    """How large a body may be.

    Attributes:
        most_bytes: So large.
        name: What it is called where it is larger.
    """

    most_bytes: int
    name: str = "body"

    @property
    def shown(self) -> str:
        """So large, for people."""
        most = self.most_bytes
        return f"{most / MEGABYTE:g} MB" if most >= MEGABYTE else f"{most / 1000:g} kB"


SMALL = BodyLimit(16_000)
"""Commands, changes of single fields, what the laboratory is asked."""
SHOW = BodyLimit(FILE_LIMITS["show"], "show")
CLIP = BodyLimit(20 * MEGABYTE, "clip")
TRACK = BodyLimit(MEGABYTE, "track")
ALIGNMENT = BodyLimit(MEGABYTE, "alignment")
"""A map has a point for each beat, some 65 bytes: two hours of music. What a page puts back by undo or from a
file is as long as what it was given."""
BODY_LIMITS: dict[tuple[str, str], BodyLimit] = {
    ("POST", "/sessions"): BodyLimit(MAX_BYTES, "upload"),
    ("PUT", "/sessions/{session_id}/song/analysis"): BodyLimit(FILE_LIMITS["song"], "sound"),
    ("PUT", "/sessions/{session_id}/alignment"): ALIGNMENT,
    ("POST", "/transcriptions"): BodyLimit(MAX_BYTES, "upload"),
    ("PUT", "/sessions/{session_id}/show"): SHOW,
    ("POST", "/sessions/{session_id}/show/edits"): BodyLimit(4 * MEGABYTE, "edits"),
    ("PUT", paths.TRACK): TRACK,
    ("POST", "/sessions/{session_id}/show/curves"): TRACK,
    ("POST", "/files/role"): BodyLimit(MEGABYTE, "file"),
    ("POST", "/sessions/{session_id}/stances"): CLIP,
    ("POST", "/lab/bvh"): CLIP,
    ("POST", "/lab/bvh/rewritten"): CLIP,
}
"""By method and address; every other body is `SMALL`."""
_PATTERNS = [(method, compile_path(path)[0], limit) for (method, path), limit in BODY_LIMITS.items()]
MOST_FIELDS = 100
"""No body that is read field by field has so many, nor has any object in it."""
AT_ONCE = 64_000
"""Bytes of JSON that are parsed without a thread, within a millisecond."""


class BoundedRoute(APIRoute):
    """A route that reads no byte of a body before session and token are known to be good, nor beyond a bound.

    FastAPI itself reads and parses a whole body first, of whatever size, and asks for the token then.
    """

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """As of every route, behind these checks."""
        handle = super().get_route_handler()
        if not (self.methods or set[str]()) - READING:
            return handle

        async def bounded(request: Request) -> Response:
            await admit(request, self.dependant)
            checked = BoundedRequest(request, _limit_of(request))
            if self.body_field is not None and len(await checked.body()) > AT_ONCE:
                await checked.check_fields()
            return await handle(checked)

        return bounded


def _limit_of(request: Request) -> BodyLimit:
    path = request.scope["path"].removeprefix(API)
    return next(
        (limit for method, pattern, limit in _PATTERNS if method == request.method and pattern.match(path)),
        SMALL,
    )


def _route_of(request: Request) -> str:
    """What is asked, with names in the place of what varies."""
    path: str = request.scope["path"]
    for name, value in request.path_params.items():
        path = path.replace(f"/{value}", f"/{{{name}}}", 1)
    return path


class BoundedRequest(Request):
    """A request whose body is held to a bound while it is read, and parsed on a thread where it is long.

    Args:
        request: As it came.
        limit: How large its body may be.
    """

    def __init__(self, request: Request, limit: BodyLimit) -> None:
        super().__init__(request.scope, request.receive)
        self._limit = limit
        self._fields = 0

    async def stream(self) -> AsyncGenerator[bytes, None]:
        """The body in pieces.

        Raises:
            ProblemError: 413 when it is too large, as it says itself or as it turns out.
        """
        declared = self.headers.get("content-length", "")
        if declared.isdigit() and int(declared) > self._limit.most_bytes:
            raise self._too_large()
        read = 0
        async for chunk in super().stream():
            read += len(chunk)
            if read > self._limit.most_bytes:
                raise self._too_large()
            yield chunk

    async def json(self) -> Any:
        """The body as JSON."""
        if not hasattr(self, "_json"):
            body = await self.body()
            short = len(body) <= AT_ONCE
            self._json, self._fields = read_json(body) if short else await asyncio.to_thread(read_json, body)
        return self._json

    async def check_fields(self) -> None:
        """Refuse a long body with more fields than any request has, each of which would be told on its own.

        What stands within it counts too: one entry of a list may hold as many as a body.

        Raises:
            ProblemError: 422.
        """
        try:
            await self.json()
        except (ValueError, RecursionError):
            return  # It is told where it is read.
        if self._fields > MOST_FIELDS:
            detail = (
                f"the body has {self._fields} fields in one object; no request has more than {MOST_FIELDS}"
            )
            raise ProblemError(422, "request-invalid", "The request does not fit", detail)

    def _too_large(self) -> ProblemError:
        name, asked = self._limit.name, f"{self.method} {_route_of(self)}"
        detail = f"this {name} is larger than {self._limit.shown}, the most that {asked} takes"
        return ProblemError(413, f"{name}-too-large", "Content Too Large", detail)


def read_json(data: bytes) -> tuple[Any, int]:
    """Parse JSON so that other threads have their turns.

    The parser is one call, which holds the interpreter's lock until it returns unless it calls something in
    Python: here a function at every object, which counts its fields.

    Returns:
        What it holds, and how many fields the object in it has that has most.

    Raises:
        ValueError: It is no JSON.
        RecursionError: It is nested too deeply.
    """
    most = 0

    def counted(fields: dict[str, Any]) -> dict[str, Any]:
        nonlocal most
        most = max(most, len(fields))
        return fields

    return json.loads(data, object_hook=counted), most
