"""The WebSocket protocol as uvicorn speaks it; what is no text ends its sender without a word in the log."""

from __future__ import annotations

from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
from websockets.protocol import State

NO_TEXT = 1007
"""RFC 6455, 7.4.1: data that is not what its type says."""


class TextProtocol(WebSocketsSansIOProtocol):
    """Closes on text that is no UTF-8, where uvicorn writes a traceback of it."""

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
