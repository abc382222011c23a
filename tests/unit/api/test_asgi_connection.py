"""A viewer behind an ASGI server that offers no direct line."""

from __future__ import annotations

import asyncio
from typing import Any

import pytest
from fastapi import WebSocket

from reina.api.stream import AsgiConnection
from reina.protocol.websocket import binary_frame, text_frame
from reina.sessions.viewer import FRAMES_WAITING, Viewer


class Server:
    """What an ASGI server is to an application: it takes messages one by one, when it is let."""

    def __init__(self) -> None:
        self.sent: list[dict[str, Any]] = []
        self.open = asyncio.Event()
        self.open.set()
        self.lost = False

    async def send(self, message: Any) -> None:
        await self.open.wait()
        if self.lost:
            raise OSError("the viewer has gone")
        self.sent.append(message)

    async def receive(self) -> Any:
        return {"type": "websocket.connect"}

    async def connection(self) -> AsgiConnection:
        socket = WebSocket({"type": "websocket", "headers": []}, self.receive, self.send)
        await socket.accept()
        self.sent.clear()
        return AsgiConnection(socket, asyncio.timeout(None))


async def settle() -> None:
    for _ in range(100):
        await asyncio.sleep(0)


@pytest.mark.parametrize("lost", [False, True])
def test_it_is_sent_what_was_posted_and_loses_the_oldest_frames_while_it_lags(*, lost: bool) -> None:
    async def scenario() -> None:
        server = Server()
        viewer = Viewer(await server.connection())
        server.open.clear()
        for number in range(100):
            viewer.post_frames(binary_frame(b"%d" % number))
        viewer.post_text(text_frame("before frames that wait"))
        await settle()
        assert viewer.dropped == 99 - FRAMES_WAITING
        assert server.sent == []
        server.lost = lost
        server.open.set()
        await settle()
        said = [message.get("bytes", message.get("text")) for message in server.sent]
        waited = [b"%d" % number for number in range(100 - FRAMES_WAITING, 100)]
        assert said == ([] if lost else [b"0", "before frames that wait", *waited])

    asyncio.run(scenario())


def test_it_is_told_why_it_is_closed() -> None:
    async def scenario() -> None:
        server = Server()
        viewer = Viewer(await server.connection())
        viewer.end(1001, "the session has ended")
        await settle()
        assert server.sent == [{"type": "websocket.close", "code": 1001, "reason": "the session has ended"}]

    asyncio.run(scenario())
