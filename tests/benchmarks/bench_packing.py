"""How large a block of frames is, and how long packing and unpacking take, beside zlib on the same bytes.

Run as ``python tests/benchmarks/bench_packing.py``. Every example with the cast that it asks for,
a dozen blocks of each; the times are the processor's, the least of several rounds. How far packed frames are
off is tests/unit/sessions/test_packed_examples.py's to say.
"""

from __future__ import annotations

import time
import zlib
from pathlib import Path
from statistics import mean
from typing import TYPE_CHECKING

from machine import heading

from reina.music import read_score
from reina.protocol import Frames, Manifest, Steps, encode_block, pack, unpack
from reina.sessions.production import Production
from reina.sessions.stage import Stage

if TYPE_CHECKING:
    from collections.abc import Callable

REPOSITORY = Path(__file__).parents[2]
BLOCKS = 12
ROUNDS = 5
LEVEL = 6


def main() -> None:
    """Measure and print."""
    print(heading(__file__))
    stage = Stage.load(REPOSITORY / "rigs")
    print(
        f"{'a block, bytes':30} players  as it is  zlib -{LEVEL}  lossless  packed   "
        f"ms: zlib -{LEVEL}  pack  unpack"
    )
    for path in sorted((REPOSITORY / "examples" / "scores").glob("*.*")):
        score = read_score(path.read_bytes(), filename=path.name)
        production = Production.plan(stage, score, cast=stage.found_cast(score))
        last = int(score.duration_s + 4)
        frames = [
            encode_block(production.manifest, production.performance.evaluate(last * place // (BLOCKS - 1)))
            for place in range(BLOCKS)
        ]
        print(f"{path.name:30} {len(production.performers):7}  {_row(production, frames)}", flush=True)


def _row(production: Production, frames: list[Frames]) -> str:
    manifest: Manifest = production.manifest
    steps, exact = Steps.of(production.performance.layout), Steps.exact(manifest)
    raw = [block.tobytes() for block in frames]
    packed = [pack(manifest, block, steps, revision=1) for block in frames]
    sizes = (
        mean(map(len, raw)),
        mean(len(zlib.compress(block, LEVEL)) for block in raw),
        mean(len(pack(manifest, block, exact, revision=1)) for block in frames),
        mean(map(len, packed)),
    )
    times = (
        _ms(lambda: [zlib.compress(block, LEVEL) for block in raw]),
        _ms(lambda: [pack(manifest, block, steps, revision=1) for block in frames]),
        _ms(lambda: [unpack(manifest, block) for block in packed]),
    )
    widths = (8, 7, 8, 6)
    told = "  ".join(f"{size:{width}.0f}" for size, width in zip(sizes, widths, strict=True))
    return f"{told}   {times[0] / BLOCKS:11.2f}  {times[1] / BLOCKS:4.2f}  {times[2] / BLOCKS:6.2f}"


def _ms(work: Callable[[], object]) -> float:
    least = float("inf")
    for _ in range(ROUNDS):
        begin = time.process_time()
        work()
        least = min(least, 1e3 * (time.process_time() - begin))
    return least


if __name__ == "__main__":
    main()
