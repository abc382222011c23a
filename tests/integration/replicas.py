"""Several real servers that serve the same sessions, on a real PostgreSQL and a real Redis."""

from __future__ import annotations

import asyncio
import contextlib
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING

import httpx
import numpy as np
import websockets
from tests.integration.server import Owned, Running, serve
from tests.servers.redis import Redis, redis_server

from reina.protocol import SUBPROTOCOL
from reina.protocol.frame import HEADER

if TYPE_CHECKING:
    from collections.abc import Callable, Generator
    from pathlib import Path
    from typing import Any

    from tests.servers.postgresql import PostgreSQL


class Replicas:
    """Servers of one house.

    Attributes:
        servers: Each of them.
        redis: What connects them.
    """

    def __init__(self, servers: list[Running], clients: list[httpx.Client], redis: Redis) -> None:
        self.servers = servers
        self.redis = redis
        self._clients = clients

    def at(self, number: int, owned: Owned) -> Owned:
        """A session, asked for at one of the servers."""
        return Owned(self._clients[number], owned.body)

    def client(self, number: int) -> httpx.Client:
        """A client of one of the servers."""
        return self._clients[number]


@contextmanager
def replicas(
    folder: Path,
    postgresql: PostgreSQL,
    count: int = 2,
    *,
    page: bool = False,
    settings: dict[str, Any] | None = None,
) -> Generator[Replicas]:
    """Start servers; what they log goes into files beside their data."""
    database = postgresql.database()
    with redis_server() as redis, ExitStack() as held:
        servers: list[Running] = []
        clients: list[httpx.Client] = []
        for number in range(count):
            shared = {
                "REINA_DATABASE_URL": database,
                "REINA_BUS_URL": redis.url,
                "REINA_FILES": folder / "files",
            }
            server = held.enter_context(
                serve(
                    folder / f"data-{number}",
                    *([] if page else ["--no-page"]),
                    log=folder / f"log-{number}",
                    settings=shared | (settings or {}),
                )
            )
            servers.append(server)
            clients.append(held.enter_context(httpx.Client(base_url=server.address, timeout=30.0)))
        yield Replicas(servers, clients, redis)


async def control(owned: Owned, action: str, **fields: Any) -> dict[str, Any]:
    """Use the transport, beside what goes on on the loop."""
    return await asyncio.to_thread(owned.control, action, **fields)


class Fan:
    """Somebody who watches through nginx, and comes again as the page does when the connection breaks."""

    def __init__(self, address: str) -> None:
        self._address = address
        self.connections = 0
        self.offsets_s: list[float] = []
        """Of each message: the server time at which song time 0 would be due."""
        self.song_time_s = -1.0

    async def watch(self) -> None:
        """Watch until it is cancelled."""
        while True:
            with contextlib.suppress(websockets.WebSocketException, OSError):
                async with websockets.connect(
                    self._address, subprotocols=[websockets.Subprotocol(SUBPROTOCOL)], max_size=None
                ) as socket:
                    self.connections += 1
                    async for message in socket:
                        if isinstance(message, bytes):
                            header = np.frombuffer(message[: HEADER.itemsize], HEADER)[0]
                            self.song_time_s = float(header["song_time_s"])
                            self.offsets_s.append(float(header["due_time_s"]) - self.song_time_s)
            await asyncio.sleep(0.25)


async def all_have(fans: list[Fan], met: Callable[[Fan], bool]) -> None:
    """Wait until something holds of all of them."""
    async with asyncio.timeout(60):
        while not all(map(met, fans)):  # noqa: ASYNC110 - it is looked at, as they are many
            await asyncio.sleep(0.02)
