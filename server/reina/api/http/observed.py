"""Each request seen from outside: an id that its answer and the log share, and what is counted of it."""

from __future__ import annotations

import re
import secrets
import time
from typing import TYPE_CHECKING, cast

import structlog
from starlette.datastructures import Headers, MutableHeaders

from reina.api.http.problems import METHODS, ProblemError
from reina.api.http.request_id import request_id
from reina.protocol.links import API
from reina.system.logs import EACH, logger, shown_session
from reina.system.metrics import REQUEST_SECONDS, REQUESTS, tally

if TYPE_CHECKING:
    from collections.abc import MutableMapping
    from typing import Any

    from starlette.types import ASGIApp, Message, Receive, Scope, Send

HEADER = "X-Request-ID"
PLAIN_ID = re.compile(r"[A-Za-z0-9._-]{8,36}")
"""An id that is taken over from a proxy: a UUID is as long as the longest, a control token is longer."""
_SESSION = re.compile(re.escape(API) + r"/sessions/([\w-]{22})(?:/|$)", re.ASCII)
_KNOWN_METHODS = frozenset({*METHODS, "HEAD", "OPTIONS"})
NO_ROUTE, OTHER_METHOD = "none", "other"
_NOTES = "reina.notes"

_log = logger(__name__)


class Observed:
    """ASGI middleware, the outermost: gives a request its id, counts it, answers what failed unexpectedly.

    Args:
        app: What answers.
        log_requests: Whether each request is a line in the log.
    """

    def __init__(self, app: ASGIApp, *, log_requests: bool = False) -> None:
        self._app = app
        self._log_requests = log_requests

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on, and see what becomes of it."""
        if scope["type"] not in {"http", "websocket"}:
            await self._app(scope, receive, send)
            return
        asked = Headers(scope=scope).get(HEADER, "")
        known_by = asked if PLAIN_ID.fullmatch(asked) else secrets.token_hex(8)
        session = _SESSION.match(scope["path"])
        bound = {"request_id": known_by}
        if session:
            bound["session"] = shown_session(session[1])
        token = request_id.set(known_by)
        try:
            with structlog.contextvars.bound_contextvars(**bound):
                await self._observe(scope, receive, send, known_by)
        finally:
            request_id.reset(token)

    async def _observe(self, scope: Scope, receive: Receive, send: Send, known_by: str) -> None:
        begun = time.perf_counter()
        status = 0
        notes: dict[str, str] = {}

        async def sent(message: Message) -> None:
            nonlocal status
            kind = message["type"]
            if kind in {"http.response.start", "websocket.http.response.start", "websocket.accept"}:
                status = message.get("status", 101)
                headers = list(message.get("headers", ()))
                message = {**message, "headers": headers}
                MutableHeaders(raw=headers)[HEADER] = known_by
            elif kind == "http.response.body":
                tally.answer_bytes += len(message.get("body", b""))
            await send(message)

        try:
            await self._app({**scope, _NOTES: notes}, receive, sent)
        except Exception as error:
            _log.error("a request failed", method=scope.get("method"), route=_route(notes), exc_info=error)
            if status or scope["type"] == "websocket":
                # Its connection is closed by whoever serves it.
                raise
            await _own_mistake().response()(scope, receive, sent)
        finally:
            self._count(scope, _route(notes), status, time.perf_counter() - begun)

    def _count(self, scope: Scope, route: str, status: int, took_s: float) -> None:
        method = scope.get("method", "GET")
        method = method if method in _KNOWN_METHODS else OTHER_METHOD
        REQUESTS.labels(route, method, str(status)).inc()
        if scope["type"] == "http":
            REQUEST_SECONDS.labels(route).observe(took_s)
        if self._log_requests:
            _log.info(
                "request",
                **EACH,
                method=method,
                route=route,
                status=status,
                took_ms=round(took_s * 1000, 1),
            )


class RouteNoted:
    """ASGI middleware, the innermost: tells `Observed` which route a request came to.

    Args:
        app: The router.
    """

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on; the router notes in the scope what it has found."""
        try:
            await self._app(scope, receive, send)
        finally:
            path = getattr(scope.get("route"), "path", None)
            if isinstance(path, str):
                notes = cast("MutableMapping[str, Any]", scope.get(_NOTES, {}))
                notes["route"] = path


def _route(notes: MutableMapping[str, str]) -> str:
    return notes.get("route", NO_ROUTE)


def _own_mistake() -> ProblemError:
    detail = "the server made a mistake and has noted it; the request may be tried again"
    return ProblemError(500, "internal", "Internal Server Error", detail)
