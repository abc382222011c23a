"""What never comes to the application, since it is no HTTP request or no handshake, is a problem too."""

from __future__ import annotations

import base64
import binascii
from http import HTTPStatus

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

from reina.api.http.headers import PROTECTING
from reina.api.http.problems import ProblemError

WEBSOCKET_VERSION = b"13"
KEY_BYTES = 16
PROTECTING_RAW = [(name.lower().encode(), value.encode()) for name, value in PROTECTING.items()]


class ProblemProtocol(H11Protocol):
    """HTTP as uvicorn speaks it, but for the refusals that it sends of itself: they are problem details."""

    def send_400_response(self, msg: str) -> None:  # noqa: ARG002 - uvicorn's words say less
        """Refuse what cannot be read as a request."""
        detail = (
            "this is no HTTP/1.1 request, or its headers are larger than 64 kB: a method, an address, "
            "a version and a Host header are needed"
        )
        self._refuse(ProblemError(400, "not-http", "Bad Request", detail))

    def handle_websocket_upgrade(self, event: h11.Request) -> None:
        """Pass a handshake on, if it is one (RFC 6455, 4.2.1)."""
        headers = dict(event.headers)
        version = headers.get(b"sec-websocket-version", b"")
        if event.method != b"GET" or not _is_key(headers.get(b"sec-websocket-key", b"")):
            detail = "a WebSocket is opened by GET with a Sec-WebSocket-Key of 16 bytes in base64"
            self._refuse(ProblemError(400, "not-a-handshake", "Bad Request", detail))
        elif version != WEBSOCKET_VERSION:
            told = {"Sec-WebSocket-Version": WEBSOCKET_VERSION.decode()}
            detail = (
                f"this server speaks version 13 of the WebSocket protocol, not {version.decode('latin-1')!r}"
            )
            self._refuse(ProblemError(426, "other-websocket", "Upgrade Required", detail, headers=told))
        else:
            super().handle_websocket_upgrade(event)

    def _refuse(self, problem: ProblemError) -> None:
        response = problem.response()
        status = HTTPStatus(problem.status)
        headers = [*response.raw_headers, *PROTECTING_RAW, (b"connection", b"close")]
        for event in (
            h11.Response(status_code=status, headers=headers, reason=status.phrase.encode()),
            h11.Data(data=bytes(response.body)),
            h11.EndOfMessage(),
        ):
            self.transport.write(self.conn.send(event) or b"")
        self.transport.close()


def _is_key(value: bytes) -> bool:
    try:
        return len(base64.b64decode(value.strip(), validate=True)) == KEY_BYTES
    except binascii.Error:
        return False
