"""The way to a viewer past ASGI, where the server's own protocol offers it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable

DIRECT_LINE = "reina.direct_line"
"""Where it is among the extensions of a WebSocket's scope."""
CLOSING_GRACE_S = 10.0
"""How long a viewer that is closed for being too slow is waited for."""


class DirectLine(Protocol):
    """A WebSocket whose frames are written into its transport, once it is accepted.

    Who takes it over need not stay: what is said at the other end is told by calls. So a viewer costs no
    task, and none of the middleware that let it in.
    """

    is_full: bool
    """Whether a frame is still on its way into the system."""
    on_free: Callable[[], None] | None
    """Called when it is not any more."""

    def write(self, frame: bytes) -> None:
        """Send a frame on its way, unless the connection ends."""
        ...

    def hand_over(self, hear: Callable[[str], None], gone: Callable[[], None]) -> None:
        """Keep the connection, though the application returns.

        Args:
            hear: Called with each message; with an empty one where it is not a text.
            gone: Called once, when nothing can be said any more.
        """
        ...

    async def close(self, code: int, reason: str) -> None:
        """Say goodbye, and wait for a while until that can be said."""
        ...
