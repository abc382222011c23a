"""The stream over a real WebSocket."""

from __future__ import annotations

import asyncio
import contextlib
import json
import socket
import struct
import time
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import websockets
from tests.integration.scores import scale, song
from tests.integration.server import upload
from tests.integration.watching import PATIENCE_S, Watcher, watch

from reina.protocol import SUBPROTOCOL, FrameFlag, decode

if TYPE_CHECKING:
    import httpx
    from numpy.typing import NDArray
    from tests.integration.server import Owned, Running

BACKLOG_BYTES = 200_000
"""What a viewer that does not read is sent at most: its socket's, the system's and the server's buffers."""
SEEKS_TO_FILL = 30
"""Each sends twelve frames, 18 kB: together more than `BACKLOG_BYTES`."""
BODY = 24
"""Where a frame's header ends: what stands there is the same for everybody at any time."""
MAX_PINGS = 500


def whole(watcher: Watcher, chosen: NDArray[np.bool_]) -> dict[int, bytes]:
    """Frame index to all its bytes as they came, of the frames that are chosen, the padding too."""
    # By bytes: where NumPy picks rows of a structured array it leaves the padding as it finds it.
    rows = np.frombuffer(b"".join(watcher.messages), np.uint8).reshape(-1, watcher.manifest.frame_size)
    return {
        int(index): row.tobytes()
        for index, row in zip(watcher.frames["index"][chosen], rows[chosen], strict=True)
    }


def bodies(frames: dict[int, bytes]) -> dict[int, bytes]:
    """The bytes from 24 on."""
    return {index: frame[BODY:] for index, frame in frames.items()}


async def control(owned: Owned, action: str, **fields: Any) -> dict[str, Any]:
    """Use the transport without holding up the event loop."""
    return await asyncio.to_thread(owned.control, action, **fields)


def test_hello_says_what_every_frame_holds(server: Running, owned: Owned) -> None:
    async def scenario() -> Watcher:
        async with watch(server, owned.id) as watcher:
            await watcher.until(lambda: watcher.messages)
            return watcher

    watcher = asyncio.run(scenario())
    hello = watcher.hello
    assert hello["type"] == "hello"
    assert hello["fps"] == 60
    assert [skeleton["name"] for skeleton in hello["skeletons"]] == ["player", "trumpet"]
    assert "rightIndexDistal" in hello["skeletons"][0]["joints"]
    assert {"trumpet/valve/1", "camera/fov"} <= {parameter["path"] for parameter in hello["parameters"]}
    assert hello["transport"]["playing"] is False
    assert hello["links"]["rigs"].keys() == {"trumpeter", "trumpet"}
    assert hello["song"]["status"] == "ready"
    [frame] = watcher.frames
    assert frame["index"] == 0
    assert frame["flags"] == 0, "who joins late gets no first frame of the epoch"
    assert np.allclose(np.linalg.norm(frame["rotations"], axis=-1), 1.0, atol=1e-6)
    manifest = owned.client.get(f"{owned.path}/manifest").json()
    # These go on meanwhile.
    moving = {"transport": 0, "alignment": 0}
    assert manifest | moving == hello | moving


def test_playing_streams_sixty_frames_a_second_ahead_of_their_time(server: Running, owned: Owned) -> None:
    arrivals: list[tuple[float, bytes]] = []

    async def scenario() -> Watcher:
        async with watch(server, owned.id) as watcher:
            await watcher.until(lambda: watcher.messages)
            await control(owned, "play")
            await watcher.until(lambda: watcher.of_type("transport"))
            seen = len(watcher.messages)
            while len(watcher.messages) < seen + 90:
                count = len(watcher.messages)
                await watcher.until(lambda count=count: len(watcher.messages) > count)
                # The server's clock is this machine's monotonic one.
                arrivals.extend((time.monotonic(), message) for message in watcher.messages[count:])
            await control(owned, "pause")
            return watcher

    watcher = asyncio.run(scenario())
    frames = watcher.frames
    played = frames[(frames["flags"] & FrameFlag.PLAYING) != 0]
    assert played["index"].tolist() == list(range(len(played))), "each frame once, in order"
    assert played["flags"][0] & FrameFlag.FIRST
    assert np.diff(played["due_time_s"]) == pytest.approx(1 / 60)
    assert played["song_time_s"] == pytest.approx(played["index"] / 60)
    late = [at - decode(watcher.manifest, message)["due_time_s"][0] for at, message in arrivals]
    assert np.median(late) < -0.05, "frames come about 100 ms before they are due"


def test_seeking_shows_what_playing_to_there_shows(server: Running, owned: Owned) -> None:
    async def scenario() -> tuple[Watcher, list[int], list[int]]:
        async with watch(server, owned.id) as watcher:
            played = await control(owned, "play")
            await watcher.frame(75, epoch=played["epoch"])
            await control(owned, "pause")
            paused = await control(owned, "seek", song_time_s=0.0)
            await watcher.frame(0, epoch=paused["epoch"])
            frames = watcher.frames
            sought: list[int] = []
            # On a machine that is busy some frames may have been lost: those next to them do as well.
            seen = frames["index"][frames["flags"] & FrameFlag.PLAYING != 0]
            wanted = [int(seen[np.abs(seen - index).argmin()]) for index in (70, 3, 59, 60, 0, 61)]
            for index in wanted:
                state = await control(owned, "seek", song_time_s=index / 60)
                await watcher.frame(index, epoch=state["epoch"])
                sought.append(state["epoch"] % 256)
            return watcher, sought, wanted

    watcher, epochs, wanted = asyncio.run(scenario())
    frames = watcher.frames
    sought = np.isin(frames["epoch"], epochs)
    assert frames["index"][sought].tolist() == wanted, "while paused, one frame a change"
    assert (frames["flags"][sought] == FrameFlag.FIRST).all()
    expected = bodies(whole(watcher, frames["flags"] & FrameFlag.PLAYING != 0))
    got = bodies(whole(watcher, sought))
    assert got == {index: expected[index] for index in set(wanted)}


def test_frames_over_http_are_those_of_the_stream(server: Running, owned: Owned) -> None:
    async def scenario() -> Watcher:
        async with watch(server, owned.id) as watcher:
            state = await control(owned, "play")
            await watcher.frame(70, epoch=state["epoch"])
            await control(owned, "pause")
            return watcher

    watcher = asyncio.run(scenario())
    query = {"start_s": 0, "end_s": 70 / 60}
    answer = owned.client.get(f"{owned.path}/frames", params=query)
    assert answer.headers["content-length"] == str(70 * watcher.manifest.frame_size)
    over_http = decode(watcher.manifest, answer.content)
    assert over_http["index"].tolist() == list(range(70))
    assert not over_http["epoch"].any()
    assert not over_http["due_time_s"].any()
    size = watcher.manifest.frame_size
    fetched = {index: answer.content[index * size : (index + 1) * size] for index in range(70)}
    playing = watcher.frames["flags"] & FrameFlag.PLAYING != 0
    streamed = {index: body for index, body in bodies(whole(watcher, playing)).items() if index < 70}
    assert len(streamed) >= 50
    assert streamed == {index: bodies(fetched)[index] for index in streamed}


def test_two_viewers_see_the_same_bytes(server: Running, owned: Owned) -> None:
    async def scenario() -> tuple[Watcher, Watcher, Watcher]:
        async with (
            watch(server, owned.id) as one,
            watch(server, owned.id) as two,
            watch(server, owned.id, frames_per_message=6) as by_six,
        ):
            state = await control(owned, "play")
            for watcher in (one, two, by_six):
                await watcher.frame(40, epoch=state["epoch"])
            await control(owned, "pause")
            return one, two, by_six

    one, two, by_six = asyncio.run(scenario())

    seen = [
        whole(watcher, watcher.frames["flags"] & FrameFlag.PLAYING != 0) for watcher in (one, two, by_six)
    ]
    # Whoever was held up on a busy machine has lost frames, each its own.
    common = sorted(set(seen[0]) & set(seen[1]) & set(seen[2]))
    assert len(common) >= 20
    for index in common:
        assert seen[0][index] == seen[1][index] == seen[2][index]
    sizes = {len(message) // by_six.manifest.frame_size for message in by_six.messages[1:-1]}
    assert 6 in sizes
    assert {len(message) for message in one.messages} == {one.manifest.frame_size}


def test_every_change_reaches_every_viewer_under_its_own_epoch(server: Running, owned: Owned) -> None:
    async def scenario() -> tuple[Watcher, Watcher, list[int]]:
        async with watch(server, owned.id) as one, watch(server, owned.id) as two:
            epochs: list[int] = []
            for action, fields in (
                ("play", {}),
                ("seek", {"song_time_s": 1.0}),
                ("rate", {"rate": 2.0}),
                ("loop", {"start_s": 0.5, "end_s": 1.5}),
                ("loop", {"start_s": None, "end_s": None}),
                ("pause", {}),
            ):
                state = await control(owned, action, **fields)
                epochs.append(state["epoch"])
            for watcher in (one, two):
                await watcher.frame(0, epoch=epochs[-1])
                await watcher.until(lambda watcher=watcher: len(watcher.of_type("transport")) == len(epochs))
            await control(owned, "rate", rate=1.0)
            return one, two, epochs

    one, two, epochs = asyncio.run(scenario())
    assert epochs == list(range(epochs[0], epochs[0] + 6))
    for watcher in (one, two):
        told = watcher.of_type("transport")[:6]
        assert [message["epoch"] for message in told] == epochs
        assert [message["playing"] for message in told] == [True] * 5 + [False]
        assert told[3]["loop"] == {"start_s": 0.5, "end_s": 1.5, "count_in_s": 0.0}
        frames = watcher.frames
        assert (np.diff(frames["epoch"].astype(int)) >= 0).all(), "no frame of an older epoch after a newer"
        sought = frames[frames["epoch"] == epochs[1] % 256]
        assert len(sought) == 0 or sought["index"][0] == 60


def test_notes_are_told_as_they_begin_and_end(server: Running, owned: Owned) -> None:
    async def scenario() -> Watcher:
        async with watch(server, owned.id) as watcher:
            await control(owned, "seek", song_time_s=0.4)
            await control(owned, "play")
            await watcher.until(lambda: len(watcher.of_type("note_off")) >= 5)
            await control(owned, "pause")
            return watcher

    watcher = asyncio.run(scenario())
    events = [text for text in watcher.texts if text["type"] in ("note_on", "note_off")]
    # Note 0 sounded where the clock stood; the seek ended it and went into note 1.
    order = [(event["type"], event["index"]) for event in events]
    assert order[:3] == [("note_on", 0), ("note_off", 0), ("note_on", 1)]
    for number in range(2, 4):
        ended = order.index(("note_off", number - 1))
        assert order[ended + 1] == ("note_on", number)
    second = next(event for event in events if event["index"] == 2)
    assert second["song_time_s"] == pytest.approx(0.5)
    assert second["sounding_pitch"] == 60
    assert second["valves"] == [1, 3]


def test_who_joins_late_goes_on_from_the_present(server: Running, owned: Owned) -> None:
    async def scenario() -> tuple[Watcher, int]:
        async with watch(server, owned.id) as early:
            state = await control(owned, "play")
            await early.frame(40, epoch=state["epoch"])
            async with watch(server, owned.id) as late:
                await late.frame(60, epoch=state["epoch"])
                await control(owned, "pause")
                return late, int(early.frames["index"].max())

    late, _ = asyncio.run(scenario())
    hello = late.hello["transport"]
    assert hello["playing"] is True
    frames = late.frames
    played = frames[(frames["flags"] & FrameFlag.PLAYING) != 0]["index"]
    assert played[0] == int(hello["song_time_s"] * 60)
    assert played.tolist() == list(range(int(played[0]), int(played[-1]) + 1)), "no gap, nothing twice"


def test_the_end_stops_the_clock(server: Running, owned: Owned) -> None:
    async def scenario() -> Watcher:
        async with watch(server, owned.id) as watcher:
            await control(owned, "seek", song_time_s=owned.body["duration_s"] - 0.3)
            await control(owned, "play")
            await watcher.until(lambda: len(watcher.of_type("transport")) == 3)
            return watcher

    watcher = asyncio.run(scenario())
    told = watcher.of_type("transport")[-1]
    assert told["playing"] is False
    assert told["song_time_s"] == owned.body["duration_s"]
    again = owned.control("play")
    assert again["song_time_s"] < 1.0
    owned.control("pause")


def test_a_viewer_may_ask_for_its_frames_earlier(server: Running, owned: Owned) -> None:
    async def scenario() -> Watcher:
        async with watch(server, owned.id) as watcher:
            await watcher.socket.send(json.dumps({"type": "lead", "lead_s": 1.0}))
            await control(owned, "play")
            early_s, pings = 0.0, 0
            while early_s < 0.5:
                await watcher.socket.send(json.dumps({"type": "ping", "id": pings}))
                pings += 1
                await watcher.until(lambda: len(watcher.of_type("pong")) == pings)  # noqa: B023
                now_s = watcher.of_type("pong")[-1]["server_time_s"]
                early_s = float(watcher.frames["due_time_s"].max()) - now_s
                assert pings < MAX_PINGS, f"frames come {early_s:.2f} s before they are due"
                await asyncio.sleep(0.02)
            for lead in ("null", "9", '"x"'):
                await watcher.socket.send(f'{{"type": "lead", "lead_s": {lead}}}')
            await watcher.until(lambda: len(watcher.of_type("error")) == 3)
            return watcher

    watcher = asyncio.run(scenario())
    owned.control("pause")
    assert '"lead"' in watcher.of_type("error")[0]["detail"]


def test_ping_measures_the_servers_clock(server: Running, owned: Owned) -> None:
    async def scenario() -> tuple[float, float, Watcher]:
        async with watch(server, owned.id) as watcher:
            before = time.monotonic()
            await watcher.socket.send(json.dumps({"type": "ping", "id": 42}))
            await watcher.until(lambda: watcher.of_type("pong"))
            after = time.monotonic()
            for nonsense in ("hello?", b"\x00\x01", '{"type": "ping", "id": -1}', '{"type": "play"}'):
                await watcher.socket.send(nonsense)
            await watcher.until(lambda: len(watcher.of_type("error")) == 4)
            await watcher.socket.send(json.dumps({"type": "ping", "id": 43}))
            await watcher.until(lambda: len(watcher.of_type("pong")) == 2)
            return before, after, watcher

    before, after, watcher = asyncio.run(scenario())
    pong = watcher.of_type("pong")[0]
    assert pong["id"] == 42
    assert before <= pong["server_time_s"] <= after


@pytest.mark.parametrize(
    ("session", "query", "subprotocols", "origin", "status", "told"),
    [
        ("own", "", ["reina.v2"], None, 400, "speaks reina.v1"),
        ("own", "", [], None, 400, "speaks reina.v1"),
        ("nobody", "", [SUBPROTOCOL], None, 404, "no session"),
        ("own", "frames_per_message=13", [SUBPROTOCOL], None, 422, "1 to 12"),
        ("own", "frames_per_message=0", [SUBPROTOCOL], None, 422, "1 to 12"),
        ("own", "frames_per_message=all", [SUBPROTOCOL], None, 422, "1 to 12"),
        ("own", "", [SUBPROTOCOL], "http://evil.example", 403, "evil.example"),
    ],
)
def test_a_stream_that_cannot_be_is_refused_before_the_handshake_ends(
    server: Running,
    owned: Owned,
    session: str,
    query: str,
    subprotocols: list[str],
    origin: str | None,
    status: int,
    told: str,
) -> None:
    address = server.stream(owned.id if session == "own" else session) + query

    async def scenario() -> None:
        offered = [websockets.Subprotocol(name) for name in subprotocols]
        named = websockets.Origin(origin) if origin else None
        async with websockets.connect(address, subprotocols=offered or None, origin=named):
            pass

    with pytest.raises(websockets.InvalidStatus) as refused:
        asyncio.run(scenario())
    response = refused.value.response
    assert response.status_code == status
    assert response.headers["content-type"] == "application/problem+json"
    assert told in json.loads(response.body or b"")["detail"]


def test_the_stream_is_not_compressed(server: Running, owned: Owned) -> None:
    async def scenario() -> list[str]:
        async with websockets.connect(
            server.stream(owned.id), subprotocols=[websockets.Subprotocol(SUBPROTOCOL)], compression="deflate"
        ) as connection:
            return [extension.name for extension in connection.protocol.extensions]

    assert asyncio.run(scenario()) == []


def stalled(server: Running, session: str, query: str = "") -> socket.socket:
    """A viewer by hand, with a small window, that never reads."""
    host, port = server.address.removeprefix("http://").rsplit(":", 1)
    connection = socket.socket()
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    connection.connect((host, int(port)))
    request = (
        f"GET /api/v1/sessions/{session}/stream?{query} HTTP/1.1\r\nHost: {host}:{port}\r\n"
        "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
        f"Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Protocol: {SUBPROTOCOL}\r\n\r\n"
    )
    connection.sendall(request.encode())
    assert connection.recv(12) == b"HTTP/1.1 101"
    return connection


def backlog(line: socket.socket) -> int:
    """How many bytes are still on their way to a viewer."""
    line.settimeout(0.3)
    received = 0
    with contextlib.suppress(TimeoutError):
        while chunk := line.recv(65536):
            received += len(chunk)
    return received


def test_a_viewer_that_stops_reading_costs_nobody_anything(server: Running, owned: Owned) -> None:
    async def scenario(seconds: float) -> tuple[Watcher, int]:
        async with watch(server, owned.id) as watcher:
            await control(owned, "loop", start_s=0.0, end_s=3.0)
            state = await control(owned, "play")
            await watcher.frame(20, epoch=state["epoch"])
            before = server.memory_bytes()
            await asyncio.sleep(seconds)
            grown = server.memory_bytes() - before
            await control(owned, "pause")
            await control(owned, "loop", start_s=None, end_s=None)
            return watcher, grown

    lines = [stalled(server, owned.id) for _ in range(4)]
    try:
        watcher, grown = asyncio.run(scenario(3.0))
        behind = [backlog(line) for line in lines]
    finally:
        for line in lines:
            line.close()
    frames = watcher.frames
    played = frames[(frames["flags"] & FrameFlag.PLAYING) != 0]
    steps = np.diff(played["index"].astype(int))
    assert set(steps.tolist()) <= {1, -179}, "the others get every frame"
    assert len(played) >= 3 * 60
    # Each stalled viewer may fill its socket's buffers and its outbox, and no more; the rest it has lost.
    assert grown < 4_000_000
    assert len(played) * watcher.manifest.frame_size > BACKLOG_BYTES
    assert max(behind) < BACKLOG_BYTES


def test_too_many_control_messages_close_with_try_again_later(server: Running, owned: Owned) -> None:
    line = stalled(server, owned.id, "frames_per_message=12")
    line.settimeout(PATIENCE_S)
    # While playing a seek sends twelve frames: these shut the window soon. Those that wait then give way to
    # the next seek's, but messages do not: the transport, the note that is left, and the one that is come to.
    owned.control("play")
    for number in range(SEEKS_TO_FILL + 256 // 3 + 1):
        owned.control("seek", song_time_s=number % 3)
    owned.control("pause")
    received = bytearray()
    goodbye = struct.pack("!H", 1013) + b"too many messages wait; connect again"
    while not received.endswith(goodbye):
        chunk = line.recv(65536)
        assert chunk, "it is told why before the line is closed"
        received += chunk
    line.close()


def test_a_session_that_ends_lets_its_viewers_go(server: Running, client: httpx.Client) -> None:
    session = upload(client, scale(2), song=("s.wav", song()))

    async def scenario() -> int | None:
        async with watch(server, session.id) as watcher:
            await asyncio.to_thread(lambda: session.change("DELETE").raise_for_status())
            await asyncio.wait_for(watcher.socket.wait_closed(), PATIENCE_S)
            return watcher.socket.close_code

    assert asyncio.run(scenario()) == 1001
