"""What breaks off in the middle is no mistake of the server's: no traceback, and an answer if it is heard."""

from __future__ import annotations

import base64
import json
import os
import re
import signal
import socket
import time
from typing import TYPE_CHECKING

import httpx
import pytest
from tests.integration.scores import scale, song
from tests.integration.server import PATIENCE_S, Running, serve, upload

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

FORM = (
    b"POST /api/v1/sessions HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000000\r\n"
    b"Content-Type: multipart/form-data; boundary=x\r\n\r\n"
    b'--x\r\nContent-Disposition: form-data; name="score"; filename="s.mid"\r\n\r\n'
)
BODY = b"POST /api/v1/lab/forward HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000\r\n\r\n["
TEXT = 0x81


@pytest.fixture
def logged(tmp_path: Path) -> Iterator[tuple[Running, Path]]:
    """A server, and the file that it logs to."""
    log = tmp_path / "log"
    with serve(tmp_path / "data", "--no-page", log=log) as server:
        yield server, log


def connect(server: Running) -> socket.socket:
    host, port = server.address.removeprefix("http://").split(":")
    return socket.create_connection((host, int(port)), timeout=PATIENCE_S)


def read_all(connection: socket.socket) -> bytes:
    answer = b""
    while received := connection.recv(65536):
        answer += received
    return answer


def test_uploads_that_break_off_leave_no_traceback(logged: tuple[Running, Path], tmp_path: Path) -> None:
    server, log = logged
    for begun in (FORM, FORM + b"MThd", BODY):
        connection = connect(server)
        connection.sendall(begun)
        time.sleep(0.2)
        connection.close()
    staging = tmp_path / "data" / "staging"
    deadline = time.monotonic() + PATIENCE_S
    while os.listdir(staging):  # noqa: PTH208
        assert time.monotonic() < deadline, "what came of them is removed"
        time.sleep(0.05)
    assert httpx.get(f"{server.api}/health").status_code == 200
    assert server.stop() == 0
    assert "Traceback" not in log.read_text()


def test_nothing_is_left_of_an_upload_whose_sender_is_gone_when_it_is_read(
    logged: tuple[Running, Path], tmp_path: Path
) -> None:
    server, log = logged
    boundary = b'\r\n--x\r\nContent-Disposition: form-data; name="%s"\r\n\r\n'
    form = FORM.partition(b"\r\n\r\n")[2] + scale(4_000) + boundary % b"public" + b"true\r\n--x--\r\n"
    head = FORM.partition(b"\r\n\r\n")[0].replace(b"1000000", str(len(form)).encode()) + b"\r\n\r\n"
    connection = connect(server)
    connection.sendall(head + form)
    connection.close()
    with httpx.Client(base_url=server.address, timeout=PATIENCE_S) as client:
        stays = upload(client, scale(8), public="true")
        deadline = time.monotonic() + PATIENCE_S
        listed: list[str] = []
        while os.listdir(tmp_path / "data" / "staging") or listed != [stays.id]:  # noqa: PTH208
            assert time.monotonic() < deadline, "nobody knows of it, and it is removed"
            time.sleep(0.05)
            listed = [each["id"] for each in client.get("/api/v1/sessions").json()["sessions"]]
    assert server.stop() == 0
    assert "Traceback" not in log.read_text()


@pytest.mark.parametrize(
    ("frame", "code"),
    [
        (bytes([TEXT, 0x82, 0, 0, 0, 0, 0xFF, 0xFE]), 1007),
        (bytes([TEXT, 0x83, 0, 0, 0, 0, 0xED, 0xA0, 0x80]), 1007),
        (bytes([0xFF, 0x80, 0, 0, 0, 0]), 1002),
        (bytes([0x80, 0x80, 0, 0, 0, 0]), 1002),
        (bytes([TEXT, 0x01, 0x41]), 1002),
        (bytes([TEXT, 0x81, 0, 0, 0, 0, 0xFF]) * 20 + bytes([TEXT, 0x82, 0, 0, 0, 0, 0x7B, 0x7D]), 1007),
        (bytes([TEXT, 0x81, 0, 0, 0, 0, 0xFF, 0x88, 0x82, 0, 0, 0, 0, 0x03, 0xE8]), 1000),
    ],
    ids=["no UTF-8", "a surrogate", "no frame", "continues nothing", "not masked", "many", "and a close"],
)
def test_websockets_with_what_is_none_are_closed_without_a_traceback(
    logged: tuple[Running, Path], frame: bytes, code: int
) -> None:
    server, log = logged
    with httpx.Client(base_url=server.address, timeout=PATIENCE_S) as client:
        session = upload(client, scale(4), song=("s.wav", song()))
    connection = connect(server)
    key = base64.b64encode(bytes(16)).decode()
    connection.sendall(
        f"GET /api/v1/sessions/{session.id}/stream HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\n"
        f"Upgrade: websocket\r\nSec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n"
        "Sec-WebSocket-Protocol: reina.v1\r\n\r\n".encode()
    )
    assert b" 101 " in connection.recv(65536)
    connection.sendall(frame)
    assert re.search(rb"\x88." + re.escape(code.to_bytes(2, "big")), read_all(connection), re.DOTALL)
    connection.close()
    assert httpx.get(f"{server.api}/health").status_code == 200
    assert server.stop() == 0
    assert "Traceback" not in log.read_text()


def test_uploads_are_told_that_the_server_ends(logged: tuple[Running, Path]) -> None:
    server, log = logged
    connections = [connect(server) for _ in range(2)]
    for connection, begun in zip(connections, (FORM, BODY), strict=True):
        connection.sendall(begun)
    time.sleep(0.3)
    server.process.send_signal(signal.SIGTERM)
    for connection in connections:
        head, body = read_all(connection).split(b"\r\n\r\n", 1)
        assert head.startswith(b"HTTP/1.1 503 "), head
        assert b"retry-after: " in head.lower()
        assert json.loads(body)["type"] == "urn:reina:problem:server-ends"
        connection.close()
    assert server.process.wait(PATIENCE_S) == 0
    said = log.read_text()
    assert "Traceback" not in said
    assert "Cancel" not in said
