"""All connections: how many there are, who gives way when there are too many, and who has kept us waiting."""

from __future__ import annotations

import itertools
import logging
import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol

from reina.api.http.problems import ProblemError
from reina.api.http.proxies import TrustedProxies, counted_as

if TYPE_CHECKING:
    import asyncio
    from collections.abc import Iterator

    from reina.cli.connection_limits import ConnectionLimits

RETRY_S = 10
"""When to come again: silent connections are closed by then."""
CLOSING_S = 10.0
"""How long a viewer that is sent away may take to read what was said last."""
SWEEPS = 10
"""In so many steps all connections are looked at once: ten steps of a tenth of a second."""

_log = logging.getLogger(__name__)


class Connection(Protocol):
    """What is known of a connection here."""

    transport: asyncio.Transport
    outflow: Outflow

    def overdue(self, now: float) -> bool:
        """Whether it has kept us waiting for too long in reading; one that is told so ends itself."""
        ...

    def drop(self) -> None:
        """End it at once, since another needs its place."""
        ...


@dataclass
class Outflow:
    """How what is sent to one connection is taken.

    Its transport does not tell how many bytes went; it is known when it had been full and is not, and how
    much less it holds from one look to the next.
    """

    since: float = math.inf
    """From when on less than the floor went out."""
    held: int = 0
    gone: int = 0
    resumed: bool = False

    def stalled(self, now: float, held: int, limits: ConnectionLimits) -> bool:
        """Whether too little has gone out for too long.

        Args:
            now: The time, seconds.
            held: Bytes that the transport holds.
            limits: What it is held to.
        """
        if not held or self.resumed or self.since == math.inf:
            self.since = now if held else math.inf
            self.gone, self.resumed = 0, False
        else:
            self.gone += max(0, self.held - held)
        self.held = held
        if self.gone >= limits.floor_bytes:
            self.since, self.gone = now, 0
        return now - self.since >= limits.stall_s


@dataclass
class _Crowd:
    """The connections that share a limit: all of them, or those of one address.

    Attributes:
        members: All.
        new: Those that have not sent a whole request yet, the oldest first.
        idle: Those whose requests are answered, the longest ago first.
    """

    members: set[Connection] = field(default_factory=set["Connection"])
    new: dict[Connection, None] = field(default_factory=dict["Connection", None])
    idle: dict[Connection, None] = field(default_factory=dict["Connection", None])

    def oldest(self, besides: Connection) -> Connection | None:
        """Who gives way: who never asked for anything, or has been answered longest ago."""
        return next((one for one in itertools.chain(self.new, self.idle) if one is not besides), None)

    def remove(self, connection: Connection) -> None:
        self.members.discard(connection)
        self.new.pop(connection, None)
        self.idle.pop(connection, None)

    def note(self, connection: Connection, *, idle: bool) -> None:
        self.new.pop(connection, None)
        self.idle.pop(connection, None)
        if idle:
            self.idle[connection] = None


class Connections:
    """All connections of the server. Belongs to the event loop.

    Places are given away by need: whoever watches or is being answered keeps his; of the others the oldest
    that never sent a whole request goes first, then who has been answered longest ago. So silence crowds out
    nobody, and a newcomer is heard as long as not all others are at work.

    Args:
        limits: How many, and how long.
        proxies: Whose word is taken for the address of who asks.
    """

    def __init__(self, limits: ConnectionLimits, proxies: TrustedProxies | None = None) -> None:
        self.limits = limits
        self.proxies = proxies or TrustedProxies()
        self.watching: set[Connection] = set()
        self.dropped = 0
        """How many gave way to others."""
        self.cut = 0
        """How many kept the server waiting for too long."""
        self.refused = 0
        """How many requests found no place."""
        self._all = _Crowd()
        self._crowds: dict[str, _Crowd] = {}
        self._address: dict[Connection, str] = {}
        self._of_proxies: set[Connection] = set()
        self._closing: dict[Connection, float] = {}
        self._sweep: Iterator[Connection] = iter(())
        self._sweep_step = 0

    def __len__(self) -> int:
        return len(self._all.members)

    def opened(self, connection: Connection, peer: str) -> None:
        """A connection has come; another may have to give way."""
        self._all.members.add(connection)
        self._all.new[connection] = None
        if not self.proxies.trusts(peer):
            self._join(connection, counted_as(peer))
            crowd = self._crowd(connection)
            if crowd is not None:
                crowd.new[connection] = None
                if len(crowd.members) > self.limits.most_an_address:
                    self._make_room(crowd, connection)
        if len(self._all.members) > self.limits.most:
            self._make_room(self._all, connection)

    def closed(self, connection: Connection) -> None:
        """A connection has gone."""
        self._all.remove(connection)
        self.watching.discard(connection)
        self._closing.pop(connection, None)
        self._of_proxies.discard(connection)
        self._leave(connection)

    def busy(self, connection: Connection) -> None:
        """A whole request head has come over it."""
        for crowd in self._crowds_of(connection):
            crowd.note(connection, idle=False)

    def idle(self, connection: Connection) -> None:
        """Its request is answered."""
        if connection in self._of_proxies:
            self._leave(connection)
        for crowd in self._crowds_of(connection):
            crowd.note(connection, idle=True)

    def admit(self, connection: Connection, peer: str, told: str) -> ProblemError | None:
        """Whether there is a place for its request.

        Args:
            connection: Over which it came.
            peer: The connection's other end.
            told: Who asks, by the connection's other end or a proxy's word.

        Returns:
            Why not, else None.
        """
        requests = len(self._all.members) - len(self.watching) - len(self._all.new)
        if requests > self.limits.most_requests and not self._drop_idle(self._all, connection):
            return self._refusal("there are too many requests at once")
        return self._admit_address(connection, peer, told)

    def admit_watcher(self, connection: Connection, peer: str, told: str) -> ProblemError | None:
        """Whether there is a place for who comes to watch; see `admit`."""
        if len(self.watching) >= self.limits.most_watching:
            return self._refusal("too many watch already")
        return self._admit_address(connection, peer, told)

    def watches(self, connection: Connection, before: Connection) -> None:
        """A connection has become a WebSocket, and keeps its place until it goes.

        Args:
            connection: As it is now.
            before: As it was.
        """
        address = self._address.get(before)
        self.closed(before)
        self._all.members.add(connection)
        self.watching.add(connection)
        if address is not None:
            self._join(connection, address)

    def sweep(self, now: float) -> None:
        """Look at a part of all connections, and end those that are overdue.

        Args:
            now: The time of the event loop, seconds.
        """
        if not self._sweep_step:
            found = list(self._all.members)
            self._sweep = iter(found)
            self._sweep_step = math.ceil(len(found) / SWEEPS)
        looked = 0
        for connection in itertools.islice(self._sweep, self._sweep_step):
            looked += 1
            if connection in self._all.members:
                self._look_at(connection, now)
        if looked < self._sweep_step:
            self._sweep_step = 0

    def make_room(self) -> None:
        """The system has no file left for who comes: let somebody give way who needs his place least."""
        _log.warning("no file is left for a new connection: %s connections are open", len(self))
        victim = next(itertools.chain(self._all.new, self._all.idle), None)
        if victim is not None:
            self._drop(victim)

    def _look_at(self, connection: Connection, now: float) -> None:
        transport = connection.transport
        held = transport.get_write_buffer_size()
        if connection.outflow.stalled(now, held, self.limits):
            self.cut += 1
            _log.warning("a connection was closed whose other end did not read its answer")
            transport.abort()
        elif transport.is_closing():
            # Whoever is told to go reads that, or not.
            since = self._closing.setdefault(connection, now)
            if connection in self.watching and now - since >= CLOSING_S:
                transport.abort()
        elif connection.overdue(now):
            self.cut += 1

    def _admit_address(self, connection: Connection, peer: str, told: str) -> ProblemError | None:
        if self.proxies.trusts(peer):
            # Who asks over it may be another each time.
            self._of_proxies.add(connection)
            self._leave(connection)
            self._join(connection, counted_as(told))
        crowd = self._crowd(connection)
        if (
            crowd is not None
            and len(crowd.members) - len(crowd.new) > self.limits.most_an_address
            and not self._drop_idle(crowd, connection)
        ):
            return self._refusal(f"there are too many connections from {told}")
        return None

    def _drop_idle(self, crowd: _Crowd, besides: Connection) -> bool:
        victim = next((one for one in crowd.idle if one is not besides), None)
        if victim is not None:
            self._drop(victim)
        return victim is not None

    def _make_room(self, crowd: _Crowd, besides: Connection) -> None:
        victim = crowd.oldest(besides)
        if victim is not None:
            self._drop(victim)

    def _drop(self, connection: Connection) -> None:
        self.dropped += 1
        _log.warning(
            "there are as many connections as there may be, %s in all: the oldest silent one gave way",
            len(self),
        )
        self.closed(connection)
        connection.drop()

    def _refusal(self, why: str) -> ProblemError:
        self.refused += 1
        _log.warning("a request was refused: %s", why)
        return ProblemError(
            503,
            "too-many-connections",
            "The server has no connection left",
            f"{why}; try again in {RETRY_S} seconds",
            headers={"Retry-After": str(RETRY_S), "Connection": "close"},
        )

    def _crowd(self, connection: Connection) -> _Crowd | None:
        address = self._address.get(connection)
        return None if address is None else self._crowds[address]

    def _crowds_of(self, connection: Connection) -> Iterator[_Crowd]:
        if connection in self._all.members:
            yield self._all
        crowd = self._crowd(connection)
        if crowd is not None:
            yield crowd

    def _join(self, connection: Connection, address: str | None) -> None:
        if address is not None:
            self._address[connection] = address
            self._crowds.setdefault(address, _Crowd()).members.add(connection)

    def _leave(self, connection: Connection) -> None:
        address = self._address.pop(connection, None)
        if address is not None:
            crowd = self._crowds[address]
            crowd.remove(connection)
            if not crowd.members:
                del self._crowds[address]
