"""Who gives way when there are too many connections, and who is cut."""

from __future__ import annotations

import asyncio
import gc
import weakref
from typing import TYPE_CHECKING, cast

import pytest
from uvicorn.server import ServerState

from reina.api.http.proxies import TrustedProxies
from reina.cli.connection_limits import ConnectionLimits
from reina.cli.connections import Connections, Outflow
from reina.cli.http_protocol import ProblemProtocol
from reina.cli.server_config import Config

if TYPE_CHECKING:
    from starlette.types import Receive, Scope, Send

LIMITS = ConnectionLimits(most=8, most_an_address=4, stall_s=60.0, least_bytes_a_second=1000)
ONE, OTHER = "203.0.113.1", "203.0.113.2"


class Transport:
    """What is still to be sent, and whether it is being closed."""

    def __init__(self) -> None:
        self.held = 0
        self.closing = False
        self.aborted = False

    def get_write_buffer_size(self) -> int:
        return self.held

    def is_closing(self) -> bool:
        return self.closing

    def abort(self) -> None:
        self.aborted = True


class Fake:
    """A connection."""

    def __init__(self, name: str = "") -> None:
        self.name = name
        self.wire = Transport()
        self.transport = cast("asyncio.Transport", self.wire)
        self.outflow = Outflow()
        self.late = False
        self.gone = False

    def __repr__(self) -> str:
        return self.name

    def overdue(self, now: float) -> bool:
        return self.late

    def drop(self) -> None:
        self.gone = True


def opened(connections: Connections, count: int, peer: str = "127.0.0.1") -> list[Fake]:
    made = [Fake(str(number)) for number in range(count)]
    for one in made:
        connections.opened(one, peer)
    return made


def asks(connections: Connections, one: Fake, peer: str = "127.0.0.1", told: str | None = None) -> bool:
    """Whether a request is taken."""
    connections.busy(one)
    return connections.admit(one, peer, told or peer) is None


def test_the_oldest_silent_connection_gives_way_then_who_was_answered_longest_ago() -> None:
    connections = Connections(LIMITS)
    made = opened(connections, 8)
    for one in made[:3]:
        assert asks(connections, one)
    connections.idle(made[1])
    connections.idle(made[0])
    opened(connections, 7)
    assert [one.gone for one in made] == [False, False, False, True, True, True, True, True]
    assert len(connections) == 8
    assert connections.dropped == 7


def test_who_is_at_work_or_watches_never_gives_way() -> None:
    connections = Connections(LIMITS)
    working = opened(connections, 6)
    assert all(asks(connections, one) for one in working)
    before = opened(connections, 2)
    watching = [Fake("w0"), Fake("w1")]
    for one, old in zip(watching, before, strict=True):
        assert connections.admit_watcher(old, ONE, ONE) is None
        connections.watches(one, old)
    late = opened(connections, 50)
    assert not any(one.gone for one in (*working, *watching))
    assert sum(not one.gone for one in late) == 1
    # The one that is left is heard, and told that there is no place.
    connections.busy(late[-1])
    problem = connections.admit(late[-1], "127.0.0.1", "127.0.0.1")
    assert problem is not None
    assert problem.status == 503
    assert problem.headers["Retry-After"]
    # It may still come to watch.
    assert connections.admit_watcher(late[-1], "127.0.0.1", "127.0.0.1") is None


def test_a_request_takes_the_place_of_one_that_waits() -> None:
    connections = Connections(LIMITS)
    working = opened(connections, 6)
    assert all(asks(connections, one) for one in working)
    connections.idle(working[3])
    [late] = opened(connections, 1)
    assert asks(connections, late)
    assert [one.name for one in working if one.gone] == ["3"]


def test_so_many_may_watch() -> None:
    connections = Connections(LIMITS)
    for number in range(6):
        [before] = opened(connections, 1)
        assert connections.admit_watcher(before, ONE, ONE) is None
        connections.watches(Fake(str(number)), before)
    [late] = opened(connections, 1)
    assert connections.admit_watcher(late, ONE, ONE) is not None
    assert asks(connections, late)


def test_one_address_has_so_many_and_this_machine_any_number() -> None:
    connections = Connections(LIMITS)
    its = opened(connections, 4, ONE)
    assert all(asks(connections, one, ONE) for one in its)
    others = opened(connections, 2, OTHER)
    [more] = opened(connections, 1, ONE)
    assert not asks(connections, more, ONE)
    assert asks(connections, others[0], OTHER)
    own = Connections(LIMITS)
    assert all(asks(own, one) for one in opened(own, 6))
    # What an address keeps in silence is its own.
    silent = Connections(LIMITS)
    other = opened(silent, 1, OTHER)[0]
    its = opened(silent, 7, ONE)
    assert not other.gone
    assert [one.gone for one in its] == [True, True, True, False, False, False, False]


def test_behind_a_proxy_it_is_counted_who_asks() -> None:
    connections = Connections(LIMITS, TrustedProxies.named(["10.0.0.1"]))
    made = opened(connections, 6, "10.0.0.1")
    assert [asks(connections, one, "10.0.0.1", ONE) for one in made[:5]] == [True] * 4 + [False]
    assert asks(connections, made[5], "10.0.0.1", OTHER)
    # Once it is answered the connection is the proxy's again.
    connections.idle(made[0])
    connections.closed(made[4])
    assert asks(connections, made[0], "10.0.0.1", ONE)


def test_who_is_overdue_is_counted_and_all_are_looked_at_within_some_steps() -> None:
    connections = Connections(ConnectionLimits(most=1000))
    made = opened(connections, 95)
    for one in made:
        one.late = True
    for _ in range(10):
        connections.sweep(1.0)
    assert connections.cut == 95


def test_a_viewer_that_is_sent_away_and_reads_nothing_is_let_go() -> None:
    connections = Connections(LIMITS)
    [before] = opened(connections, 1)
    viewer = Fake("viewer")
    connections.watches(viewer, before)
    viewer.wire.closing, viewer.wire.held = True, 500
    for at in range(5):
        connections.sweep(float(at))
    assert not viewer.wire.aborted
    for at in range(5, 30):
        connections.sweep(float(at))
    assert viewer.wire.aborted


@pytest.mark.parametrize(
    ("a_second", "stalls"),
    [(0, True), (900, True), (1100, False), (50_000, False)],
)
def test_answers_move_at_least_at_the_floor(a_second: int, stalls: bool) -> None:
    outflow = Outflow()
    held = 20_000_000
    found = [outflow.stalled(float(at), held - at * a_second, LIMITS) for at in range(200)]
    assert any(found) == stalls
    assert not any(found[:60])


def test_an_answer_that_fills_and_empties_moves() -> None:
    outflow = Outflow()
    for at in range(200):
        assert not outflow.stalled(float(at), 60_000 if at % 2 else 0, LIMITS)
    outflow = Outflow()
    for at in range(200):
        # It had been full, and was not, between two looks.
        outflow.resumed = at % 50 == 0
        assert not outflow.stalled(float(at), 60_000, LIMITS)


def test_limits_leave_files_for_other_things(monkeypatch: pytest.MonkeyPatch) -> None:
    assert ConnectionLimits.of_environment(65_536).most == 4096
    assert ConnectionLimits.of_environment(256).most == 160
    assert ConnectionLimits.of_environment(1024).most == 768
    monkeypatch.setenv("REINA_MOST_CONNECTIONS", "100")
    assert ConnectionLimits.of_environment(1024).most == 100


def test_a_connection_that_closed_is_let_go_of_without_the_collector() -> None:
    """The server's collector looks through everything once in thousands of sessions."""

    async def answer(scope: Scope, receive: Receive, send: Send) -> None: ...

    async def scenario() -> None:
        protocol = ProblemProtocol(Config(answer, Connections(LIMITS), log_config=None), ServerState(), {})
        gone = weakref.ref(protocol)
        gc.disable()
        try:
            del protocol
            assert gone() is None
        finally:
            gc.enable()

    asyncio.run(scenario())
