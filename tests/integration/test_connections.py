"""Connections that say nothing, or too little, or take nothing hold nobody up, and are let go."""

from __future__ import annotations

import asyncio
import base64
import contextlib
import json
import os
import resource
import selectors
import socket
import time
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING

import httpx
import pytest
from tests.integration.scores import scale, song
from tests.integration.server import PATIENCE_S, Owned, Running, serve, upload
from tests.integration.watching import watch

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterator
    from pathlib import Path

HEAD = b"GET /api/v1/health HTTP/1.1\r\nHost: localhost\r\n"
FORM = (
    b"POST /api/v1/sessions HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000000\r\n"
    b"Content-Type: multipart/form-data; boundary=x\r\n\r\n"
    b'--x\r\nContent-Disposition: form-data; name="score"; filename="s.mid"\r\n\r\nMThd'
)
SHORT = {"REINA_HEADER_S": 2, "REINA_IDLE_S": 1, "REINA_STALL_S": 3}
"""The times that are waited, seconds."""
LONG = {"REINA_HEADER_S": 600, "REINA_IDLE_S": 600, "REINA_STALL_S": 600}
"""Nobody is ended for his slowness meanwhile."""


def connect(server: Running, *, receives: int | None = None) -> socket.socket:
    host, port = server.address.removeprefix("http://").split(":")
    opened = socket.socket()
    if receives:
        opened.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receives)
    opened.settimeout(PATIENCE_S)
    opened.connect((host, int(port)))
    return opened


@contextmanager
def connections(server: Running, count: int, begun: bytes = b"") -> Generator[list[socket.socket]]:
    """So many, each of which has sent what is given."""
    with ExitStack() as stack:
        opened: list[socket.socket] = []
        for _ in range(count):
            one = stack.enter_context(connect(server))
            opened.append(one)
            # The server may have closed it already, to make room.
            with contextlib.suppress(ConnectionError):
                one.sendall(begun)
        yield opened


def answers(opened: list[socket.socket]) -> list[bytes]:
    """What came over each until the server closed it; fails if one stays open."""
    said = dict.fromkeys(opened, b"")
    deadline = time.monotonic() + PATIENCE_S
    with selectors.DefaultSelector() as selector:
        for one in opened:
            selector.register(one, selectors.EVENT_READ)
        while selector.get_map():
            ready = selector.select(deadline - time.monotonic())
            assert ready, f"{len(selector.get_map())} connections are still open"
            for key, _ in ready:
                one = key.fileobj
                assert isinstance(one, socket.socket)
                received = b""
                with contextlib.suppress(ConnectionError):
                    received = one.recv(65536)
                if received:
                    said[one] += received
                else:
                    selector.unregister(one)
    return list(said.values())


def is_open(one: socket.socket) -> bool:
    one.setblocking(False)
    try:
        return one.recv(1, socket.MSG_PEEK) != b""
    except BlockingIOError:
        return True
    except ConnectionError:
        return False


def until(met: Callable[[], object], what: str) -> None:
    deadline = time.monotonic() + PATIENCE_S
    while not met():
        assert time.monotonic() < deadline, what
        time.sleep(0.05)


def staged(tmp_path: Path) -> list[str]:
    return os.listdir(tmp_path / "data" / "staging")  # noqa: PTH208


@contextmanager
def session_on(server: Running) -> Generator[Owned]:
    """A session, and a client that keeps no connection."""
    with httpx.Client(
        base_url=server.address, timeout=PATIENCE_S, limits=httpx.Limits(max_keepalive_connections=0)
    ) as client:
        yield upload(client, scale(4), song=("s.wav", song()))


def handshake(session: str, key: bytes = bytes(16)) -> bytes:
    return (
        f"GET /api/v1/sessions/{session}/stream HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\n"
        f"Upgrade: websocket\r\nSec-WebSocket-Key: {base64.b64encode(key).decode()}\r\n"
        "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: reina.v1\r\n\r\n"
    ).encode()


def files_of(server: Running) -> int:
    return len(os.listdir(f"/proc/{server.process.pid}/fd"))  # noqa: PTH208


@pytest.fixture
def hurried(tmp_path: Path) -> Iterator[Running]:
    """A server that waits for nobody for long."""
    with serve(tmp_path / "data", "--no-page", log=tmp_path / "log", settings=SHORT) as server:
        yield server


def test_silent_connections_crowd_out_neither_viewers_nor_newcomers(tmp_path: Path) -> None:
    few = LONG | {"REINA_MOST_CONNECTIONS": 200}
    log = tmp_path / "log"
    with (
        serve(tmp_path / "data", "--no-page", log=log, settings=few) as server,
        session_on(server) as session,
    ):

        async def watched() -> None:
            async with watch(server, session.id) as watcher:
                session.control("play")
                await watcher.frame(30, epoch=1)
                with connections(server, 1100) as silent:
                    # A newcomer is heard, and another comes to watch.
                    newcomer = await asyncio.to_thread(httpx.get, f"{server.api}/health", timeout=PATIENCE_S)
                    assert newcomer.status_code == 200
                    async with watch(server, session.id) as other:
                        session.control("seek", song_time_s=0.0)
                        await other.until(lambda: other.messages)
                    seen = len(watcher.messages)
                    session.control("play")
                    await watcher.until(lambda: len(watcher.messages) > seen + 30)
                    assert files_of(server) < 300
                    left = sum(map(is_open, silent))
                    assert 100 < left <= 200, "the latest stay, the oldest have given way"
                    assert not is_open(silent[0])
                    assert is_open(silent[-1])

        asyncio.run(watched())
        assert server.stop() == 0
    said = log.read_text().splitlines()
    assert len(said) == 1, said
    assert "the oldest silent one gave way" in said[0]


def test_silent_connections_and_those_that_wait_are_closed_without_a_word(hurried: Running) -> None:
    with connections(hurried, 20) as silent, connections(hurried, 20, HEAD + b"\r\n") as answered:
        assert answers(silent) == [b""] * 20
        for said in answers(answered):
            assert said.startswith(b"HTTP/1.1 200 ")
            assert said.count(b"HTTP/1.1 ") == 1


def test_slow_heads_are_told_so(hurried: Running) -> None:
    with connections(hurried, 200, HEAD) as slow:
        for said in answers(slow):
            head, body = said.split(b"\r\n\r\n", 1)
            assert head.startswith(b"HTTP/1.1 408 ")
            assert b"connection: close" in head.lower()
            assert json.loads(body)["type"] == "urn:reina:problem:too-slow"
    # The second head over a connection is held to the same.
    with connections(hurried, 1, HEAD + b"\r\n" + HEAD) as [one]:
        [said] = answers([one])
        assert b"HTTP/1.1 200 " in said
        assert b"HTTP/1.1 408 " in said


def test_slow_bodies_are_told_so_and_leave_nothing(hurried: Running, tmp_path: Path) -> None:
    with connections(hurried, 200, FORM) as slow:
        until(lambda: staged(tmp_path), "they have begun")
        # Something comes, and less than the floor.
        for one in slow[100:]:
            one.sendall(b"x")
        for said in answers(slow):
            head, body = said.split(b"\r\n\r\n", 1)
            assert head.startswith(b"HTTP/1.1 408 ")
            assert json.loads(body)["type"] == "urn:reina:problem:too-slow"
    until(lambda: not staged(tmp_path), "what came of them is removed")
    assert httpx.get(f"{hurried.api}/health").status_code == 200
    assert hurried.stop() == 0
    said = (tmp_path / "log").read_text()
    assert "Traceback" not in said


def test_who_takes_no_answer_is_cut(hurried: Running) -> None:
    with session_on(hurried) as session, ExitStack() as stack:
        before = files_of(hurried)
        for below in ("frames?start_s=0&end_s=600", "song"):
            for _ in range(5):
                one = stack.enter_context(connect(hurried, receives=4096))
                one.sendall(f"GET {session.path}/{below} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        until(lambda: files_of(hurried) >= before + 5, "they have come")
        until(lambda: files_of(hurried) <= before, "they are cut, and their connections are no more")
        assert session.client.get(session.path).status_code == 200


def test_viewers_that_answer_no_ping_are_cut(tmp_path: Path) -> None:
    settings = LONG | {"REINA_SILENT_S": 4}
    with serve(tmp_path / "data", "--no-page", settings=settings) as server, session_on(server) as session:
        before = files_of(server)

        async def watched() -> None:
            # One that answers its pings stays meanwhile.
            async with watch(server, session.id) as watcher:
                with connections(server, 50, handshake(session.id)) as silent:
                    for one in silent:
                        assert b" 101 " in one.recv(13)
                    # Nothing more is read of them.
                    await asyncio.to_thread(
                        until, lambda: files_of(server) <= before + 1, "they are cut, whatever they read"
                    )
                seen = len(watcher.texts)
                await watcher.socket.send(json.dumps({"type": "ping", "id": 7}))
                await watcher.until(lambda: len(watcher.texts) > seen)

        asyncio.run(watched())


def test_a_low_file_limit_neither_spins_nor_fills_the_log(tmp_path: Path) -> None:
    log = tmp_path / "log"
    with (
        serve(tmp_path / "data", "--no-page", log=log, settings=LONG, files=256) as server,
        session_on(server) as session,
    ):

        async def watched() -> None:
            async with watch(server, session.id) as watcher:
                session.control("play")
                await watcher.frame(10, epoch=1)
                with connections(server, 600):
                    answer = await asyncio.to_thread(session.client.get, session.path)
                    assert answer.status_code == 200
                    assert files_of(server) < 256
                    seen = len(watcher.messages)
                    session.control("seek", song_time_s=0.0)
                    await watcher.until(lambda: len(watcher.messages) > seen)

        asyncio.run(watched())
        assert server.stop() == 0
    said = log.read_text().splitlines()
    assert len(said) <= 2, said
    assert "Traceback" not in "".join(said)


def test_where_no_file_is_left_connections_make_room(tmp_path: Path) -> None:
    """As when something else in the process has taken what was kept for connections."""
    log = tmp_path / "log"
    with serve(tmp_path / "data", "--no-page", log=log, settings=LONG) as server:
        least = files_of(server) + 20
        resource.prlimit(server.process.pid, resource.RLIMIT_NOFILE, (least, least))
        before = os.times().elapsed, _cpu_s(server)
        with connections(server, 100):
            answer = httpx.get(f"{server.api}/health", timeout=PATIENCE_S)
            assert answer.status_code == 200
            until(lambda: os.times().elapsed - before[0] > 2, "some time goes by")
            assert _cpu_s(server) - before[1] < 1.5, "it does not spin"
        assert server.stop() == 0
    # That it is not ready meanwhile is said too, if it is looked at just then, once for each reason.
    said = [line for line in log.read_text().splitlines() if "reina.api.readiness" not in line]
    assert [line for line in said if "no file is left" in line]
    assert len(said) <= 3, said


def test_an_address_is_believed_of_trusted_proxies_alone(tmp_path: Path) -> None:
    rates = {"REINA_RATES": "frames=2"}
    told = {"X-Forwarded-For": "198.51.100.9, 203.0.113.9"}
    other = {"X-Forwarded-For": "198.51.100.9, 203.0.113.10"}
    made_up = {"X-Forwarded-For": "127.0.0.1, 203.0.113.9"}
    with (
        serve(tmp_path / "data", "--no-page", "--trusted-proxy", "127.0.0.0/8", settings=rates) as server,
        session_on(server) as session,
    ):
        span = f"{session.path}/frames?start_s=0&end_s=0.1"

        def status(headers: dict[str, str]) -> int:
            return session.client.get(span, headers=headers).status_code

        assert [status(told) for _ in range(3)] == [200, 200, 429]
        assert status(made_up) == 429
        assert status(other) == 200
        refused = session.client.get(span, headers=told)
        assert 0 < int(refused.headers["Retry-After"]) <= 60
        assert refused.json()["type"] == "urn:reina:problem:too-often"
        # A page that came by TLS may write by TLS.
        rename = {"Origin": "https://localhost", "Host": "localhost"} | session.headers
        change = {"title": "Another"}
        plain = session.client.patch(session.path, json=change, headers=rename)
        assert plain.status_code == 403
        by_tls = session.client.patch(
            session.path, json=change, headers=rename | {"X-Forwarded-Proto": "https"}
        )
        assert by_tls.status_code == 200
    with serve(tmp_path / "data", "--no-page", settings=rates) as server, session_on(server) as session:
        span = f"{session.path}/frames?start_s=0&end_s=0.1"
        # Who says so himself is not believed: he asks from this machine, where nothing is counted.
        assert [session.client.get(span, headers=told).status_code for _ in range(4)] == [200] * 4
        forged = {"Origin": "https://localhost", "Host": "localhost", "X-Forwarded-Proto": "https"}
        assert (
            session.client.patch(
                session.path, json={"title": "x"}, headers=forged | session.headers
            ).status_code
            == 403
        )


def test_one_address_has_so_many_connections(tmp_path: Path) -> None:
    settings = LONG | {"REINA_MOST_CONNECTIONS_AN_ADDRESS": 5}
    with (
        serve(tmp_path / "data", "--no-page", "--trusted-proxy", "127.0.0.1", settings=settings) as server,
        session_on(server) as session,
        ExitStack() as stack,
    ):
        told = b"X-Forwarded-For: 203.0.113.9\r\n\r\n"
        for _ in range(5):
            viewer = stack.enter_context(connect(server))
            viewer.sendall(handshake(session.id)[:-2] + told)
            assert b" 101 " in viewer.recv(13)
        late = stack.enter_context(connect(server))
        late.sendall(HEAD + told)
        [said] = answers([late])
        assert said.startswith(b"HTTP/1.1 503 ")
        assert b"retry-after: " in said.lower()
        assert b"urn:reina:problem:too-many-connections" in said
        other = stack.enter_context(connect(server))
        other.sendall(HEAD + told.replace(b".9", b".10"))
        assert b" 200 " in other.recv(13)


def _cpu_s(server: Running) -> float:
    with open(f"/proc/{server.process.pid}/stat") as file:  # noqa: PTH123
        fields = file.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
