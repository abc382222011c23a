"""On a full disk what is there goes on, what is new is refused whole, and with room all is well again."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import httpx
import pytest
from tests.integration.own_disk import Disk, needs_own_disk, new_disk
from tests.integration.scores import duet, scale, song
from tests.integration.server import PATIENCE_S, Owned, serve, upload

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

pytestmark = needs_own_disk()

SIZE = 1_000_000_000
"""Bytes of the disk; it is sparse, so that it takes no such room."""
TRACK = "/show/tracks/lights/key/intensity"


@pytest.fixture
def disk(tmp_path: Path) -> Iterator[Disk]:
    with new_disk(tmp_path, SIZE) as disk:
        yield disk


@pytest.fixture
def client(disk: Disk, tmp_path: Path) -> Iterator[httpx.Client]:
    log = tmp_path / "log"
    with (
        serve(disk.folder / "data", "--no-page", log=log) as server,
        httpx.Client(base_url=server.address, timeout=PATIENCE_S) as client,
    ):
        yield client
    assert "Traceback" not in log.read_text()


def wait_until(holds: Callable[[], bool]) -> None:
    deadline = time.monotonic() + PATIENCE_S
    while not holds():
        assert time.monotonic() < deadline
        time.sleep(0.1)


def is_ready(client: httpx.Client) -> bool:
    return bool(client.get("/api/v1/health").json()["ready"])


def put_key(session: Owned, value: float) -> httpx.Response:
    """A key that brings a light to a value, as many bars in."""
    return session.change("POST", f"{TRACK}/keyframes", json={"time": value, "value": value})


def seen(session: Owned) -> dict[str, Any]:
    """What anybody sees of a session: what is said of it, its show, and its frames."""
    client, path = session.client, session.path
    about = client.get(path).json()
    return {
        "title": about["title"],
        "cast": client.get(f"{path}/cast").json(),
        "show": client.get(f"{path}/show").json(),
        "frames": client.get(f"{path}/frames?start_s=0&end_s=1").content,
    }


def refused(answer: httpx.Response) -> None:
    assert answer.status_code == 507, answer.text
    problem = answer.json()
    assert problem["type"] == "urn:reina:problem:storage-full"
    assert "make room" in problem["detail"]


def writes(session: Owned) -> dict[str, Callable[[], httpx.Response]]:
    """Everything that needs room, by what it does."""
    client, recording = session.client, song(20.0)
    show = client.get(f"{session.path}/show").json()
    form = {"score": ("score.mid", scale()), "song": ("song.wav", recording)}
    return {
        "a new session": lambda: client.post("/api/v1/sessions", files=form),
        "a new session without a song": lambda: client.post(
            "/api/v1/sessions", files={"score": ("score.mid", duet())}
        ),
        "a key": lambda: put_key(session, 2.5),
        "a show": lambda: session.change("PUT", "/show", json=show | {"title": "Another"}),
        "a title": lambda: session.change("PATCH", json={"title": "Another"}),
    }


def test_a_full_disk_stops_nothing_but_what_needs_room(client: httpx.Client, disk: Disk) -> None:
    session = upload(client, scale(), song=("song.wav", song()), title="First")
    assert put_key(session, 1.5).status_code < 300
    before = seen(session)
    assert is_ready(client)
    disk.fill()

    for write in writes(session).values():
        refused(write())
    assert seen(session) == before
    for below in ("", "/score", "/song", "/song/peaks", "/transport", "/part", "/manifest", "/parameters"):
        assert client.get(f"{session.path}{below}").status_code == 200, below
    assert session.control("play")["playing"] is True
    assert session.control("pause")["playing"] is False
    assert client.get("/api/v1/health").status_code == 200
    wait_until(lambda: not is_ready(client))

    disk.make_room()
    wait_until(lambda: is_ready(client))
    for what, write in writes(session).items():
        answer = write()
        assert answer.status_code < 300, (what, answer.text)
    assert client.get(session.path).json()["title"] == "Another"


def test_what_was_refused_leaves_nothing_on_the_disk(client: httpx.Client, disk: Disk) -> None:
    session = upload(client, scale(), song=("song.wav", song()))
    disk.fill()
    for write in writes(session).values():
        refused(write())
    disk.make_room()
    assert list((disk.folder / "data" / "staging").iterdir()) == []
    drafts = [file for file in (disk.folder / "data").rglob(".*") if file.is_file()]
    assert drafts == []


def test_a_song_is_made_once_there_is_room(client: httpx.Client, disk: Disk) -> None:
    session = upload(client, scale())
    wait_until(lambda: client.get(f"{session.path}/song").status_code == 200)
    disk.fill()
    # Another sound is another song.
    asked = f"{session.path}/song?semitones=3"
    wait_until(lambda: client.get(asked).status_code != 202)
    answer = client.get(asked)
    assert answer.status_code == 507, answer.text
    assert "as soon as there is" in answer.json()["detail"]
    assert client.get(f"{session.path}/song").status_code == 200
    disk.make_room()
    wait_until(lambda: client.get(asked).status_code == 200)


def test_a_server_ends_on_a_full_disk_and_starts_on_it_again(disk: Disk, tmp_path: Path) -> None:
    data, logs = disk.folder / "data", [tmp_path / "first", tmp_path / "second"]
    with (
        serve(data, "--no-page", log=logs[0]) as server,
        httpx.Client(base_url=server.address, timeout=PATIENCE_S) as client,
    ):
        session = upload(client, scale(), song=("song.wav", song()))
        before = seen(session)
        disk.fill()
        assert server.stop() == 0
    with (
        serve(data, "--no-page", log=logs[1]) as server,
        httpx.Client(base_url=server.address, timeout=PATIENCE_S) as client,
    ):
        again = Owned(client, session.body)
        assert seen(again) == before
        refused(put_key(again, 2.5))
        assert seen(again) == before
    assert [log.name for log in logs if "Traceback" in log.read_text()] == []


def test_a_session_ends_on_a_full_disk_too(client: httpx.Client, disk: Disk) -> None:
    kept, ended = (upload(client, scale(notes), song=("song.wav", song())) for notes in (8, 12))
    disk.fill()
    assert ended.change("DELETE").status_code == 204
    assert client.get(ended.path).status_code == 404
    assert client.get(kept.path).status_code == 200
