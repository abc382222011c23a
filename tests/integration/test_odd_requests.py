"""Requests that no page would send: each is refused as a problem, none is a mistake of the server's."""

from __future__ import annotations

import asyncio
import json
from typing import TYPE_CHECKING

import pytest
import websockets
from tests.integration.scores import scale, song
from tests.integration.server import upload
from websockets.exceptions import InvalidStatus

if TYPE_CHECKING:
    from collections.abc import Iterator

    import httpx
    from tests.integration.server import Owned, Running

LONG = "a" * 300
KEYFRAMES = "/show/tracks/lights/key/intensity/keyframes"


@pytest.fixture(scope="module")
def unchanged(client: httpx.Client) -> Iterator[Owned]:
    """One session for all requests: none of them changes it."""
    session = upload(client, scale(), song=("song.wav", song()))
    yield session
    session.change("DELETE")


def refused(answer: httpx.Response) -> None:
    assert 400 <= answer.status_code < 500, (answer.status_code, answer.text)
    assert answer.headers["content-type"] == "application/problem+json"
    assert len(answer.json()["detail"]) > 10


@pytest.mark.parametrize(
    "path",
    [
        "/api/v1/rigs/%00",
        "/api/v1/rigs/%2e%2e",
        f"/api/v1/rigs/{LONG}",
        f"/api/v1/rigs/{LONG}/rig.json",
        f"/api/v1/sessions/{LONG}",
        f"/api/v1/sessions/{LONG}/song",
        f"/api/v1/examples/{LONG}/taps.mid",
        "/api/v1/rigs/trumpet/%00",
        "/api/v1/rigs/trumpet/%2e%2e/trumpeter/rig.json",
        f"/api/v1/rigs/trumpet/{LONG}",
        "/api/v1/rigs/trumpet/" + "a/" * 2500,
        "/api/v1/rigs/trumpet/%ff",
        "/api/v1/examples/scores/%00",
        "/api/v1/examples/scores/%2e%2e",
        f"/api/v1/examples/scores/{LONG}",
        "/api/v1/examples/%00/taps.mid",
        "/%00",
        "/assets/%00",
        f"/{LONG}",
        "/%2e%2e/%2e%2e/pyproject.toml",
    ],
)
def test_names_that_no_file_has(client: httpx.Client, path: str) -> None:
    refused(client.get(path))


@pytest.mark.parametrize(
    "query",
    [
        "start_s=nan",
        "start_s=inf",
        "start_s=1e308&end_s=1e308",
        "start_s=1e12&end_s=1000000000001",
        "end_s=1e300",
        "fps=999999999999999999999",
    ],
)
def test_spans_that_no_music_has(client: httpx.Client, unchanged: Owned, query: str) -> None:
    refused(client.get(f"{unchanged.path}/frames?{query}"))


@pytest.mark.parametrize(
    "body",
    [
        b'{"time": 2, "value": 1, "key": "\\ud800"}',
        b'{"time": 2, "value": 1, "\\ud800": 1}',
        b'{"time": 2, "value": 1, "interpolation": "\\ud800"}',
        b'{"time": 2, "value": 1, "key": []}',
        b'{"time": ' + b"9" * 400 + b', "value": 1}',
        b'{"time": NaN, "value": 1}',
        b"[" * 20_000,
        b"\xff\xfe",
        b"null",
    ],
)
def test_keyframes_that_are_none(unchanged: Owned, body: bytes) -> None:
    before = unchanged.client.get(f"{unchanged.path}{KEYFRAMES}").json()
    headers = {**unchanged.headers, "Content-Type": "application/json"}
    refused(unchanged.client.post(f"{unchanged.path}{KEYFRAMES}", content=body, headers=headers))
    assert unchanged.client.get(f"{unchanged.path}{KEYFRAMES}").json() == before


@pytest.mark.parametrize(
    "body",
    [
        b'{"version": 1, "title": "\\ud800"}',
        b'{"version": 1, "tracks": [{"parameter": "x/\\udfff", "keyframes": []}]}',
        b'{"version": 1, "tracks": [{"parameter": "x/y", "keyframes": [NaN]}]}',
        b'{"version": 1, "tracks": [{"parameter": "x/y", "keyframes": ' + b"[" * 900 + b"]" * 900 + b"}]}",
    ],
)
def test_shows_that_could_not_be_read_again(client: httpx.Client, unchanged: Owned, body: bytes) -> None:
    before = client.get(f"{unchanged.path}/show").json()
    refused(unchanged.change("PUT", "/show", content=body))
    assert client.get(f"{unchanged.path}/show").json() == before
    files = {"score": ("a.mid", scale(4)), "song": ("a.wav", song(0.1)), "show": ("a.json", body)}
    refused(client.post("/api/v1/sessions", files=files))


@pytest.mark.parametrize("name", [LONG, "a" * 200, "../trumpeter", "\0", "trumpeter/."])
def test_players_that_no_rig_is(client: httpx.Client, unchanged: Owned, name: str) -> None:
    refused(client.post("/api/v1/sessions", files={"score": ("a.mid", scale(2))}, data={"player": name}))
    refused(unchanged.change("PATCH", "", json={"player": name}))


@pytest.mark.parametrize(
    ("content_type", "content"),
    [
        ("multipart/form-data; boundary=" + "y" * 5000, b"x"),
        ("multipart/form-data; boundary=x", b"--x\r\n" + b"A: b\r\n" * 1000 + b"\r\nx\r\n--x--"),
        ("multipart/form-data; boundary=x", b"--x\r\n\r\nabc\r\n--x--\r\n"),
    ],
)
def test_forms_that_are_none(client: httpx.Client, content_type: str, content: bytes) -> None:
    refused(client.post("/api/v1/sessions", content=content, headers={"Content-Type": content_type}))


@pytest.mark.parametrize("size", ["0", "13", "-1", "1.5", "x", "9" * 5000])
def test_numbers_of_frames_that_no_message_has(server: Running, unchanged: Owned, size: str) -> None:
    async def status() -> int:
        address = f"{server.stream(unchanged.id)}frames_per_message={size}"
        with pytest.raises(InvalidStatus) as caught:
            async with websockets.connect(address, subprotocols=[websockets.Subprotocol("reina.v1")]):
                pass
        return caught.value.response.status_code

    assert asyncio.run(status()) == 422


NO_PINGS: tuple[str | bytes, ...] = (
    b"\x00\x01",
    "",
    "garbage",
    "{}",
    '{"type": "ping"}',
    '{"type": "ping", "id": -1}',
    '{"type": "ping", "id": ' + "9" * 400 + "}",
    '{"type": "ping", "id": NaN}',
    '{"type": "hello"}',
    "[" * 20_000,
)


def test_messages_that_are_no_pings_are_told_so(server: Running, unchanged: Owned) -> None:
    async def types() -> list[str]:
        heard: list[str] = []
        async with websockets.connect(
            server.stream(unchanged.id), subprotocols=[websockets.Subprotocol("reina.v1")]
        ) as socket:
            for message in NO_PINGS:
                await socket.send(message)
            await socket.send('{"type": "ping", "id": 9007199254740992}')
            async for message in socket:
                if isinstance(message, str):
                    heard.append(json.loads(message)["type"])
                if heard and heard[-1] == "pong":
                    break
        return heard

    heard = asyncio.run(types())
    assert heard.count("error") == len(NO_PINGS)
    assert heard[-1] == "pong"


def test_a_message_too_large_ends_its_sender_alone(server: Running, unchanged: Owned) -> None:
    async def closed_with() -> int:
        address, protocols = server.stream(unchanged.id), [websockets.Subprotocol("reina.v1")]
        async with (
            websockets.connect(address, subprotocols=protocols) as loud,
            websockets.connect(address, subprotocols=protocols) as quiet,
        ):
            await loud.send("x" * 100_000)
            async with asyncio.timeout(5.0):
                await loud.wait_closed()
            await quiet.send('{"type": "ping", "id": 1}')
            while True:
                message = await asyncio.wait_for(quiet.recv(), 5.0)
                if isinstance(message, str) and '"pong"' in message:
                    break
        assert loud.close_code is not None
        return loud.close_code

    assert asyncio.run(closed_with()) == 1009
