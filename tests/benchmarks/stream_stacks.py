"""Servers that do nothing but send the same message to all viewers, each by another stack.

Run by bench_viewers.py. Prints ``port N``, takes viewers in, and from the first line of its input on sends
each of them a binary message by one ticker with absolute deadlines. The bytes are made once for all.
"""

from __future__ import annotations

import argparse
import asyncio
import base64
import hashlib
import importlib
import os
import resource
import socket
import struct
import sys
import time
from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any, cast

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable

GUID = b"258EAFA5-E914-47DA-95CA-C5AB0DC85B11"
LOW = 64 * 1024
"""Nothing more is written into a transport that holds so much."""


def payload(size: int, index: int, due_s: float) -> bytes:
    """A message whose head is that of a frame."""
    return struct.pack("<BBHIdd", 1, 0, 1, index, 0.0, due_s).ljust(size, b"\0")


def framed(message: bytes) -> bytes:
    """A message as it stands on the wire."""
    length = len(message)
    if length < 126:
        return bytes((0x82, length)) + message
    if length < 65_536:
        return struct.pack("!BBH", 0x82, 126, length) + message
    return struct.pack("!BBQ", 0x82, 127, length) + message


def accepted(request: bytes) -> bytes:
    """The answer to a handshake."""
    key = next(
        line.split(b": ")[1]
        for line in request.split(b"\r\n")
        if line.lower().startswith(b"sec-websocket-key")
    )
    accept = base64.b64encode(hashlib.sha1(key + GUID).digest())
    return (
        b"HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        b"Sec-WebSocket-Accept: " + accept + b"\r\n\r\n"
    )


class Stack(ABC):
    """Takes viewers in, and sends a message to each."""

    def __init__(self) -> None:
        self.transports: list[asyncio.Transport] = []

    @abstractmethod
    async def serve(self, listening: socket.socket) -> None:
        """Listen, and return."""

    async def send(self, message: bytes) -> None:
        """Send to everybody who keeps up, by writing into the transport."""
        frame = framed(message)
        for transport in self.transports:
            if transport.get_write_buffer_size() < LOW:
                transport.write(frame)


class Own(Stack):
    """An asyncio.Protocol that knows of no HTTP but the handshake."""

    async def serve(self, listening: socket.socket) -> None:
        stack = self

        class Viewer(asyncio.Protocol):
            def connection_made(self, transport: asyncio.BaseTransport) -> None:
                self.transport = cast("asyncio.Transport", transport)

            def data_received(self, data: bytes) -> None:
                if data.startswith(b"GET"):
                    self.transport.write(accepted(data))
                    stack.transports.append(self.transport)

        await asyncio.get_running_loop().create_server(Viewer, sock=listening)


class OwnByFile(Own):
    """The same; what the system takes at once goes past the transport."""

    def __init__(self) -> None:
        super().__init__()
        self._files: list[int] = []

    async def send(self, message: bytes) -> None:
        frame = framed(message)
        size = len(frame)
        for transport in self.transports[len(self._files) :]:
            self._files.append(transport.get_extra_info("socket").fileno())
        write = os.write
        for file, transport in zip(self._files, self.transports, strict=True):
            held = transport.get_write_buffer_size()
            if held:
                if held < LOW:
                    transport.write(frame)
                continue
            try:
                sent = write(file, frame)
            except BlockingIOError:
                sent = 0
            if sent < size:
                transport.write(frame[sent:])


class Uvicorn(Stack):
    """An ASGI application under uvicorn with websockets' sans-I/O implementation."""

    protocol: Any = "websockets-sansio"

    def __init__(self) -> None:
        super().__init__()
        self.sends: list[Callable[[Any], Awaitable[None]]] = []

    async def serve(self, listening: socket.socket) -> None:
        import uvicorn

        async def application(scope: Any, receive: Any, send: Any) -> None:
            if scope["type"] != "websocket":
                return
            await receive()
            await send({"type": "websocket.accept"})
            self.joined(scope, send)
            while (await receive())["type"] != "websocket.disconnect":
                pass

        config = uvicorn.Config(
            application,
            http="h11",
            ws=self.protocol,
            ws_per_message_deflate=False,
            log_level="error",
            lifespan="off",
        )
        serving = asyncio.create_task(uvicorn.Server(config).serve([listening]))
        self.serving = serving

    def joined(self, scope: Any, send: Callable[[Any], Awaitable[None]]) -> None:
        self.sends.append(send)

    async def send(self, message: bytes) -> None:
        event = {"type": "websocket.send", "bytes": message}
        for send in self.sends:
            await send(event)


class UvicornOutboxes(Uvicorn):
    """The same with a queue and a task for each viewer."""

    def joined(self, scope: Any, send: Callable[[Any], Awaitable[None]]) -> None:
        queue: asyncio.Queue[Any] = asyncio.Queue()

        async def run() -> None:
            while True:
                await send(await queue.get())

        self.queues = [*getattr(self, "queues", []), (queue, asyncio.create_task(run()))]

    async def send(self, message: bytes) -> None:
        event = {"type": "websocket.send", "bytes": message}
        for queue, _ in self.queues:
            queue.put_nowait(event)


class UvicornTransport(Uvicorn):
    """The same, but the application writes into the transport, which it finds among the extensions."""

    def __init__(self) -> None:
        super().__init__()
        from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

        class Protocol(WebSocketsSansIOProtocol):
            async def run_asgi(self) -> None:
                cast("Any", self.scope)["extensions"]["transport"] = self.transport
                await super().run_asgi()

        self.protocol = Protocol

    def joined(self, scope: Any, send: Callable[[Any], Awaitable[None]]) -> None:
        self.transports.append(scope["extensions"]["transport"])

    send = Stack.send


class UvicornFile(UvicornTransport, OwnByFile):
    """The same, but past the transport where the system takes it at once."""

    send = OwnByFile.send


class Picows(Stack):
    """picows, which is not among Reina's dependencies."""

    async def serve(self, listening: socket.socket) -> None:
        picows: Any = importlib.import_module("picows")
        stack = self

        class Viewer(picows.WSListener):
            def on_ws_connected(self, transport: Any) -> None:
                stack.transports.append(transport)

        def viewer(request: object) -> Viewer:
            return Viewer()

        await picows.ws_create_server(viewer, sock=listening)

    async def send(self, message: bytes) -> None:
        kind: Any = importlib.import_module("picows").WSMsgType.BINARY
        for transport in cast("list[Any]", self.transports):
            if transport.underlying_transport.get_write_buffer_size() < LOW:
                transport.send(kind, message)


class PicowsTransport(Picows):
    """The same, with a frame that is made once."""

    async def send(self, message: bytes) -> None:
        frame = framed(message)
        for transport in cast("list[Any]", self.transports):
            under = transport.underlying_transport
            if under.get_write_buffer_size() < LOW:
                under.write(frame)


STACKS: dict[str, type[Stack]] = {
    "uvicorn-outboxes": UvicornOutboxes,
    "uvicorn": Uvicorn,
    "uvicorn-transport": UvicornTransport,
    "uvicorn-file": UvicornFile,
    "own": Own,
    "own-file": OwnByFile,
    "picows": Picows,
    "picows-transport": PicowsTransport,
}


async def run(stack: Stack, size: int, rate: float) -> None:
    """Serve until the input ends."""
    # Named as TCP, or asyncio takes it for something else and leaves Nagle's algorithm on.
    listening = socket.socket(socket.AF_INET, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    listening.bind(("127.0.0.1", 0))
    listening.listen(1024)
    listening.setblocking(False)
    await stack.serve(listening)
    print("port", listening.getsockname()[1], flush=True)
    loop = asyncio.get_running_loop()
    await loop.run_in_executor(None, sys.stdin.readline)
    over = asyncio.create_task(asyncio.to_thread(sys.stdin.readline))
    due_s, index = time.monotonic(), 0
    while not over.done():
        await stack.send(payload(size, index, due_s))
        due_s, index = due_s + 1 / rate, index + 1
        await asyncio.sleep(max(0.0, due_s - time.monotonic()))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("stack", choices=STACKS)
    parser.add_argument("--bytes", type=int, default=1536)
    parser.add_argument("--rate", type=float, default=60.0)
    parser.add_argument("--uvloop", action="store_true")
    options = parser.parse_args()
    limit = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
    resource.setrlimit(resource.RLIMIT_NOFILE, (limit, limit))
    factory: Any = importlib.import_module("uvloop").new_event_loop if options.uvloop else None
    with asyncio.Runner(loop_factory=factory) as runner:
        runner.run(run(STACKS[options.stack](), options.bytes, options.rate))
        os._exit(0)
