"""The WebSocket protocol as uvicorn speaks it; what is no text ends its sender without a word in the log."""

from __future__ import annotations

import asyncio
import contextlib
import socket
from http import HTTPStatus
from typing import TYPE_CHECKING, Any, cast

from uvicorn.protocols.utils import ClientDisconnected
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
from websockets.protocol import State

from reina.api.http.direct_line import CLOSING_GRACE_S, DIRECT_LINE
from reina.cli.connections import Outflow
from reina.cli.server_config import connections_of

if TYPE_CHECKING:
    from collections.abc import Callable

    import uvicorn
    from uvicorn.server import ServerState
    from websockets.frames import Frame
    from websockets.http11 import Request

NO_TEXT = 1007
"""RFC 6455, 7.4.1: data that is not what its type says."""
UNSENT_BYTES = 16 * 1024
"""What the system takes of what is not on its way yet; what it does not take can still be dropped."""


class TextProtocol(WebSocketsSansIOProtocol):
    """Closes on text that is no UTF-8, where uvicorn writes a traceback of it, and is a `DirectLine`.

    A viewer that answers no ping is sent away by uvicorn; it is let go though it reads nothing of that.
    """

    def __init__(self, config: uvicorn.Config, server_state: ServerState, app_state: dict[str, Any]) -> None:
        super().__init__(config, server_state, app_state)
        self.outflow = Outflow()
        self._all = connections_of(config)
        self.is_full = False
        """Whether a frame is still on its way into the system."""
        self.on_free: Callable[[], None] | None = None
        """Called when it is not any more."""
        self._hear: Callable[[str], None] | None = None
        self._gone: Callable[[], None] | None = None

    # The direct line

    def write(self, frame: bytes) -> None:
        """Send a frame on its way, unless the connection ends."""
        if not self.transport.is_closing():
            self.transport.write(frame)

    def hand_over(self, hear: Callable[[str], None], gone: Callable[[], None]) -> None:
        """Keep the connection, though the application returns."""
        self._hear, self._gone = hear, gone
        while not self.queue.empty():
            said = self.queue.get_nowait()
            if said["type"] == "websocket.receive":
                hear(said.get("text") or "")
        if self.disconnected or self.transport.is_closing():
            self._end()
        elif self.read_paused:
            self.read_paused = False
            self.transport.resume_reading()

    async def close(self, code: int, reason: str) -> None:
        """Say goodbye; a viewer that does not read is told when it reads again, if it does so soon."""
        try:
            async with asyncio.timeout(CLOSING_GRACE_S):
                await self.send({"type": "websocket.close", "code": code, "reason": reason})
        except TimeoutError:
            self.transport.close()
        except (ClientDisconnected, RuntimeError):
            pass  # it has gone, or one end has closed already
        self._end()

    def _end(self) -> None:
        """Nothing is said any more."""
        gone, self._gone, self._hear, self.on_free = self._gone, None, None, None
        if gone is not None:
            gone()

    # What uvicorn calls

    def handle_connect(self, event: Request) -> None:
        """Begin to answer, with the transport at the application's hand."""
        super().handle_connect(event)
        if self.response.status_code != HTTPStatus.SWITCHING_PROTOCOLS:
            return
        extensions = cast("dict[str, object]", self.scope.get("extensions"))
        extensions[DIRECT_LINE] = self
        # What the system does not take at once waits here, where it can still be dropped.
        self.transport.set_write_buffer_limits(high=0)
        opened, option = self.transport.get_extra_info("socket"), getattr(socket, "TCP_NOTSENT_LOWAT", None)
        if opened is not None and option is not None:
            # Who does not come by TCP has no such bound, and nor does every system.
            with contextlib.suppress(OSError):
                opened.setsockopt(socket.IPPROTO_TCP, option, UNSENT_BYTES)

    async def run_asgi(self) -> None:
        """Have the application answer; a connection that it handed over goes on without it."""
        try:
            app = cast("Any", self.app)  # pyright: ignore[reportUnknownMemberType]
            await app(self.scope, self.receive, self.send)
        except ClientDisconnected:
            pass
        except Exception:
            self.logger.exception("Exception in ASGI application\n")
        self.send_500_response()  # if nothing has been answered
        # It is among its own extensions; and what is held for each viewer of thousands is to be little.
        del self.scope, self.request, self.response
        if self._gone is None and self.close_timer is None:
            self.transport.close()

    def handle_close(self, event: Frame) -> None:
        """The viewer says goodbye, or answers to ours."""
        super().handle_close(event)
        self._end()

    def keepalive_timeout(self) -> None:
        """The viewer has answered no ping."""
        super().keepalive_timeout()
        self._end()

    def shutdown(self) -> None:
        """The server ends."""
        super().shutdown()
        self._end()

    def handle_parser_exception(self) -> None:
        """What the viewer sends is none of the protocol."""
        super().handle_parser_exception()
        self._end()

    def connection_lost(self, exc: Exception | None) -> None:
        """The viewer has gone."""
        super().connection_lost(exc)
        self._all.closed(self)
        self._end()

    def pause_writing(self) -> None:
        """What is sent has to wait."""
        super().pause_writing()
        self.is_full = True

    def resume_writing(self) -> None:
        """What was sent has been taken."""
        self.outflow.resumed = True
        super().resume_writing()
        self.is_full = False
        if self.on_free is not None:
            self.on_free()

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
        elif self._hear is not None:
            said, self.frames = b"".join(self.frames), []
            self._hear(said.decode() if self.curr_msg_data_type == "text" else "")
        else:
            super().send_receive_event_to_app()


def _is_utf8(data: bytes) -> bool:
    try:
        data.decode()
    except UnicodeDecodeError:
        return False
    return True
