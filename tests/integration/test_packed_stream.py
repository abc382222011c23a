"""Packed blocks over a real WebSocket and over HTTP."""

from __future__ import annotations

import asyncio
import time
from typing import TYPE_CHECKING, Any

import httpx
import numpy as np
import pytest
import websockets
from tests.integration.scores import scale, song
from tests.integration.server import serve, upload
from tests.integration.watching import Watcher, watch
from websockets.sync.client import connect

from reina.protocol import SUBPROTOCOL, Frames, decode, unpack
from reina.protocol.packed_block import packed_header

if TYPE_CHECKING:
    from pathlib import Path

    from tests.integration.server import Owned, Running

FOV = "/show/tracks/camera/fov"


def numbers(watcher: Watcher) -> list[int]:
    """Of the blocks that came."""
    return [int(packed_header(message)["block"]) for message in watcher.messages]


def revisions(watcher: Watcher) -> list[str]:
    return [f"{int(packed_header(message)['revision']):016x}" for message in watcher.messages]


async def control(owned: Owned, action: str, **fields: Any) -> dict[str, Any]:
    return await asyncio.to_thread(owned.control, action, **fields)


def frames_of(owned: Owned, watcher: Watcher, block: int) -> Frames:
    """The same frames, as they are."""
    span = {"start_s": block, "end_s": block + 1}
    answer = owned.client.get(f"{owned.path}/frames", params=span).raise_for_status()
    return decode(watcher.manifest, answer.content)


def assert_same(found: Frames, wanted: Frames) -> None:
    assert np.array_equal(found["index"], wanted["index"])
    assert np.array_equal(found["flags"], wanted["flags"])
    for name in ("rotations", "root_positions", "parameters"):
        assert np.abs(found[name] - wanted[name]).max() < 2e-4


def edit_fov(owned: Owned, radians: float) -> httpx.Response:
    return owned.change(
        "PUT", FOV, json={"parameter": "camera/fov", "keyframes": [{"time": 0, "value": radians}]}
    )


def test_who_joins_gets_the_present_block_and_playing_the_ones_to_come(server: Running, owned: Owned) -> None:
    async def scenario() -> Watcher:
        async with watch(server, owned.id, packed=1) as watcher:
            await watcher.until(lambda: watcher.messages)
            assert numbers(watcher) == [0], "while paused there is nothing to come"
            await control(owned, "play")
            # The present one, and those of the next two seconds; nothing has been played yet.
            await watcher.until(lambda: numbers(watcher)[1:4] == [0, 1, 2])
            played = await control(owned, "pause")
            assert played["song_time_s"] < 1.0
            await control(owned, "seek", song_time_s=5.25)
            await watcher.until(lambda: numbers(watcher)[-1] == 5)
            return watcher

    watcher = asyncio.run(scenario())
    assert set(revisions(watcher)) == {watcher.hello["blocks"]["revision"]}
    for message in watcher.messages:
        assert_same(
            unpack(watcher.manifest, message),
            frames_of(owned, watcher, int(packed_header(message)["block"])),
        )
    assert max(map(len, watcher.messages)) < 4_000


def test_who_wants_no_words_of_notes_hears_all_the_rest(server: Running, owned: Owned) -> None:
    async def scenario() -> None:
        async with (
            watch(server, owned.id, packed=1, notes=0) as quiet,
            watch(server, owned.id, packed=1) as told,
        ):
            await control(owned, "play")
            await told.until(lambda: len(told.of_type("note_off")) >= 2)
            await asyncio.to_thread(edit_fov, owned, 0.8)
            await control(owned, "pause")
            for watcher in (quiet, told):
                await watcher.until(lambda w=watcher: not w.of_type("transport")[-1]["playing"])
            kinds = {text["type"] for text in told.texts}
            assert {text["type"] for text in quiet.texts} == kinds - {"note_on", "note_off"}

    asyncio.run(scenario())
    with pytest.raises(websockets.InvalidStatus) as refused:
        connect(server.stream(owned.id, notes=2), subprotocols=[websockets.Subprotocol(SUBPROTOCOL)])
    assert "notes is 0 or 1, not 2" in refused.value.response.body.decode()


def test_a_block_comes_two_seconds_before_it_is_due(server: Running, owned: Owned) -> None:
    arrivals: dict[int, float] = {}

    async def scenario() -> dict[str, Any]:
        async with watch(server, owned.id, packed=1) as watcher:
            await control(owned, "play")
            await watcher.until(lambda: watcher.of_type("transport"))
            while len(arrivals) < 5:
                count = len(watcher.messages)
                await watcher.until(lambda count=count: len(watcher.messages) > count)
                for number in numbers(watcher)[count:]:
                    # The server's clock is this machine's monotonic one.
                    arrivals.setdefault(number, time.monotonic())
            return watcher.of_type("transport")[-1]

    begun = asyncio.run(scenario())
    due = {n: begun["server_time_s"] + n - begun["song_time_s"] for n in arrivals}
    ahead = [due[number] - arrivals[number] for number in (3, 4)]
    assert min(ahead) > 1.0, "though the machine be busy, long before"
    assert max(ahead) <= 2.05


def test_an_edit_tells_its_revision_before_its_first_block(server: Running, owned: Owned) -> None:
    async def scenario() -> Watcher:
        async with watch(server, owned.id, packed=1) as watcher:
            await watcher.until(lambda: watcher.messages)
            before = watcher.hello["blocks"]
            (await asyncio.to_thread(edit_fov, owned, 0.55)).raise_for_status()
            await watcher.until(lambda: len(watcher.messages) > 1)
            [told] = watcher.of_type("blocks_changed")
            assert told["revision"] == revisions(watcher)[-1] != before["revision"]
            gone = await asyncio.to_thread(owned.client.get, f"{before['href']}/0")
            assert gone.status_code == 410
            assert gone.json()["type"].endswith("other-revision")
            assert told["revision"] in gone.json()["detail"]
            (await asyncio.to_thread(owned.change, "POST", "/show/undo")).raise_for_status()
            await watcher.until(lambda: len(watcher.messages) > 2)
            assert revisions(watcher)[-1] == before["revision"], "the same show has the same frames"
            return watcher

    watcher = asyncio.run(scenario())
    place = [parameter.path for parameter in watcher.manifest.parameters].index("camera/fov")
    offset = watcher.manifest.parameters[place].offset - watcher.manifest.parameters[0].offset
    fov = [unpack(watcher.manifest, message)["parameters"][0, offset // 4] for message in watcher.messages]
    assert fov[1] == pytest.approx(0.55, abs=1e-4)
    assert fov[0] == fov[2]
    assert fov[0] != fov[1]


def test_a_loop_of_a_few_seconds_is_sent_once(server: Running, owned: Owned) -> None:
    async def scenario() -> Watcher:
        async with watch(server, owned.id, packed=1) as watcher:
            await control(owned, "loop", start_s=1.0, end_s=2.5)
            await control(owned, "rate", rate=4.0)
            await control(owned, "seek", song_time_s=1.0)
            began = await control(owned, "play")
            await watcher.until(lambda: watcher.of_type("transport")[-1]["epoch"] == began["epoch"])
            await watcher.until(lambda: numbers(watcher)[-1] == 2)
            sent = len(watcher.messages)
            # Several rounds; pings are answered in the order of what is sent.
            await asyncio.sleep(1.5)
            await watcher.socket.send('{"type": "ping", "id": 1}')
            await watcher.until(lambda: watcher.of_type("pong"))
            assert len(watcher.messages) == sent
            return watcher

    assert numbers(asyncio.run(scenario()))[-2:] == [1, 2]


def test_blocks_over_http_are_the_streams_and_may_be_kept_for_good(server: Running, owned: Owned) -> None:
    async def scenario() -> Watcher:
        async with watch(server, owned.id, packed="lossless") as watcher:
            await watcher.until(lambda: watcher.messages)
            return watcher

    watcher = asyncio.run(scenario())
    client, blocks = owned.client, watcher.hello["blocks"]
    assert blocks["pushed"] is True
    answer = client.get(f"{blocks['href']}/0", params={"form": "lossless"})
    assert answer.content == watcher.messages[0]
    assert unpack(watcher.manifest, answer.content).tobytes() == frames_of(owned, watcher, 0).tobytes()
    assert "immutable" in answer.headers["Cache-Control"]
    assert answer.headers["Access-Control-Allow-Origin"] == "*"
    assert "Content-Encoding" not in answer.headers
    etag = answer.headers["ETag"]
    assert not etag.startswith("W/")
    packed = client.get(f"{blocks['href']}/0")
    assert packed.headers["ETag"] != etag
    assert len(packed.content) < len(answer.content) / 3
    again = client.get(f"{blocks['href']}/0", headers={"If-None-Match": packed.headers["ETag"]})
    assert (again.status_code, again.content) == (304, b"")
    beyond = client.get(f"{blocks['href']}/100000")
    assert (beyond.status_code, beyond.json()["type"]) == (404, "urn:reina:problem:unknown-block")
    assert client.get(f"{blocks['href']}/-1").status_code == 422


@pytest.mark.parametrize("query", [{"packed": "2"}, {"packed": ""}, {"packing": 1}])
def test_what_cannot_be_asked_for_is_said(server: Running, owned: Owned, query: dict[str, Any]) -> None:
    async def scenario() -> None:
        async with websockets.connect(
            server.stream(owned.id, **query), subprotocols=[websockets.Subprotocol(SUBPROTOCOL)]
        ):
            pass

    with pytest.raises(websockets.InvalidStatus) as refused:
        asyncio.run(scenario())
    assert refused.value.response.status_code == 422
    assert b"packed" in refused.value.response.body


def test_a_revision_is_the_same_after_a_restart(tmp_path: Path) -> None:
    with serve(tmp_path, "--no-page") as server, httpx.Client(base_url=server.address) as client:
        owned = upload(client, scale(8), song=("s.wav", song()))
        edit_fov(owned, 0.45).raise_for_status()
        before = client.get(f"{owned.path}/manifest").json()["blocks"]
        block = client.get(f"{before['href']}/1").content
    with serve(tmp_path, "--no-page") as server, httpx.Client(base_url=server.address) as client:
        assert client.get(f"{owned.path}/manifest").json()["blocks"] == before
        assert client.get(f"{before['href']}/1").content == block


def test_pages_can_be_told_to_fetch_blocks_elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("REINA_BLOCKS_ORIGIN", "https://blocks.example.org:8443")
    with serve(tmp_path) as server, httpx.Client(base_url=server.address) as client:
        owned = upload(client, scale(8), song=("s.wav", song()))
        blocks = client.get(f"{owned.path}/manifest").json()["blocks"]
        assert blocks["pushed"] is False
        assert blocks["href"].startswith(f"https://blocks.example.org:8443{owned.path}/blocks/")
        policy = client.get(f"/s/{owned.id}").headers["Content-Security-Policy"]
        [sources] = [part for part in policy.split("; ") if part.startswith("connect-src")]
        assert "https://blocks.example.org:8443" in sources.split()

        async def scenario() -> list[int]:
            async with watch(server, owned.id, packed=1) as watcher:
                await watcher.socket.send('{"type": "ping", "id": 1}')
                await watcher.until(lambda: watcher.of_type("pong"))
                return numbers(watcher)

        assert asyncio.run(scenario()) == [], "nothing is pushed that is fetched"
