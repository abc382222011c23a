"""The WebSocket protocol as uvicorn speaks it; what is no text ends its sender without a word in the log."""

from __future__ import annotations

from http import HTTPStatus
from typing import TYPE_CHECKING, Any, cast

from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
from websockets.protocol import State

from reina.api.http.direct_line import DIRECT_LINE, DirectLine
from reina.cli.connections import Outflow
from reina.cli.server_config import connections_of

if TYPE_CHECKING:
    import uvicorn
    from uvicorn.server import ServerState
    from websockets.http11 import Request

NO_TEXT = 1007
"""RFC 6455, 7.4.1: data that is not what its type says."""


class TextProtocol(WebSocketsSansIOProtocol):
    """Closes on text that is no UTF-8, where uvicorn writes a traceback of it, and offers a `DirectLine`.

    A viewer that answers no ping is sent away by uvicorn; it is let go though it reads nothing of that.
    """

    def __init__(self, config: uvicorn.Config, server_state: ServerState, app_state: dict[str, Any]) -> None:
        super().__init__(config, server_state, app_state)
        self.outflow = Outflow()
        self._all = connections_of(config)
        self._line: DirectLine | None = None

    def handle_connect(self, event: Request) -> None:
        """Offer who sends much the transport itself."""
        super().handle_connect(event)
        if self.response.status_code == HTTPStatus.SWITCHING_PROTOCOLS:
            self._line = DirectLine(self.transport)
            extensions = cast("dict[str, object]", self.scope.get("extensions"))
            extensions[DIRECT_LINE] = self._line

    def connection_lost(self, exc: Exception | None) -> None:
        """The viewer has gone."""
        super().connection_lost(exc)
        self._all.closed(self)

    def pause_writing(self) -> None:
        """What is sent has to wait."""
        super().pause_writing()
        if self._line is not None:
            self._line.is_full = True

    def resume_writing(self) -> None:
        """What was sent has been taken."""
        self.outflow.resumed = True
        super().resume_writing()
        if self._line is not None:
            self._line.resumed()

    def overdue(self, now: float) -> bool:  # noqa: ARG002 - its pings have timers of their own
        """Never: who is silent is pinged."""
        return False

    def drop(self) -> None:
        """End it at once."""
        self.transport.abort()

    def send_receive_event_to_app(self) -> None:
        """Pass a whole message on, if it is one."""
        if self.transport.is_closing():
            # It came in one piece with what ended its sender.
            self.frames = []
        elif self.curr_msg_data_type == "text" and not _is_utf8(b"".join(self.frames)):
            self.frames = []
            if self.conn.state is State.OPEN:
                self.conn.send_close(NO_TEXT)
                self.handle_parser_exception()
            # Else one end has closed already, and nothing is said after that.
        else:
            super().send_receive_event_to_app()


def _is_utf8(data: bytes) -> bool:
    try:
        data.decode()
    except UnicodeDecodeError:
        return False
    return True
