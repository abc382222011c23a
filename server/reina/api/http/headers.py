"""Headers that stand on every answer and tell browsers what to keep from doing with it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from starlette.datastructures import MutableHeaders

from reina.api.http.conditions import NOT_MODIFIED
from reina.api.http.content_policy import DATA_POLICY

if TYPE_CHECKING:
    from starlette.types import ASGIApp, Message, Receive, Scope, Send

REFUSED_DEVICES = ("camera", "display-capture", "geolocation", "payment", "usb")
"""What the page never asks for. The microphone is not among them: browsers that tell which device sounds tell
it only to pages that could ask for it."""
PROTECTING = {
    "Content-Security-Policy": DATA_POLICY,
    "X-Content-Type-Options": "nosniff",
    # The page's address holds the id by which a session is watched: it is told to nobody else.
    "Referrer-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": ", ".join(f"{device}=()" for device in REFUSED_DEVICES),
}
"""Where an answer has none of its own. Pages have a policy of their own (`content_policy.page_policy`)."""
STARTS = frozenset({"http.response.start", "websocket.http.response.start"})


class ProtectingHeaders:
    """ASGI middleware: `PROTECTING` on whatever is answered, refusals among it."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on, and complete the answer's headers."""
        if scope["type"] not in {"http", "websocket"}:
            await self._app(scope, receive, send)
            return

        async def protected(message: Message) -> None:
            # Browsers put the headers of a 304 in place of those that they kept.
            if message["type"] in STARTS and message["status"] != NOT_MODIFIED:
                message = {**message, "headers": list(message.get("headers", ()))}
                headers = MutableHeaders(raw=message["headers"])
                for name, value in PROTECTING.items():
                    headers.setdefault(name, value)
            await send(message)

        await self._app(scope, receive, protected)
