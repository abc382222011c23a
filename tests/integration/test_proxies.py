"""Reina behind nginx and Caddy as `deploy` sets them up: pages, uploads and streams come through by TLS."""

from __future__ import annotations

import asyncio
import contextlib
import http.server
import json
import re
import socket
import ssl
import threading
import time
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

import httpx
import pytest
import websockets
from tests.integration.scores import scale, song
from tests.integration.server import PATIENCE_S, serve, upload
from tests.servers.proxies import PACKAGES, Proxy, proxy

from reina.protocol import SUBPROTOCOL

if TYPE_CHECKING:
    from collections.abc import Generator
    from pathlib import Path

KINDS = sorted(PACKAGES)


def tls(to: Proxy) -> ssl.SSLContext:
    return ssl.create_default_context(cafile=str(to.certificate))


@contextlib.contextmanager
def echo() -> Generator[int]:
    """Something in Reina's place that tells which headers came to it."""

    class Handler(http.server.BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def do_GET(self) -> None:
            self.rfile.read(int(self.headers.get("Content-Length", 0)))
            body = json.dumps([[name.lower(), value] for name, value in self.headers.items()]).encode()
            self.send_response(200)
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def do_POST(self) -> None:
            self.do_GET()

        def log_message(self, format: str, *args: Any) -> None:  # noqa: A002
            pass

    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler) as server:
        server.daemon_threads = True
        threading.Thread(target=server.serve_forever).start()
        yield server.server_port
        server.shutdown()


@pytest.mark.parametrize("kind", KINDS)
def test_everything_comes_through(kind: str, tmp_path: Path) -> None:
    log = tmp_path / "log"
    port_of = re.compile(r":(\d+)$")
    arguments = ("--log-requests", "--allow-host", "localhost")
    with contextlib.ExitStack() as opened:
        running = opened.enter_context(serve(tmp_path / "data", *arguments, log=log))
        found = port_of.search(running.address)
        assert found is not None
        through = opened.enter_context(proxy(kind, int(found[1]), tmp_path))
        client = opened.enter_context(
            httpx.Client(base_url=through.address, verify=tls(through), timeout=PATIENCE_S)
        )
        page = client.get("/")
        assert page.status_code == 200
        assert page.headers["Strict-Transport-Security"] == "max-age=31536000"
        session = upload(client, scale(), song=("s.wav", song()))
        headers = {**session.headers, "Origin": through.address}
        played = client.post(f"{session.path}/transport", json={"action": "play"}, headers=headers)
        assert played.status_code == 200, played.text

        async def frames() -> int:
            address = f"{through.address.replace('https', 'wss')}{session.path}/stream"
            protocols = [websockets.Subprotocol(SUBPROTOCOL)]
            async with (
                asyncio.timeout(PATIENCE_S),
                websockets.connect(
                    address,
                    subprotocols=protocols,
                    ssl=tls(through),
                    origin=websockets.Origin(through.address),
                ) as stream,
            ):
                got = 0
                while got < 20:
                    got += isinstance(await stream.recv(), bytes)
                return got

        assert asyncio.run(frames()) == 20
        known_by = client.get(session.path).headers["X-Request-ID"]
        until = time.monotonic() + PATIENCE_S
        while f'"request_id":"{known_by}"' not in log.read_text() and time.monotonic() < until:
            time.sleep(0.05)
        assert f'"request_id":"{known_by}"' in log.read_text()
        told = "".join(path.read_text() for path in (through.folder / "access",) if path.exists())
        assert session.id not in told
        assert bool(told) is (kind == "nginx")


@pytest.mark.parametrize("kind", KINDS)
def test_who_asks_is_told_and_nothing_made_up_is(kind: str, tmp_path: Path) -> None:
    made_up = {
        "X-Forwarded-For": "203.0.113.9",
        "X-Forwarded-Proto": "gopher",
        "Forwarded": "for=203.0.113.9",
        "X-Request-ID": "made-up-by-somebody",
    }
    with echo() as port, proxy(kind, port, tmp_path) as through:
        answer = httpx.get(f"{through.address}/", headers=made_up, verify=tls(through), timeout=PATIENCE_S)
    got = dict(answer.json())
    assert got["x-forwarded-for"] == "127.0.0.1"
    assert got["x-forwarded-proto"] == "https"
    assert "forwarded" not in got
    assert got["x-request-id"] != "made-up-by-somebody"
    assert re.fullmatch(r"[A-Za-z0-9._-]{8,36}", got["x-request-id"])
    assert got["host"] == through.address.removeprefix("https://")


@pytest.mark.parametrize("kind", KINDS)
def test_a_body_beyond_all_bounds_ends_there(kind: str, tmp_path: Path) -> None:
    with echo() as port, proxy(kind, port, tmp_path) as through:
        host, at = "localhost", urlsplit(through.address).port
        plain = socket.create_connection(("127.0.0.1", at or 0), timeout=PATIENCE_S)
        with tls(through).wrap_socket(plain, server_hostname=host) as asking:
            asking.sendall(
                f"POST / HTTP/1.1\r\nHost: {host}:{at}\r\nContent-Length: 300000000\r\n\r\n".encode()
            )
            with contextlib.suppress(OSError):
                if kind == "caddy":  # it counts what comes
                    for _ in range(300):
                        asking.sendall(bytes(1_000_000))
            said = asking.recv(1000)
    assert re.match(rb"HTTP/1.1 (413|502)", said), said[:100]


def test_nginx_takes_so_many_uploads_of_one_address_and_no_more(tmp_path: Path) -> None:
    with (
        echo() as port,
        proxy("nginx", port, tmp_path) as through,
        httpx.Client(base_url=through.address, verify=tls(through), timeout=PATIENCE_S) as client,
    ):
        uploads = [client.post("/api/v1/sessions", content=b"x").status_code for _ in range(30)]
        others = {client.post("/api/v1/files/role", content=b"x").status_code for _ in range(30)}
    assert uploads[:10] == [200] * 10
    assert 429 in uploads
    assert others == {200}


def test_a_packed_block_is_asked_for_once_however_many_watch(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("REINA_BLOCKS_ORIGIN", "self")
    with contextlib.ExitStack() as opened:
        running = opened.enter_context(serve(tmp_path / "data", "--no-page", "--allow-host", "localhost"))
        through = opened.enter_context(proxy("nginx", urlsplit(running.address).port or 0, tmp_path))
        client = opened.enter_context(
            httpx.Client(base_url=through.address, verify=tls(through), timeout=PATIENCE_S)
        )
        with httpx.Client(base_url=running.address) as direct:
            owned = upload(direct, scale(8), song=("s.wav", song()))
            blocks = direct.get(f"{owned.path}/manifest").json()["blocks"]
            assert blocks == {**blocks, "pushed": False, "href": f"{owned.path}/blocks/{blocks['revision']}"}
            wanted = direct.get(f"{blocks['href']}/0").content
        asked = [client.get(f"{blocks['href']}/0") for _ in range(300)]
        assert {answer.status_code for answer in asked} == {200}, "no rate is kept of blocks"
        assert {answer.content for answer in asked} == {wanted}
        assert [answer.headers["X-Cache"] for answer in asked] == ["MISS", *["HIT"] * 299]
        lossless = client.get(f"{blocks['href']}/0", params={"form": "lossless"})
        assert lossless.headers["X-Cache"] == "MISS"
        assert lossless.content != wanted
        other = client.get(f"{owned.path}/blocks/{'0' * 16}/0")
        assert (other.status_code, other.headers["X-Cache"]) == (410, "MISS")
        running.process.terminate()
        running.process.wait(PATIENCE_S)
        kept = client.get(f"{blocks['href']}/0")
        assert (kept.status_code, kept.headers["X-Cache"]) == (200, "HIT")
