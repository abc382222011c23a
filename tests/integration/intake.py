"""The largest files that are taken in, and how late a viewer's frames are while they come."""

from __future__ import annotations

import json
import subprocess
import sys
import time
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from tests.integration.scores import song

if TYPE_CHECKING:
    from collections.abc import Generator

    from tests.integration.server import Running

LATE_S = 0.05
PARAMETERS = (
    *(f"lights/{light}/intensity" for light in ("ambient", "key", "fill", "rim")),
    "blocks/glow",
    "camera/fov",
    "camera/roll",
)


def large_score(notes: int) -> bytes:
    """A JSON score of one trumpet part that plays fast, in Reina's own form."""
    played = [
        {
            "beat": round(number * 0.1, 1),
            "duration": 0.08,
            "pitch": 58 + abs((number + 24) % 48 - 24),
            "velocity": 0.75,
        }
        for number in range(notes)
    ]
    document = {"format": "reina-score", "tempos": [{"beat": 0, "bpm": 240}]}
    return json.dumps({**document, "parts": [{"name": "Trumpet", "program": 56, "notes": played}]}).encode()


def large_show(keyframes: int) -> bytes:
    """A show of some tracks with very many keyframes."""
    each = keyframes // len(PARAMETERS)
    tracks = [
        {
            "parameter": parameter,
            "keyframes": [
                {"key": f"k{key}", "time": round(key * 0.01, 2), "value": 1 + key % 2} for key in range(each)
            ],
        }
        for parameter in PARAMETERS
    ]
    return json.dumps({"version": 1, "tracks": tracks}).encode()


def large_batch(keyframes: int) -> bytes:
    """Edits that put a track of very many keyframes in its place."""
    track = json.loads(large_show(keyframes * len(PARAMETERS)))["tracks"][0]
    return json.dumps([{"edit": "put_track", "track": track}]).encode()


def large_song(megabytes: int) -> bytes:
    """A recording: silence, in a WAV file."""
    head = song(0.1)[:44]
    data = megabytes * 1_000_000
    return (
        head[:4] + (36 + data).to_bytes(4, "little") + head[8:40] + data.to_bytes(4, "little") + bytes(data)
    )


@dataclass
class FrameTimes:
    """When frames came to a viewer, and when they were to be sent, server time in seconds."""

    came: list[tuple[float, float]] = field(default_factory=list[tuple[float, float]])

    def late_s(self, begin: float, end: float) -> list[float]:
        """How late the frames were that came within a stretch of time, seconds."""
        return [came - due for came, due in self.came if begin <= came <= end]


@contextmanager
def frame_times(server: Running, session: str) -> Generator[FrameTimes]:
    """Watch a session from another process; the times are there afterwards."""
    script = Path(__file__).with_name("frame_times.py")
    command = [sys.executable, str(script), server.stream(session)]
    viewer = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    times = FrameTimes()
    try:
        assert viewer.stdout is not None
        assert viewer.stdout.readline() == "joined\n"
        yield times
        told, _ = viewer.communicate(timeout=20)
        times.came = [(came, due) for came, due in json.loads(told)]
    finally:
        if viewer.poll() is None:
            viewer.kill()
            viewer.communicate()


def now() -> float:
    """Server time, on the same machine."""
    return time.monotonic()
