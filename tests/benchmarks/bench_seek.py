"""How soon a seek's first frames are there, and how long evaluation holds up the event loop, milliseconds.

Run as ``chrt -f 10 python tests/benchmarks/bench_seek.py``. One trumpeter, a duet, and a duet with a drummer
on examples' scores. A seek is what a session waits for before it goes there: the blocks of the next 0.3 s,
evaluated on the thread, and packed too. Then blocks are evaluated and packed without a pause, while the loop
does nothing but come round: each time it is held by whoever has the interpreter's lock.
"""

from __future__ import annotations

import asyncio
import time
from statistics import median
from typing import TYPE_CHECKING

import numpy as np
from machine import ROOT, heading, verdict

from reina.cli.serve import share_interpreter
from reina.instruments import Cast, Casting
from reina.music import read_score
from reina.sessions.frames import EncodedFrames
from reina.sessions.packed_blocks import PackedBlocks
from reina.sessions.production import Production
from reina.sessions.session import FIRST_S
from reina.sessions.stage import Stage

if TYPE_CHECKING:
    from collections.abc import Sequence

SEEKS, HELD_S = 60, 6.0
SEEK_BOUND_MS, HOLD_BOUND_MS = 8.0, 2.0
TRUMPETS = (Casting(0, player="trumpeter"), Casting(1, player="soloist"))
DRUMMER = Casting(3, "drums", "trumpeter")
CASTS: dict[str, tuple[str, Sequence[Casting]]] = {
    "a trumpeter": ("carnival-of-venice.mid", TRUMPETS[:1]),
    "a duet": ("trumpet-duet.mid", TRUMPETS),
    "a duet and a drummer": ("when-the-saints.mid", (*TRUMPETS, DRUMMER)),
}


def blocks_of(production: Production) -> PackedBlocks:
    """A performance's blocks, none of them evaluated."""
    frames = EncodedFrames(production.performance, production.manifest)
    return PackedBlocks(frames, production.performance.layout, 1)


async def seek_ms(production: Production, *, packed: bool) -> list[float]:
    """How long seeks to places all over the piece take."""
    spent: list[float] = []
    for number in range(SEEKS):
        at_s = (7.31 * number) % production.score.duration_s
        blocks = blocks_of(production)
        begun = time.perf_counter()
        await blocks.ready(at_s, at_s + FIRST_S, ["packed"] if packed else [])
        spent.append((time.perf_counter() - begun) * 1e3)
    return spent


async def holds_ms(production: Production) -> list[float]:
    """How long the event loop is held at a time while blocks are evaluated and packed without a pause."""
    stop = False

    async def play() -> None:
        blocks, number = blocks_of(production), 0
        while not stop:
            await blocks.made([number], "packed")
            number += 1
            if number > production.score.duration_s:
                blocks, number = blocks_of(production), 0

    beside = asyncio.create_task(play())
    holds: list[float] = []
    end = time.perf_counter() + HELD_S
    while (before := time.perf_counter()) < end:
        await asyncio.sleep(0)
        holds.append((time.perf_counter() - before) * 1e3)
        await asyncio.sleep(0.001)
    stop = True
    await beside
    return holds


def main() -> int:
    """Measure and print; the status is 1 when a bound is missed."""
    print(heading(__file__))
    share_interpreter()
    stage, met = Stage.load(ROOT / "rigs"), True
    for what, (name, castings) in CASTS.items():
        score = read_score((ROOT / "examples" / "scores" / name).read_bytes(), filename=name)
        production = Production.plan(stage, score, cast=Cast(tuple(castings)))
        print(what)
        for packed in (False, True):
            seeks = asyncio.run(seek_ms(production, packed=packed))
            middle = median(seeks)
            met &= middle <= SEEK_BOUND_MS
            told = verdict(f"  a seek{', packed' if packed else ''}", middle, SEEK_BOUND_MS, "ms")
            print(f"{told}, longest {max(seeks):.2f}")
        holds = asyncio.run(holds_ms(production))
        longest = float(np.quantile(holds, 0.999))
        met &= longest <= HOLD_BOUND_MS
        print(
            verdict("  the loop is held, 99.9 %", longest, HOLD_BOUND_MS, "ms"), f", longest {max(holds):.2f}"
        )
    return 0 if met else 1


if __name__ == "__main__":
    raise SystemExit(main())
