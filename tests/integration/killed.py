"""Servers that are killed while they write, and what they had acknowledged by then."""

from __future__ import annotations

import signal
import threading
import time
from typing import TYPE_CHECKING, Any

import httpx
from tests.integration.scores import scale, show, song
from tests.integration.server import PATIENCE_S, Owned, Running, serve, upload

if TYPE_CHECKING:
    import random
    from pathlib import Path

LIGHT = "lights/key/intensity"
LONGEST_S = 120.0
"""A write that is not answered by then will not be."""


def options(database: str) -> list[str]:
    return ["--no-page", *(["--database", database] if database else [])]


def client_of(server: Running) -> httpx.Client:
    return httpx.Client(base_url=server.address, timeout=PATIENCE_S)


def with_client(session: Owned, client: httpx.Client) -> Owned:
    return Owned(client, session.body)


def move_light(session: Owned, value: float) -> httpx.Response:
    track = {"keyframes": [{"time": 0, "value": value}]}
    return session.change("PUT", f"/show/tracks/{LIGHT}", json=track)


def light(session: Owned) -> float:
    answer = session.client.get(f"{session.path}/show/tracks/{LIGHT}")
    assert answer.status_code == 200, answer.text
    value: float = answer.json()["keyframes"][0]["value"]
    return value


class Writer(threading.Thread):
    """Makes sessions and edits them until the server is gone, and knows what was acknowledged."""

    def __init__(self, address: str) -> None:
        super().__init__()
        self._address = address
        self.acknowledged: dict[str, tuple[dict[str, Any], float, float]] = {}
        """Session -> what it was told as, the last value that was acknowledged, the last that was sent."""
        self.writes = 0
        """How many writes were acknowledged."""
        self._acknowledging = threading.Condition()

    def run(self) -> None:
        try:
            with httpx.Client(base_url=self._address, timeout=LONGEST_S) as client:
                while True:
                    session = upload(client, scale(4), song=("s.wav", song(0.1)), show=("s.json", show(0.0)))
                    self._acknowledge(session, 0.0)
                    for value in (0.5, 1.0, 1.5):
                        body, done, _ = self.acknowledged[session.id]
                        self.acknowledged[session.id] = body, done, value
                        assert move_light(session, value).status_code == 200
                        self._acknowledge(session, value)
        except httpx.HTTPError:
            pass

    def wait_for(self, writes: int) -> None:
        """Wait until so many writes are acknowledged."""
        with self._acknowledging:
            assert self._acknowledging.wait_for(lambda: self.writes >= writes, LONGEST_S)

    def _acknowledge(self, session: Owned, value: float) -> None:
        with self._acknowledging:
            self.acknowledged[session.id] = session.body, value, value
            self.writes += 1
            self._acknowledging.notify_all()


def kill_in_the_middle(
    data_dir: Path, arguments: list[str], chance: random.Random, earlier: Writer | None = None
) -> Writer:
    """Have a server killed while it writes; returns what it had acknowledged: a few writes at least.

    What an earlier one had acknowledged is looked for first, and ended.
    """
    with serve(data_dir, *arguments) as server:
        if earlier is not None:
            with client_of(server) as client:
                check_acknowledged(client, earlier)
                for body, *_ in earlier.acknowledged.values():
                    assert Owned(client, body).change("DELETE").status_code == 204
        writer = Writer(server.address)
        writer.start()
        writer.wait_for(chance.randrange(1, 6))
        # Anywhere within the next write.
        time.sleep(chance.uniform(0.0, 0.2))
        server.process.send_signal(signal.SIGKILL)
        writer.join(LONGEST_S)
        server.process.wait(PATIENCE_S)
    return writer


def check_acknowledged(client: httpx.Client, writer: Writer) -> None:
    """See that what was acknowledged is there."""
    for body, done, sent in writer.acknowledged.values():
        session = Owned(client, body)
        answer = client.get(session.path)
        assert answer.status_code == 200, answer.text
        assert light(session) in {done, sent}
        assert client.get(f"{session.path}/song").content == song(0.1)
        assert client.get(f"{session.path}/score/file").content == scale(4)
