"""What one server holds at most, in memory, on disk and on its way; and clocks that go on by themselves."""

from __future__ import annotations

import asyncio
import json
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import httpx
import pytest
from tests.integration.intake import large_score, large_song, unknown_track
from tests.integration.scores import scale, song
from tests.integration.server import Running, serve, upload
from tests.integration.watching import watch

if TYPE_CHECKING:
    from collections.abc import Generator
    from pathlib import Path

MEGABYTE = 1_000_000


@contextmanager
def server_with(
    data_dir: Path, monkeypatch: pytest.MonkeyPatch, *options: str, **bounds: int
) -> Generator[tuple[Running, httpx.Client]]:
    """A server with bounds of its own, as an operator sets them."""
    for name, value in bounds.items():
        monkeypatch.setenv(f"REINA_{name.upper()}", str(value))
    with (
        serve(data_dir, "--no-page", *options) as server,
        httpx.Client(base_url=server.address, timeout=120) as client,
    ):
        yield server, client


def posted(client: httpx.Client, score: bytes, **files: Any) -> httpx.Response:
    return client.post("/api/v1/sessions", files={"score": ("score.mid", score), **files})


def problem(answer: httpx.Response) -> str:
    return str(answer.json()["type"]).removeprefix("urn:reina:problem:")


def test_sessions_that_play_unwatched_stay_within_the_bound_and_go_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sound = ("s.wav", song())
    with server_with(tmp_path, monkeypatch, memory_mb=6) as (server, client):
        # No score is looked for: what is listened to is not idle.
        warm = [upload(client, scale(200), song=sound, in_time="true") for _ in range(4)]
        base = server.memory_bytes()
        began: dict[str, float] = {}
        made = [upload(client, scale(200), song=sound, in_time="true") for _ in range(30)]
        for session in made:
            session.control("play")
            began[session.id] = time.time()
        assert server.memory_bytes() - base < 100 * MEGABYTE
        for session in (made[0], made[15], made[-1]):
            before_s = time.time() - began[session.id]
            state = client.get(f"{session.path}/transport").json()
            after_s = time.time() - began[session.id]
            assert state["playing"]
            assert before_s - 0.5 <= state["song_time_s"] <= after_s + 0.5
        for session in warm:
            session.change("DELETE")


def test_a_restart_goes_on_where_the_clock_is(tmp_path: Path) -> None:
    with serve(tmp_path, "--no-page") as server, httpx.Client(base_url=server.address) as client:
        session = upload(client, scale(400), song=("s.wav", song()))
        session.control("rate", rate=2.0)
        session.control("loop", start_s=0.0, end_s=100.0)
        told = session.control("play")
        began = time.time()
        assert server.stop() == 0
    with serve(tmp_path, "--no-page") as server, httpx.Client(base_url=server.address) as client:
        state = client.get(f"{session.path}/transport").json()
        assert (state["playing"], state["rate"], state["loop"]["end_s"]) == (True, 2.0, 100.0)
        assert abs(state["song_time_s"] - 2 * (time.time() - began)) < 2.0
        assert state["epoch"] > told["epoch"]


def test_who_watches_is_not_turned_out_for_who_comes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with server_with(tmp_path, monkeypatch, memory_mb=6) as (server, client):
        sound = ("s.wav", song())
        first = upload(client, large_score(11_000), "s.json", song=sound)

        async def watched() -> httpx.Response:
            async with watch(server, first.id):
                return await asyncio.to_thread(
                    client.post,
                    "/api/v1/sessions",
                    files={"score": ("s.json", large_score(11_000)), "song": sound},
                )

        refused = asyncio.run(watched())
        assert (refused.status_code, problem(refused)) == (503, "busy")
        assert int(refused.headers["Retry-After"]) > 0
        never = client.post("/api/v1/sessions", files={"score": ("s.json", large_score(22_000))})
        assert (never.status_code, problem(never)) == (413, "piece-too-large")
        assert "REINA_MEMORY_MB" in never.json()["detail"]
        upload(client, large_score(11_000), "s.json", song=sound)


def test_quotas_are_told_with_their_figures(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with server_with(tmp_path, monkeypatch, sessions_per_sender=2) as (_, client):
        made = [upload(client, scale(4), song=("s.wav", song())) for _ in range(2)]
        refused = posted(client, scale(4))
        assert (refused.status_code, problem(refused)) == (429, "sender-limit")
        assert "2 sessions came from your address, and 2 is the most" in refused.json()["detail"]
        resource = client.get(made[0].path).json()
        assert "127.0.0.1" not in json.dumps(resource)
        made[0].change("DELETE")
        upload(client, scale(4), song=("s.wav", song()))
    monkeypatch.setenv("REINA_SESSIONS_PER_SENDER", "0")
    with server_with(tmp_path, monkeypatch, disk_mb=3) as (_, client):
        refused = posted(client, scale(4), song=("s.wav", large_song(4)))
        assert (refused.status_code, problem(refused)) == (507, "no-room")
        assert "the server keeps 3.0 MB" in refused.json()["detail"]
        assert int(refused.headers["Retry-After"]) > 0
        assert list((tmp_path / "staging").iterdir()) == []


def test_what_is_being_sent_is_bounded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with server_with(tmp_path, monkeypatch, staging_mb=4) as (_, client):
        refused = posted(client, scale(4), song=("s.wav", large_song(6)))
        assert (refused.status_code, problem(refused)) == (429, "sender-limit")
        assert "2.0 MB are taken" in refused.json()["detail"]
        assert int(refused.headers["Retry-After"]) > 0
        upload(client, scale(4), song=("s.wav", song()))
        assert list((tmp_path / "staging").iterdir()) == []


def test_songs_that_are_made_stay_within_the_bound(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with server_with(tmp_path, monkeypatch, song_cache_mb=12) as (_, client):
        made = upload(client, scale(8))
        largest = 0
        for transposition in range(6):
            made.change("PATCH", json={"transposition": transposition}).raise_for_status()
            for _ in range(600):
                files = [path for path in tmp_path.glob("songs/*/*") if path.is_file()]
                largest = max(largest, sum(map(_size, files)))
                if client.get(f"{made.path}/song/state").json()["status"] == "ready":
                    break
                time.sleep(0.02)
        assert 0 < largest <= 12 * MEGABYTE
        long = upload(client, scale(400))
        answer = client.get(f"{long.path}/song")
        for _ in range(600):
            if answer.status_code != 202:
                break
            time.sleep(0.05)
            answer = client.get(f"{long.path}/song")
        assert (answer.status_code, problem(answer)) == (502, "no-song")
        assert "REINA_SONG_CACHE_MB" in answer.json()["detail"]


def test_who_reads_slowly_is_one_of_few(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with server_with(tmp_path, monkeypatch) as (server, client):
        session = upload(client, scale(8), song=("s.wav", song()))
        session.change("PUT", "/show", content=unknown_track(15 * MEGABYTE)).raise_for_status()
        whole = client.get(f"{session.path}/show").content
        base = server.memory_bytes()
        # Packed it would be some kilobytes.
        client.headers["Accept-Encoding"] = "identity"
        with httpx.Client(base_url=server.address, timeout=60, headers=client.headers) as slow:
            streams = [slow.stream("GET", f"{session.path}/show") for _ in range(12)]
            opened = [stream.__enter__() for stream in streams]
            refused = client.get(f"{session.path}/show")
            assert (refused.status_code, problem(refused)) == (503, "busy")
            assert int(refused.headers["Retry-After"]) > 0
            assert server.memory_bytes() - base < 300 * MEGABYTE
            assert client.get(f"{session.path}/transport").status_code == 200
            assert opened[0].read() == whole
            assert client.get(f"{session.path}/show").content == whole
            for stream in streams:
                stream.__exit__(None, None, None)


def test_who_is_seen_by_nobody_is_ended_with_a_notice(tmp_path: Path) -> None:
    day = 1 / 86_400
    with (
        serve(tmp_path, "--no-page", "--end-unseen", str(6 * day)) as server,
        httpx.Client(base_url=server.address, timeout=60) as client,
    ):
        unseen, seen = (upload(client, scale(4), song=("s.wav", song())) for _ in range(2))
        assert client.get(unseen.path).json()["ends_at"] is None
        told = None
        answer = client.get(unseen.path)
        for _ in range(2000):
            if answer.status_code == 404:
                break
            told = answer.json()["ends_at"] or told
            time.sleep(0.02)
            client.get(seen.path, headers=seen.headers)
            answer = client.get(unseen.path)
        assert answer.status_code == 404
        assert told is not None
        assert told.endswith("+00:00")
        assert client.get(seen.path).status_code == 200


def _size(path: Path) -> int:
    try:
        return path.stat().st_size
    except FileNotFoundError:  # a part of the mix that has just been let go of
        return 0


def test_bounds_that_are_no_numbers_are_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("REINA_DISK_MB", "much")
    with pytest.raises(AssertionError, match="did not start"), serve(tmp_path, "--no-page"):
        pass
