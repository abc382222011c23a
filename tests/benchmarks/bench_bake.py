"""What a library costs to bake: scores a second with one worker and with two, and what a killed one costs.

    python tests/benchmarks/bench_bake.py [--scores 1000] [--songs 24]

The scores, of some four seconds, are made here. All get a show and blocks; a few, the songs, get everything:
to render takes longer than all else together.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from machine import heading, verdict

SCORES, SONGS = 1000, 24
QUICK, ALL = "show,blocks", "show,blocks,bvh,sound"
MOST_RATIO = 0.75
"""Of the time of one worker that two may take, where there are two processors for them."""
SCALE = (0, 2, 4, 5, 7, 9, 11, 12)


@dataclass(frozen=True)
class Took:
    """What a bake took.

    Attributes:
        wall_s: Seconds on the clock.
        processor_s: Seconds of all its processes.
    """

    wall_s: float
    processor_s: float


def write_library(folder: Path, count: int) -> None:
    """Scores of four to eight notes, each another."""
    chance = random.Random(0)
    for number in range(count):
        notes = [
            {"beat": index, "duration": 0.9, "pitch": 60 + chance.choice(SCALE)}
            for index in range(chance.randint(4, 8))
        ]
        score = {
            "format": "reina-score",
            "version": 1,
            "title": f"Study {number}",
            "parts": [{"name": "Trumpet", "program": 56, "notes": notes}],
        }
        place = folder / f"{number // 100:02}"
        place.mkdir(parents=True, exist_ok=True)
        (place / f"{number:04}.json").write_text(json.dumps(score))


def bake(folder: Path, parts: str, workers: int, *, killed_after: int | None = None) -> Took:
    """Bake into a folder of its own; where asked, a worker is killed when so many are done."""
    before, begun = processor_s(), time.perf_counter()
    with tempfile.TemporaryDirectory() as output:
        command = [sys.executable, "-m", "reina", "bake", str(folder), "--out", output, "--only", parts]
        process = subprocess.Popen([*command, "--workers", str(workers)], stdout=subprocess.PIPE, text=True)
        assert process.stdout is not None
        for line in process.stdout:
            if killed_after is not None and int(line.split()[0]) >= killed_after:
                os.kill(a_worker(process.pid), signal.SIGKILL)
                killed_after = None
        if process.wait():
            raise SystemExit(f"the bake ended with status {process.returncode}")
        return Took(time.perf_counter() - begun, processor_s() - before)


def a_worker(pid: int) -> int:
    """One of the processes that work for a bake."""
    tasks = Path(f"/proc/{pid}/task").glob("*/children")
    children = [int(child) for task in tasks for child in task.read_text().split()]
    return next(one for one in children if "spawn_main" in Path(f"/proc/{one}/cmdline").read_text())


def processor_s() -> float:
    """Seconds of the processes that have ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def main() -> int:
    """Print the figures; the status is 1 when a bound is missed."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--scores", type=int, default=SCORES)
    parser.add_argument("--songs", type=int, default=SONGS)
    arguments = parser.parse_args()
    print(heading(__file__))
    missed = False
    with tempfile.TemporaryDirectory() as folder:
        library, songs = Path(folder) / "scores", Path(folder) / "songs"
        write_library(library, arguments.scores)
        write_library(songs, arguments.songs)
        took = {workers: bake(library, QUICK, workers) for workers in (1, 2)}
        for workers, one in took.items():
            print(
                f"{arguments.scores} scores, {QUICK}, {workers} worker{'s' if workers > 1 else ''}: "
                f"{one.wall_s:.1f} s, {arguments.scores / one.wall_s:.1f} scores a second, "
                f"{1e3 * one.processor_s / arguments.scores:.0f} ms of processor time each",
                flush=True,
            )
        ratio = took[2].wall_s / took[1].wall_s
        print(verdict("two workers beside one", ratio, MOST_RATIO, "of the time"))
        missed |= ratio > MOST_RATIO
        sounded = {workers: bake(songs, ALL, workers) for workers in (1, 2)}
        for workers, one in sounded.items():
            print(
                f"{arguments.songs} songs, {workers} worker{'s' if workers > 1 else ''}: {one.wall_s:.1f} s"
            )
        half = arguments.songs // 2
        killed = bake(songs, ALL, 2, killed_after=half)
        more_s = killed.wall_s - sounded[2].wall_s
        print(
            f"the same, a worker killed after {half}: {killed.wall_s:.1f} s, {more_s:+.1f} s; "
            f"processor time {killed.processor_s - sounded[2].processor_s:+.1f} s"
        )
    return 1 if missed else 0


if __name__ == "__main__":
    raise SystemExit(main())
