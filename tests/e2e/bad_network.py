"""A bad network between a page and its server, made of delays on loopback: it needs no rights."""

from __future__ import annotations

import asyncio
import contextlib
import random
import socket
import threading
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

if TYPE_CHECKING:
    from collections.abc import Generator

PACKET = 1448
"""Bytes that one packet of TCP carries on an Ethernet."""
ON_ITS_WAY = 1000
"""Packets that are under way at most; then the sender waits."""


@dataclass(frozen=True)
class Weather:
    """What a network does to each packet, each way.

    TCP keeps the order, so a packet that is late holds up all behind it; one that is lost is sent again once
    the sender has noticed, a round trip and `notice_s` later.
    """

    delay_s: float = 0.15
    jitter_s: float = 0.05
    loss: float = 0.02
    notice_s: float = 0.2

    def takes(self, dice: random.Random) -> float:
        """Seconds until a packet sent now has come."""
        lost = dice.random() < self.loss
        again_s = 2 * self.delay_s + self.notice_s if lost else 0.0
        return self.delay_s + dice.uniform(-self.jitter_s, self.jitter_s) + again_s


@contextmanager
def bad_network(address: str, weather: Weather, *, seed: int = 1) -> Generator[BadNetwork]:
    """A server's address, reached through a network of this weather."""
    loop = asyncio.new_event_loop()
    thread = threading.Thread(target=loop.run_forever, name="bad network", daemon=True)
    thread.start()
    proxy = BadNetwork(address, weather, random.Random(seed))
    try:
        asyncio.run_coroutine_threadsafe(proxy.open(), loop).result(10.0)
        yield proxy
    finally:
        asyncio.run_coroutine_threadsafe(proxy.close(), loop).result(10.0)
        loop.call_soon_threadsafe(loop.stop)
        thread.join(10.0)
        loop.close()


class BadNetwork:
    """A network between whoever connects to `address` and a server."""

    def __init__(self, address: str, weather: Weather, dice: random.Random) -> None:
        at = urlsplit(address)
        self._host, self._port = at.hostname or "127.0.0.1", at.port or 80
        self._weather = weather
        self._dice = dice
        self._server: asyncio.Server | None = None
        self._connections: set[asyncio.Task[None]] = set()
        self._forgotten = 0
        self._made = 0
        self.address = ""
        """Where the server is reached through this network."""

    def forget_connections(self) -> None:
        """What is connected hears nothing any more and is not told, as behind a router that forgot it."""
        self._forgotten = self._made

    async def open(self) -> None:
        """Listen on a free port."""
        self._server = await asyncio.start_server(self._accept, "127.0.0.1", 0)
        self.address = f"http://127.0.0.1:{self._server.sockets[0].getsockname()[1]}"

    async def close(self) -> None:
        """End every connection."""
        if self._server:
            self._server.close()
        connections = tuple(self._connections)
        for connection in connections:
            connection.cancel()
        await asyncio.gather(*connections, return_exceptions=True)

    async def _accept(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        connection = asyncio.current_task()
        assert connection is not None
        self._connections.add(connection)
        self._made += 1
        number = self._made
        ends = [writer]
        try:
            # The handshake goes there and back before anything is sent.
            await asyncio.sleep(2 * self._weather.delay_s)
            far_reader, far_writer = await asyncio.open_connection(self._host, self._port)
            ends.append(far_writer)
            for each in ends:
                each.get_extra_info("socket").setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            # Where one way breaks, nothing of the other goes on behind it.
            async with asyncio.TaskGroup() as ways:
                for taken, given in ((reader, far_writer), (far_reader, writer)):
                    under_way: asyncio.Queue[tuple[float, bytes]] = asyncio.Queue(ON_ITS_WAY)
                    ways.create_task(self._take(taken, under_way))
                    ways.create_task(self._give(number, under_way, given))
        except* (asyncio.CancelledError, OSError):
            pass
        finally:
            for each in ends:
                each.close()
                with contextlib.suppress(OSError):
                    await each.wait_closed()
            self._connections.discard(connection)

    async def _take(
        self, reader: asyncio.StreamReader, under_way: asyncio.Queue[tuple[float, bytes]]
    ) -> None:
        """Send packets on their way, none before another."""
        now = asyncio.get_running_loop().time
        comes = 0.0
        with contextlib.suppress(ConnectionError):
            while packet := await reader.read(PACKET):
                comes = max(comes, now() + self._weather.takes(self._dice))
                await under_way.put((comes, packet))
        await under_way.put((comes, b""))

    async def _give(
        self, number: int, under_way: asyncio.Queue[tuple[float, bytes]], writer: asyncio.StreamWriter
    ) -> None:
        """Hand packets over as they come; the end of them ends the connection."""
        now = asyncio.get_running_loop().time
        while True:
            comes, packet = await under_way.get()
            await asyncio.sleep(max(comes - now(), 0.0))
            if not packet:
                break
            if number > self._forgotten:
                writer.write(packet)
                await writer.drain()
        if number <= self._forgotten:
            # Nobody is told of the end of what was forgotten, either.
            await asyncio.Event().wait()
        writer.close()
