"""Microseconds a frame to evaluate and to encode a player, by block length, and a block of several players.

Run as ``python tests/benchmarks/bench_frame.py``. A 3,000-note part with every gesture on and a show with a
dozen tracks. What counts is the block of 60, which is what the server evaluates; the best of many
repetitions is the machine's, the median is what it gives beside its other work.
"""

from __future__ import annotations

import argparse
import asyncio
import io
import os
import platform
import time
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING

import mido
import numpy as np

from reina.instruments import INSTRUMENTS, Performer, cast_parameters
from reina.instruments.player import SEATS, SEATS_FOR, Engagement, plan_glances
from reina.music import read_score
from reina.performance import Performance
from reina.protocol import Manifest, build_manifest, encode_block
from reina.show import Show, TimeMap
from reina.skeleton import load_hold, load_rig
from reina.stage import stage_registry

if TYPE_CHECKING:
    from collections.abc import Callable

    from reina.rotations.arrays import FloatArray

RIGS = Path(__file__).parents[2] / "rigs"
BLOCK_LENGTHS = (1, 6, 30, 60, 600)
AT_ONCE = (1, 2, 4)
HELD_S = 4.0
CASTS = (1, 2, 4, 8)
"""How many play; a session has four at most, eight are for this measurement."""


def part(notes: int) -> bytes:
    """A MIDI file of a trumpet part with fast and slow notes, repeats and rests."""
    rng = np.random.default_rng(1)
    track = mido.MidiTrack([mido.Message("program_change", program=56)])
    pitch, rest = 67, 480
    for _ in range(notes):
        pitch = int(np.clip(pitch + rng.integers(-7, 8), 54, 86))
        length = int(rng.choice([60, 120, 120, 240, 240, 480]))
        track.append(mido.Message("note_on", note=pitch, velocity=int(rng.integers(40, 120)), time=rest))
        track.append(mido.Message("note_off", note=pitch, time=length))
        rest = int(rng.choice([0, 0, 0, 0, 0, 0, 240, 960]))
    data = io.BytesIO()
    mido.MidiFile(ticks_per_beat=480, tracks=[track]).save(file=data)
    return data.getvalue()


def performance(notes: int, tracks: int = 12, players: int = 1) -> Performance:
    """So many players, each with such a part, under a show with so many tracks, twelve at most."""
    instrument = INSTRUMENTS["trumpet"]
    registry = stage_registry().extended(cast_parameters([instrument] * players))
    numbers = [p for p in registry if p.type == "number"][:tracks]
    documents = [
        {
            "parameter": parameter.path,
            "keyframes": [
                {"time": float(second), "value": parameter.default, "interpolation": "linear"}
                for second in range(0, 600, 2)
            ],
        }
        for parameter in numbers
    ]
    score = read_score(part(notes))
    show = Show.from_document({"version": 1, "tracks": documents}, registry)
    names = SEATS_FOR[1] if players == 1 else tuple(SEATS)[1:]
    seats = [SEATS[names[number % len(names)]] for number in range(players)]
    played = [instrument.play(score, 0) for _ in seats]
    rigs = [load_rig(RIGS / name) for name in ("trumpeter", "soloist")]
    holds = [load_hold(RIGS / name, "trumpet") for name in ("trumpeter", "soloist")]
    trumpet = load_rig(RIGS / "trumpet")
    performers = [
        Performer(
            instrument,
            Engagement(
                score=score,
                played=part_of,
                player_rig=rigs[number % 2],
                instrument_rigs={instrument.name: trumpet},
                hold=holds[number % 2],
                registry=registry,
                number=number,
                seat=seat,
                seed=number,
                glances=looks,
            ),
        )
        for number, (part_of, seat, looks) in enumerate(
            zip(played, seats, plan_glances(played, seats), strict=True)
        )
    ]
    plan = show.plan(registry, TimeMap.steady())
    return Performance(performers, plan, duration_s=score.duration_s)


def microseconds(run: Callable[[int], object], frames: int, repetitions: int) -> tuple[float, float]:
    """Best and median time a frame of ``run``, which is given a counter, microseconds."""
    run(0)
    times: list[float] = []
    for repetition in range(repetitions):
        start = time.perf_counter()
        run(repetition)
        times.append((time.perf_counter() - start) / frames * 1e6)
    return min(times), median(times)


async def longest_holds(evaluate: Callable[[int], object] | None, seconds: float) -> FloatArray:
    """How long an event loop is held at a time, ms, sorted, while a thread evaluates blocks beside it."""
    loop = asyncio.get_running_loop()
    holds: list[float] = []
    stop = False

    async def keep_evaluating() -> None:
        block = 0
        while not stop and evaluate is not None:
            await loop.run_in_executor(None, evaluate, block % 400)
            block += 1

    beside = asyncio.create_task(keep_evaluating())
    end = time.perf_counter() + seconds
    while (before := time.perf_counter()) < end:
        await asyncio.sleep(0)
        holds.append((time.perf_counter() - before) * 1e3)
        await asyncio.sleep(0.001)
    stop = True
    await beside
    return np.sort(holds)


def machine() -> str:
    """The processor, its cores and the versions that count."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    processor = names[0] if names else platform.processor() or platform.machine()
    return f"{os.cpu_count()} cores {processor}, Python {platform.python_version()}, NumPy {np.__version__}"


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--notes", type=int, default=3000)
    parser.add_argument("--repetitions", type=int, default=200)
    options = parser.parse_args()
    start = time.perf_counter()
    subject = performance(options.notes)
    ready_s = time.perf_counter() - start
    manifest = build_manifest(subject.layout)
    joints = sum(len(skeleton.joints) for skeleton in subject.layout.skeletons)
    print(machine())
    print(f"{options.notes} notes read, fingered and planned in {ready_s * 1e3:.0f} ms")
    print(
        f"{joints} joints, {len(subject.layout.parameters)} parameters, {manifest.frame_size} bytes a frame"
    )
    print("frames    best  median   (evaluate and encode, µs a frame)")
    for length in BLOCK_LENGTHS:
        repetitions = max(10, min(options.repetitions, 12_000 // length))

        def run(repetition: int, length: int = length) -> object:
            first = 60 * (repetition % 400)
            return encode_block(manifest, subject.sample(np.arange(first, first + length) / 60.0, first))

        best, middle = microseconds(run, length, repetitions)
        print(f"{length:6d} {best:7.1f} {middle:7.1f}")

    print("blocks at once   (evaluated, as they are ahead of their time, µs a frame)")
    for count in AT_ONCE:
        best, middle = microseconds(
            lambda repetition, count=count: subject.evaluate_blocks(4 * (repetition % 100), count),
            60 * count,
            options.repetitions,
        )
        print(f"{count:6d} {best:7.1f} {middle:7.1f}")

    print("parts of a block of 60")
    without = performance(options.notes, tracks=0)
    times = np.arange(60) / 60.0
    block = subject.sample(times)
    parts: dict[str, Callable[[int], object]] = {
        "player": lambda repetition: without.sample(times + repetition % 400),
        "player and show": lambda repetition: subject.sample(times + repetition % 400),
        "encoding": lambda _: encode_block(manifest, block),
    }
    for name, run_part in parts.items():
        best, middle = microseconds(run_part, 60, options.repetitions)
        print(f"{best:14.1f} {middle:7.1f}   {name}")

    print("players    best  median   of one   block, ms   (a block of 60)")
    alone, casts = 0.0, dict[int, Performance]()
    for players in CASTS:
        several = performance(options.notes, players=players)
        manifest = build_manifest(several.layout)

        def run_cast(
            repetition: int, several: Performance = several, manifest: Manifest = manifest
        ) -> object:
            first = 60 * (repetition % 400)
            return encode_block(manifest, several.sample(np.arange(first, first + 60) / 60.0, first))

        casts[players] = several
        best, middle = microseconds(run_cast, 60, options.repetitions)
        alone = alone or best
        print(f"{players:7d} {best:7.1f} {middle:7.1f} {best / alone:8.2f} {middle * 60 / 1000:15.2f}")

    print("an event loop beside a thread that evaluates without a pause: how long it is held at a time, ms")
    print("players   median     99 %   longest")
    for players in (0, *CASTS):
        evaluate = casts[players].evaluate if players else None
        holds = asyncio.run(longest_holds(evaluate, HELD_S))
        print(f"{players:7d} {median(holds):8.3f} {np.quantile(holds, 0.99):8.2f} {holds[-1]:9.2f}")


if __name__ == "__main__":
    main()
