"""What the server has said yes to is there after a power cut, whatever the moment."""

from __future__ import annotations

import os
import random
import signal
import time
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx
import pytest
from tests.integration.own_disk import Disk, mounted, needs_own_disk, new_disk
from tests.integration.scores import duet, scale, song
from tests.integration.server import PATIENCE_S, Owned, Running, serve, upload

from reina.sessions.storage.local_files import LocalFiles

if TYPE_CHECKING:
    from collections.abc import Generator, Iterator

pytestmark = needs_own_disk()

SIZE = 128_000_000
"""Bytes of the disk; each cut copies it."""
SEED = int(os.environ.get("POWER_CUT_SEED", "7"))
STEPS = int(os.environ.get("POWER_CUT_STEPS", "8"))
"""How many writes there are, each with a cut right after its answer; more for a longer search, as in
`POWER_CUT_STEPS=100 POWER_CUT_SEED=3 pytest tests/integration/test_power_cut.py`."""
TRACK = "/show/tracks/lights/key/intensity"


@dataclass
class Acknowledged:
    """What the server said yes to.

    Attributes:
        sessions: By id: the answer to the upload, and what was sent.
        ended: Ids of those that were ended.
    """

    sessions: dict[str, dict[str, Any]] = field(default_factory=dict[str, dict[str, Any]])
    ended: set[str] = field(default_factory=set[str])

    def copy(self) -> Acknowledged:
        """As it is now."""
        sessions = {name: about | {"values": dict(about["values"])} for name, about in self.sessions.items()}
        return Acknowledged(sessions, set(self.ended))


class Sender:
    """Somebody who uploads, edits, renames and ends sessions, and remembers what was answered."""

    def __init__(self, client: httpx.Client, seed: int) -> None:
        self.client = client
        self.random = random.Random(seed)
        self.said = Acknowledged()
        self.step = 0

    def do_something(self) -> str:
        """Do one thing and wait for its answer; what it was."""
        self.step += 1
        known = sorted(self.said.sessions)
        what = self.random.choice(["upload", "edit", "edit", "title", "cast"]) if known else "upload"
        if len(known) > 2 and self.random.random() < 0.15:
            what = "end"
        if what == "upload":
            self._upload()
        else:
            session = self.random.choice(known)
            getattr(self, f"_{what}")(session, Owned(self.client, self.said.sessions[session]["body"]))
        return what

    def _upload(self) -> None:
        score, recording = self.random.choice([scale(8), duet()]), song(0.2 + self.step / 10)
        title = f"Piece {self.step}"
        session = upload(self.client, score, song=("song.wav", recording), title=title)
        about = {
            "body": session.body,
            "score": score,
            "song": recording,
            "title": title,
            "values": {},
            "part": None,
        }
        self.said.sessions[session.id] = about

    def _edit(self, name: str, session: Owned) -> None:
        answer = session.change(
            "POST", f"{TRACK}/keyframes", json={"time": 0.01 * self.step, "value": self.step}
        )
        assert answer.status_code == 201, answer.text
        self.said.sessions[name]["values"][answer.json()["key"]] = self.step

    def _title(self, name: str, session: Owned) -> None:
        title = f"Piece {self.step}, renamed"
        assert session.change("PATCH", json={"title": title}).status_code == 200
        self.said.sessions[name]["title"] = title

    def _cast(self, name: str, session: Owned) -> None:
        transposition = self.step % 12
        answer = session.change("PATCH", json={"transposition": transposition})
        assert answer.status_code == 200, answer.text
        self.said.sessions[name]["transposition"] = answer.json()["transposition"]

    def _end(self, name: str, session: Owned) -> None:
        assert session.change("DELETE").status_code == 204
        del self.said.sessions[name]
        self.said.ended.add(name)


@contextmanager
def at_a_standstill(server: Running) -> Generator[None]:
    """The server and all its processes stand still, as the power is about to fail."""
    processes = [server.process.pid]
    for process in processes:
        for listed in Path(f"/proc/{process}/task").glob("*/children"):
            processes += [int(child) for child in listed.read_text().split()]
        os.kill(process, signal.SIGSTOP)
    try:
        yield
    finally:
        for process in reversed(processes):
            os.kill(process, signal.SIGCONT)


def lost(client: httpx.Client, said: Acknowledged) -> list[str]:
    """What of all that was acknowledged is not there, in words."""
    missing: list[str] = []

    def check(holds: bool, what: str) -> None:
        if not holds:
            missing.append(what)

    for name, about in said.sessions.items():
        session = Owned(client, about["body"])
        answer = client.get(session.path)
        if answer.status_code != 200:
            missing.append(f"{about['title']}: {answer.status_code} {answer.text[:200]}")
            continue
        title = about["title"]
        check(answer.json()["title"] == title, f"{title}: is called {answer.json()['title']}")
        if "transposition" in about:
            check(answer.json()["transposition"] == about["transposition"], f"{title}: its cast")
        sent = client.get(f"{session.path}/song?format=original")
        check(sent.status_code == 200 and sent.content == about["song"], f"{title}: its song")
        check(client.get(f"{session.path}/score").status_code == 200, f"{title}: its score")
        listed = client.get(f"{session.path}{TRACK}/keyframes").json()["keyframes"]
        keys = {key["key"]: key["value"] for key in listed}
        for key, value in about["values"].items():
            check(keys.get(key) == value, f"{title}: its key {key}")
        # It can be controlled with the token that was given.
        check(session.change("PATCH", json={"title": title}).status_code == 200, f"{title}: its token")
        assert name == session.id
    for name in said.ended:
        check(client.get(f"/api/v1/sessions/{name}").status_code == 404, f"{name} was ended and is back")
    return missing


@pytest.fixture
def disk(tmp_path: Path) -> Iterator[Disk]:
    with new_disk(tmp_path, SIZE) as disk:
        yield disk


def test_what_was_acknowledged_survives_a_power_cut_at_any_answer(disk: Disk, tmp_path: Path) -> None:
    cuts: list[tuple[str, Path, Acknowledged]] = []
    waiting = random.Random(SEED)
    with (
        serve(disk.folder / "data", "--no-page") as server,
        httpx.Client(base_url=server.address, timeout=PATIENCE_S) as client,
    ):
        sender = Sender(client, SEED)
        for step in range(STEPS):
            what = sender.do_something()
            # Right after the answer, or in the midst of what the server still does of itself.
            time.sleep(waiting.choice([0.0, 0.0, 0.02, 0.2]))
            image = tmp_path / f"cut-{step}"
            with at_a_standstill(server):
                disk.copy_as_it_is(image)
            cuts.append((f"step {step}, {what}", image, sender.said.copy()))
    missing: dict[str, list[str]] = {}
    for number, (when, image, said) in enumerate(cuts):
        log = tmp_path / f"log-{number}"
        with (
            mounted(image, tmp_path / f"after-{number}") as after,
            serve(after.folder / "data", "--no-page", log=log) as server,
            httpx.Client(base_url=server.address, timeout=PATIENCE_S) as client,
        ):
            if what_is_lost := lost(client, said):
                missing[when] = what_is_lost
            assert "Traceback" not in log.read_text(), when
        image.unlink()
    assert missing == {}


def test_a_file_that_is_kept_survives_whichever_way_it_came(disk: Disk, tmp_path: Path) -> None:
    store = LocalFiles(disk.folder / "data" / "files")
    kept: dict[str, bytes] = {}
    for number, staging in enumerate([disk.folder, tmp_path, disk.folder]):
        data = bytes([number]) * 100_000
        (staging / "staged").write_bytes(data)
        kept[store.keep(staging / "staged").digest] = data
    disk.copy_as_it_is(tmp_path / "cut")
    with mounted(tmp_path / "cut", tmp_path / "after") as after:
        again = LocalFiles(after.folder / "data" / "files")
        assert {digest: again.path(digest).read_bytes() for digest in kept} == kept
        assert {file.digest for file in again.files()} == set(kept)


def test_the_harness_sees_what_was_not_synced(disk: Disk, tmp_path: Path) -> None:
    synced, forgotten = disk.folder / "synced", disk.folder / "forgotten"
    for file in (synced, forgotten):
        file.write_bytes(b"x" * 10_000)
        if file is synced:
            for opened in (file, disk.folder):
                descriptor = os.open(opened, os.O_RDONLY)
                os.fsync(descriptor)
                os.close(descriptor)
    disk.copy_as_it_is(tmp_path / "cut")
    assert forgotten.read_bytes() == b"x" * 10_000
    with mounted(tmp_path / "cut", tmp_path / "after") as after:
        assert (after.folder / "synced").read_bytes() == b"x" * 10_000
        assert not (after.folder / "forgotten").exists()
