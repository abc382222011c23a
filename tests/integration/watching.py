"""Watching a session over a real WebSocket."""

from __future__ import annotations

import asyncio
import json
from contextlib import asynccontextmanager
from typing import TYPE_CHECKING, Any

import websockets

from reina.protocol import SUBPROTOCOL, Frames, Manifest, decode

if TYPE_CHECKING:
    from collections.abc import AsyncGenerator, Callable

    from tests.integration.server import Running
    from websockets.asyncio.client import ClientConnection

PATIENCE_S = 15.0


class Watcher:
    """Collects what a session sends."""

    def __init__(self, socket: ClientConnection, hello: dict[str, Any]) -> None:
        self.socket = socket
        self.hello = hello
        self.manifest = Manifest.model_validate({name: hello[name] for name in Manifest.model_fields})
        self.texts: list[dict[str, Any]] = []
        self.messages: list[bytes] = []
        self._new = asyncio.Event()

    @property
    def frames(self) -> Frames:
        """All frames so far."""
        return decode(self.manifest, b"".join(self.messages))

    def of_type(self, kind: str) -> list[dict[str, Any]]:
        """The control messages of a type so far."""
        return [text for text in self.texts if text["type"] == kind]

    async def collect(self) -> None:
        """Read on."""
        async for message in self.socket:
            if isinstance(message, str):
                self.texts.append(json.loads(message))
            else:
                self.messages.append(message)
            self._new.set()

    async def until(self, met: Callable[[], object]) -> None:
        """Wait for a condition on what came."""
        async with asyncio.timeout(PATIENCE_S):
            while not met():
                self._new.clear()
                await self._new.wait()

    async def frame(self, index: int, *, epoch: int) -> None:
        """Wait for a frame of an epoch, or a later one of it."""

        def met() -> bool:
            frames = self.frames
            return bool(((frames["epoch"] == epoch % 256) & (frames["index"] >= index)).any())

        await self.until(met)


@asynccontextmanager
async def watch(server: Running, session: str, **query: object) -> AsyncGenerator[Watcher]:
    """Join a session."""
    async with websockets.connect(
        server.stream(session, **query), subprotocols=[websockets.Subprotocol(SUBPROTOCOL)], max_size=None
    ) as socket:
        first = await asyncio.wait_for(socket.recv(), PATIENCE_S)
        assert isinstance(first, str), "hello comes before any frame"
        watcher = Watcher(socket, json.loads(first))
        reading = asyncio.create_task(watcher.collect())
        try:
            yield watcher
        finally:
            reading.cancel()
