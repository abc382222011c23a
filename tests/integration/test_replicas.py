"""Two servers that serve the same sessions: whichever is asked, it is the same."""

from __future__ import annotations

import asyncio
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

import httpx
import numpy as np
import pytest
from tests.integration.killed import LIGHT, light, move_light
from tests.integration.replicas import Fan, Replicas, all_have, control, replicas
from tests.integration.scores import scale, show, song
from tests.integration.server import upload
from tests.integration.test_alignment import NAME, recording
from tests.integration.watching import watch
from tests.servers.proxies import Proxy, replicas_proxy
from tests.unit.sound.alignment.renditions import SCORES

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from tests.integration.server import Owned
    from tests.integration.watching import Watcher
    from tests.servers.postgresql import PostgreSQL

FRAME_S = 1 / 60


@pytest.fixture(scope="module")
def two(tmp_path_factory: pytest.TempPathFactory, postgresql_server: PostgreSQL) -> Iterator[Replicas]:
    folder = tmp_path_factory.mktemp("replicas")
    with replicas(folder, postgresql_server) as made:
        yield made
    for number in range(2):
        assert "Traceback" not in (folder / f"log-{number}").read_text()


@pytest.fixture
def piece(two: Replicas) -> Iterator[Owned]:
    """A session that the first server has made."""
    made = upload(
        two.client(0), scale(200), song=("song.wav", song()), show=("s.json", show(0.5)), in_time="true"
    )
    yield made
    made.change("DELETE")


def offset_s(watcher: Watcher) -> float:
    """Server time at which song time 0 would be due, by the last frame."""
    frame = watcher.frames[-1]
    return float(frame["due_time_s"] - frame["song_time_s"])


def test_what_one_makes_the_other_has(two: Replicas, piece: Owned) -> None:
    other = two.at(1, piece)
    assert other.client.get(piece.path).json()["title"] == piece.body["title"]
    for number in range(12):
        one, there = two.at(number % 2, piece), two.at(1 - number % 2, piece)
        answer = one.change("PATCH", json={"title": f"Title {number}"})
        assert answer.status_code == 200, answer.text
        assert there.client.get(piece.path).json()["title"] == f"Title {number}"


def test_the_transport_is_one(two: Replicas, piece: Owned) -> None:
    async def scenario() -> None:
        one, other = piece, two.at(1, piece)
        async with watch(two.servers[0], piece.id) as first, watch(two.servers[1], piece.id) as second:
            await control(one, "play")
            for watcher in (first, second):
                await watcher.until(lambda w=watcher: w.messages and w.frames[-1]["index"] >= 20)
            assert abs(offset_s(first) - offset_s(second)) < FRAME_S / 4
            await control(other, "seek", song_time_s=7.0)
            for watcher in (first, second):
                await watcher.until(lambda w=watcher: (w.frames["index"] >= 440).any())
            assert abs(offset_s(first) - offset_s(second)) < FRAME_S / 4
            told = [watcher.of_type("transport")[-1] for watcher in (first, second)]
            assert told[0]["rate"] == told[1]["rate"] == 1.0
            await control(one, "pause")
            for watcher in (first, second):
                await watcher.until(lambda w=watcher: not w.of_type("transport")[-1]["playing"])
            stands = {watcher.of_type("transport")[-1]["song_time_s"] for watcher in (first, second)}
            assert max(stands) - min(stands) < 1e-4

    asyncio.run(scenario())


def test_whoever_commands_at_the_same_time_agrees(two: Replicas, piece: Owned) -> None:
    async def scenario() -> None:
        async with watch(two.servers[0], piece.id) as first, watch(two.servers[1], piece.id) as second:
            rates = [1.0 + number / 100 for number in range(40)]
            servers = [two.at(number % 2, piece) for number in range(40)]
            asked = [control(at, "rate", rate=rate) for at, rate in zip(servers, rates, strict=True)]
            states = await asyncio.gather(*asked)
            assert [state["rate"] for state in states] == rates, "each was followed"
            last = await control(piece, "pause")
            for watcher in (first, second):
                await watcher.until(lambda w=watcher: w.of_type("transport")[-1]["rate"] == last["rate"])

    asyncio.run(scenario())


def test_no_edit_of_either_is_lost(two: Replicas, piece: Owned) -> None:
    def add(number: int) -> str:
        fields = {"time": 1.0 + number, "value": number / 100}
        path = f"/show/tracks/{LIGHT}/keyframes"
        answer = two.at(number % 2, piece).change("POST", path, json=fields)
        assert answer.status_code == 201, answer.text
        assert answer.json()["value"] == fields["value"]
        return str(answer.json()["key"])

    with ThreadPoolExecutor(4) as pool:
        keys = list(pool.map(add, range(24)))
    assert len(set(keys)) == 24
    for number in range(2):
        track = two.client(number).get(f"{piece.path}/show/tracks/{LIGHT}").json()
        assert {keyframe["key"] for keyframe in track["keyframes"]} == {"k1", *keys}
    # Any server takes any step back.
    for number in range(24):
        answer = two.at(number % 2, piece).change("POST", "/show/undo")
        assert (answer.status_code, answer.json()["undo"]) == (200, 23 - number)
    assert two.at(1, piece).change("POST", "/show/redo").json()["redo"] == 23


def test_who_watches_elsewhere_sees_an_edit(two: Replicas, piece: Owned) -> None:
    async def scenario() -> None:
        async with watch(two.servers[1], piece.id) as watcher:
            await asyncio.to_thread(move_light, piece, 1.75)
            await watcher.until(lambda: watcher.of_type("show_changed"))
            (told,) = watcher.of_type("show_changed")
            assert (told["paths"], told["undo"]) == ([LIGHT], 1)
            assert told["etag"] == piece.client.get(f"{piece.path}/show").headers["ETag"]
            here = two.client(1).get(f"{piece.path}/frames", params={"start_s": 1, "end_s": 2})
            there = piece.client.get(f"{piece.path}/frames", params={"start_s": 1, "end_s": 2})
            assert here.content == there.content
            await asyncio.to_thread(piece.change, "PATCH", json={"cast": {"players": [{"transposition": 2}]}})
            await asyncio.to_thread(piece.change, "PATCH", json={"transposition": 2})
            await watcher.until(lambda: watcher.of_type("score_changed"))
            assert watcher.of_type("score_changed")[0]["transposition"] == 2
            blocks = [two.client(number).get(piece.path).json() for number in range(2)]
            assert blocks[0]["sounding_transposition"] == blocks[1]["sounding_transposition"] == 2

    asyncio.run(scenario())


def test_what_is_ended_is_ended_everywhere(two: Replicas) -> None:
    made = upload(two.client(0), scale(4), song=("song.wav", song()), in_time="true")

    async def scenario() -> None:
        async with watch(two.servers[1], made.id) as watcher:
            assert (await asyncio.to_thread(made.change, "DELETE")).status_code == 204
            async with asyncio.timeout(15):
                await watcher.socket.wait_closed()
            assert watcher.socket.close_code == 1001
        assert two.client(1).get(made.path).status_code == 404

    asyncio.run(scenario())


def test_clock_and_edits_outlive_the_bus(two: Replicas, piece: Owned) -> None:
    async def scenario() -> None:
        one, other = piece, two.at(1, piece)
        async with watch(two.servers[0], piece.id) as first, watch(two.servers[1], piece.id) as second:
            await control(one, "play")
            for watcher in (first, second):
                await watcher.until(lambda w=watcher: w.messages and w.frames[-1]["index"] >= 5)
            await asyncio.to_thread(two.redis.stop)
            # What cannot be told to the others is not done here either.
            answer = await asyncio.to_thread(one.change, "POST", "/transport", json={"action": "pause"})
            assert answer.status_code == 503
            assert answer.json()["type"].endswith("bus-away")
            assert int(answer.headers["Retry-After"]) > 0
            # An edit is kept, and whoever asks has it; who watches elsewhere sees it once the bus is back.
            assert (await asyncio.to_thread(move_light, one, 0.25)).status_code == 200
            assert await asyncio.to_thread(light, other) == 0.25
            played = [watcher.frames[-1]["index"] for watcher in (first, second)]
            for watcher, index in zip((first, second), played, strict=True):
                await watcher.until(lambda w=watcher, i=index: w.frames[-1]["index"] > i + 10)
            await asyncio.to_thread(two.redis.start)
            await until(
                lambda: other.change("POST", "/transport", json={"action": "pause"}).status_code == 200
            )
            for watcher in (first, second):
                await watcher.until(lambda w=watcher: not w.of_type("transport")[-1]["playing"])
            await control(one, "play")
            for watcher in (first, second):
                await watcher.until(lambda w=watcher: w.of_type("transport")[-1]["playing"])

    asyncio.run(scenario())


async def until(met: Callable[[], bool]) -> None:
    """Ask until something is so."""
    async with asyncio.timeout(20):
        while not await asyncio.to_thread(met):  # noqa: ASYNC110 - another process is asked
            await asyncio.sleep(0.05)


def test_a_score_is_looked_for_in_its_song_by_one(two: Replicas) -> None:
    score = next(SCORES.glob(f"{NAME}.*")).read_bytes()
    made = upload(two.client(0), score, song=("march.flac", recording()))

    async def scenario() -> None:
        async with watch(two.servers[1], made.id) as watcher:
            assert watcher.hello["alignment"]["status"] == "searching", "the other has not begun anew"

            def told() -> list[str]:
                return [told["status"] for told in watcher.of_type("alignment_changed")]

            await watcher.until(lambda: "found" in told())
            assert set(told()) == {"searching", "found"}

    asyncio.run(scenario())
    maps = [two.client(number).get(f"{made.path}/alignment").json() for number in range(2)]
    assert maps[0] == maps[1]
    made.change("DELETE")


def test_where_a_server_is_killed_all_go_on_at_another(tmp_path: Path, postgresql_server: PostgreSQL) -> None:
    async def scenario(made: Replicas, through: Proxy) -> None:
        with httpx.Client(base_url=through.address, timeout=30.0) as client:
            sent: dict[str, Any] = {"song": ("song.wav", song()), "show": ("s.json", show(0.5))}
            owned = upload(client, scale(400), **sent, in_time="true")
            await control(owned, "play")
            address = f"{through.address.replace('http', 'ws', 1)}{owned.path}/stream?frames_per_message=12"
            fans = [Fan(address) for _ in range(200)]
            watching = [asyncio.create_task(fan.watch()) for fan in fans]
            await all_have(fans, lambda fan: len(fan.offsets_s) >= 3)
            made.servers[0].process.kill()
            killed_s = max(fan.song_time_s for fan in fans)
            await all_have(fans, lambda fan: fan.song_time_s > killed_s + 1.0)
            # Those of the other server have seen nothing of it; nginx shares them out.
            assert {fan.connections for fan in fans} == {1, 2}
            assert 50 <= sum(fan.connections == 2 for fan in fans) <= 150
            # Nobody's song has jumped, wherever he watches on.
            offsets = np.concatenate([fan.offsets_s for fan in fans])
            assert np.ptp(offsets) < FRAME_S
            # What was edited there before is here; and it can be edited and controlled on.
            assert (await asyncio.to_thread(move_light, owned, 1.5)).status_code == 200
            assert (await control(owned, "pause"))["playing"] is False
            for task in watching:
                task.cancel()
            await asyncio.wait(watching)

    with replicas(tmp_path, postgresql_server) as made:
        ports = [int(server.address.rpartition(":")[2]) for server in made.servers]
        with replicas_proxy(ports, tmp_path) as through:
            asyncio.run(scenario(made, through))
