"""The way to a viewer past ASGI: whole WebSocket frames are written into its transport."""

from __future__ import annotations

import contextlib
import socket
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import asyncio
    from collections.abc import Callable

DIRECT_LINE = "reina.direct_line"
"""Among a WebSocket's extensions of the scope, where the server's protocol offers it."""
UNSENT_BYTES = 16 * 1024
"""What the system takes of what is not on its way yet; what it does not take can still be dropped."""


class DirectLine:
    """A transport that takes frames until one of them has to wait.

    The protocol behind it tells when the transport holds something and when it does not any more; it goes on
    speaking for itself, in whole frames, in the opening and closing handshake and in pings.

    Args:
        transport: Of the protocol.
    """

    __slots__ = ("_transport", "is_full", "on_free")

    def __init__(self, transport: asyncio.Transport) -> None:
        self._transport = transport
        self.is_full = False
        """Whether a frame is still on its way into the system."""
        self.on_free: Callable[[], None] | None = None
        """Called when it is not any more."""
        transport.set_write_buffer_limits(high=0)
        opened = transport.get_extra_info("socket")
        option = getattr(socket, "TCP_NOTSENT_LOWAT", None)
        if opened is not None and option is not None:
            # Who does not come by TCP has no such bound, and nor does every system.
            with contextlib.suppress(OSError):
                opened.setsockopt(socket.IPPROTO_TCP, option, UNSENT_BYTES)

    def write(self, frame: bytes) -> None:
        """Send a frame on its way, unless the connection ends."""
        if not self._transport.is_closing():
            self._transport.write(frame)

    def resumed(self) -> None:
        """All has been taken."""
        self.is_full = False
        if self.on_free is not None:
            self.on_free()
