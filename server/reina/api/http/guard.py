"""Whom the server answers: hosts that it was told, and writes and streams from its own origin only.

The first keeps a foreign page from reaching a local server under a name of its own (DNS rebinding); the
second keeps it from writing or watching in its visitor's name.
"""

from __future__ import annotations

from typing import TYPE_CHECKING
from urllib.parse import urlsplit

from reina.api.http.problems import ProblemError

if TYPE_CHECKING:
    from starlette.types import ASGIApp, Receive, Scope, Send

    from reina.api.settings import Settings

READING = frozenset({"GET", "HEAD", "OPTIONS"})
NO_HOST = frozenset("@/?#\\ \t")
"""What stands in no Host header (RFC 9110, 7.2): a user's name, say, behind which another host would hide."""
DEFAULT_PORTS = {"http": 80, "https": 443, "ws": 80, "wss": 443}


class Guard:
    """ASGI middleware that refuses other hosts, and writes and WebSockets from other origins."""

    def __init__(self, app: ASGIApp, settings: Settings) -> None:
        self._app = app
        self._hosts = settings.allowed_hosts
        self._origins = settings.allowed_origins

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on, or refuse."""
        if scope["type"] in {"http", "websocket"} and (problem := self._objection(scope)):
            await problem.response()(scope, receive, send)
            return
        await self._app(scope, receive, send)

    def _objection(self, scope: Scope) -> ProblemError | None:
        headers = {name: value.decode("latin-1") for name, value in scope["headers"]}
        named = headers.get(b"host", "")
        host = None if NO_HOST & set(named) else _split(f"//{named}", scope["scheme"])
        if host is None or host[0] not in self._hosts:
            return ProblemError(
                421,
                "unknown-host",
                "The server does not answer to this host name",
                f"it answers to {', '.join(sorted(self._hosts))}; more by --allow-host",
            )
        origin = headers.get(b"origin")
        writes = scope["type"] == "websocket" or scope["method"] not in READING
        if origin is None or not writes or origin in self._origins:
            return None
        # The scheme is left out of it: a proxy in front may speak TLS where the server does not.
        if origin != "null" and _split(origin, scope["scheme"]) == host:
            return None
        return ProblemError(
            403,
            "foreign-origin",
            "This page may not do that here",
            f"the request came from {origin}; writes and streams are taken from the server's own page only, "
            "and from origins named by --allow-origin",
        )


def _split(address: str, scheme: str) -> tuple[str, int] | None:
    """Host name and port of an address; None when it has none."""
    try:
        parts = urlsplit(address)
        port = parts.port or DEFAULT_PORTS.get(parts.scheme or scheme, 80)
    except ValueError:
        return None
    return (parts.hostname, port) if parts.hostname else None
