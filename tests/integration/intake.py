"""The largest files that are taken in, and how late a viewer's frames are while they come."""

from __future__ import annotations

import itertools
import json
import os
import subprocess
import sys
import threading
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
FPS = 60
SAMPLED_S = 0.02
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


def unknown_fields(count: int) -> bytes:
    """A JSON object of very many fields that nothing has."""
    return b"{" + b",".join(b'"x%d":1' % number for number in range(count)) + b"}"


def unknown_track(size: int, number: int = 0) -> bytes:
    """A show of one track that nobody knows, so many bytes long."""
    head = b'{"version":1,"tracks":[{"parameter":"x/%d","keyframes":[' % number
    return head + b"[1]," * ((size - len(head) - 10) // 4) + b"[1]]}]}"


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

    def gaps_s(self, begin: float, end: float) -> list[float]:
        """How long there was no frame, between each two within a stretch of time, seconds."""
        came = [came for came, _ in self.came if begin <= came <= end]
        return [after - before for before, after in itertools.pairwise(came)] or [end - begin]

    def lost(self, begin: float, end: float) -> int:
        """How many frames were to be sent within a stretch of time and never came."""
        due = sorted(due for _, due in self.came if begin <= due <= end)
        steps = (round((after - before) * FPS) for before, after in itertools.pairwise(due))
        return sum(max(0, step - 1) for step in steps)


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


@dataclass
class MemoryPeak:
    """Resident memory, bytes.

    Attributes:
        server_above: The most that the server's process held beyond what it held at first.
        workers: The most that its workers held together.
    """

    server_above: int = 0
    workers: int = 0


@contextmanager
def memory_peak(server: Running) -> Generator[MemoryPeak]:
    """Look at the server's memory again and again meanwhile."""
    peak, over = MemoryPeak(), threading.Event()
    base = server.memory_bytes()

    def watch() -> None:
        while not over.wait(SAMPLED_S):
            peak.server_above = max(peak.server_above, server.memory_bytes() - base)
            peak.workers = max(peak.workers, sum(map(_memory_bytes, _children(server.process.pid))))

    watching = threading.Thread(target=watch, daemon=True)
    watching.start()
    try:
        yield peak
    finally:
        over.set()
        watching.join()


def _children(pid: int) -> list[int]:
    """Every process that a process started."""
    found: list[int] = []
    for task in Path(f"/proc/{pid}/task").glob("*/children"):
        try:
            found += map(int, task.read_text().split())
        except OSError:  # a thread that has just ended
            continue
    return found


def _memory_bytes(pid: int) -> int:
    try:
        return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGESIZE")
    except OSError:  # a process that has just ended
        return 0


def now() -> float:
    """Server time, on the same machine."""
    return time.monotonic()
