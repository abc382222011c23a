"""HTTP as it is spoken here: what is no request is a problem too, and nobody keeps the server waiting."""

from __future__ import annotations

import base64
import binascii
import math
from http import HTTPStatus
from typing import TYPE_CHECKING, Any

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

from reina.api.http.headers import PROTECTING
from reina.api.http.problems import ProblemError
from reina.cli.connections import Outflow
from reina.cli.server_config import connections_of
from reina.cli.websocket_protocol import TextProtocol

if TYPE_CHECKING:
    import asyncio
    from collections.abc import Sequence

    import uvicorn
    from starlette.types import ASGIApp, Receive, Scope, Send
    from uvicorn.server import ServerState

WEBSOCKET_VERSION = b"13"
KEY_BYTES = 16
PROTECTING_RAW = [(name.lower().encode(), value.encode()) for name, value in PROTECTING.items()]


class ProblemProtocol(H11Protocol):
    """HTTP as uvicorn speaks it, but for the refusals that it sends of itself: they are problem details.

    Whoever sends half a head, or a body too slowly, has 408.
    """

    def __init__(
        self,
        config: uvicorn.Config,
        server_state: ServerState,
        app_state: dict[str, Any],
        _loop: asyncio.AbstractEventLoop | None = None,
    ) -> None:
        super().__init__(config, server_state, app_state, _loop)
        self.outflow = Outflow()
        self._all = connections_of(config)
        self._asked = False
        """Whether a request has come over it."""
        self._waiting_since = math.inf
        """From when on a request is waited for; it is not while one is answered."""
        self._begun = False
        """Whether a part of it is there, or of a body that nobody waits for any more."""
        self._received = 0
        self._body: tuple[float, int] | None = None
        """Since when a body has come more slowly than the floor, and what had been received by then."""

    @property
    def app(self) -> ASGIApp:  # type: ignore[override]
        """What answers a request; made anew each time, since a connection that held itself would stay."""
        return self._admitted

    @app.setter
    def app(self, answering: ASGIApp) -> None:
        self._answering = answering

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Somebody has come."""
        super().connection_made(transport)  # type: ignore[arg-type]
        self._waiting_since = self.loop.time()
        self._all.opened(self, self._peer)

    def connection_lost(self, exc: Exception | None) -> None:
        """Somebody has gone."""
        super().connection_lost(exc)
        self._all.closed(self)

    def data_received(self, data: bytes) -> None:
        """Something has come."""
        self._received += len(data)
        super().data_received(data)
        if self.transport.get_protocol() is self:
            self._note()

    def resume_writing(self) -> None:
        """What was sent has been taken."""
        self.outflow.resumed = True
        super().resume_writing()

    def on_response_complete(self) -> None:
        """An answer has been sent."""
        super().on_response_complete()
        # A timer for each connection is not needed: they are looked at in turn.
        self._unset_keepalive_if_required()
        if not self.transport.is_closing():
            self._note()

    def overdue(self, now: float) -> bool:
        """Whether it has kept us waiting for too long; then it is closed, with 408 if it began a request."""
        limits = self._all.limits
        waits_s = limits.idle_s if self._asked and not self._begun else limits.header_s
        if now - self._waiting_since >= waits_s:
            if self._begun and self.conn.our_state is h11.IDLE:
                self._refuse(_too_slow(f"the head of a request comes within {limits.header_s:g} seconds"))
            else:
                self.transport.abort()
            return True
        if not self._body_is_late(now):
            return False
        if self.conn.our_state is h11.SEND_RESPONSE:
            floor = f"{limits.floor_bytes / 1000:g} kB"
            detail = f"less than {floor} of the body came within {limits.stall_s:g} seconds; send it faster"
            self._refuse(_too_slow(detail))
            # Whoever reads the body hears that it ends here, and clears away what came of it.
            self.cycle.disconnected = True
            self.cycle.message_event.set()
        else:
            self.transport.abort()
        return True

    def drop(self) -> None:
        """End it at once."""
        self.transport.abort()

    def send_400_response(self, msg: str) -> None:  # noqa: ARG002 - uvicorn's words say less
        """Refuse what cannot be read as a request."""
        detail = (
            "this is no HTTP/1.1 request, or its headers are larger than 64 kB: a method, an address, "
            "a version and a Host header are needed"
        )
        self._refuse(ProblemError(400, "not-http", "Bad Request", detail))

    def handle_websocket_upgrade(self, event: h11.Request) -> None:
        """Pass a handshake on, if it is one (RFC 6455, 4.2.1), and if there is a place to watch."""
        headers = dict(event.headers)
        version = headers.get(b"sec-websocket-version", b"")
        self._all.busy(self)
        if event.method != b"GET" or not _is_key(headers.get(b"sec-websocket-key", b"")):
            detail = "a WebSocket is opened by GET with a Sec-WebSocket-Key of 16 bytes in base64"
            self._refuse(ProblemError(400, "not-a-handshake", "Bad Request", detail))
        elif version != WEBSOCKET_VERSION:
            told = {"Sec-WebSocket-Version": WEBSOCKET_VERSION.decode()}
            detail = (
                f"this server speaks version 13 of the WebSocket protocol, not {version.decode('latin-1')!r}"
            )
            self._refuse(ProblemError(426, "other-websocket", "Upgrade Required", detail, headers=told))
        elif problem := self._all.admit_watcher(self, self._peer, self._told(self.headers)):
            self._refuse(problem)
        else:
            super().handle_websocket_upgrade(event)
            watching = self.transport.get_protocol()
            if isinstance(watching, TextProtocol):
                self._all.watches(watching, self)

    @property
    def _peer(self) -> str:
        return self.client[0] if self.client else ""

    def _told(self, headers: Sequence[tuple[bytes, bytes]]) -> str:
        """Who asks."""
        return self._all.proxies.client_of(self._peer, headers)

    @property
    def _is_busy(self) -> bool:
        """Whether a request is being answered."""
        # There is none before the first, which uvicorn's types do not say.
        return bool(self.cycle) and not self.cycle.response_complete

    def _note(self) -> None:
        """Take note of what is waited for now."""
        if self._is_busy:
            self._waiting_since, self._begun, self._asked = math.inf, False, True
            self._all.busy(self)
            return
        if self._waiting_since == math.inf:
            self._all.idle(self)
        begun = bool(self.conn.trailing_data[0]) or self.conn.their_state is h11.SEND_BODY
        # The first request is waited for from the connection's beginning on.
        if self._waiting_since == math.inf or (self._asked and begun != self._begun):
            self._waiting_since = self.loop.time()
        self._begun = begun

    def _body_is_late(self, now: float) -> bool:
        """Whether a body is waited for, and less than the floor came of it for a while."""
        awaited = self.conn.their_state is h11.SEND_BODY and not (
            self.flow.read_paused or self.cycle.waiting_for_100_continue
        )
        limits = self._all.limits
        if not awaited:
            self._body = None
        elif self._body is None or self._received - self._body[1] >= limits.floor_bytes:
            self._body = (now, self._received)
        return self._body is not None and now - self._body[0] >= limits.stall_s

    async def _admitted(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request, if there is a place for it."""
        problem = self._all.admit(self, self._peer, self._told(scope["headers"]))
        if problem:
            await problem.response()(scope, receive, send)
        else:
            await self._answering(scope, receive, send)

    def _refuse(self, problem: ProblemError) -> None:
        response = problem.response()
        status = HTTPStatus(problem.status)
        headers = [entry for entry in response.raw_headers if entry[0] != b"connection"]
        headers += [*PROTECTING_RAW, (b"connection", b"close")]
        for event in (
            h11.Response(status_code=status, headers=headers, reason=status.phrase.encode()),
            h11.Data(data=bytes(response.body)),
            h11.EndOfMessage(),
        ):
            self.transport.write(self.conn.send(event) or b"")
        self.transport.close()


def _too_slow(detail: str) -> ProblemError:
    return ProblemError(408, "too-slow", "Request Timeout", detail)


def _is_key(value: bytes) -> bool:
    try:
        return len(base64.b64decode(value.strip(), validate=True)) == KEY_BYTES
    except binascii.Error:
        return False
