"""When the first segment of a rendered song is there, when one that is sought, and how large everything is.

python tests/benchmarks/bench_sound.py
"""

from __future__ import annotations

import asyncio
import resource
import shutil
import tempfile
import time
from pathlib import Path

import numpy as np
from tests.unit.sound.material import Row, a_part, a_score

from reina.music import Score, read_score
from reina.sound.plan import PlayedParts
from reina.sound.renderer import SongRenderer, SongRequest, find_soundfont
from reina.system.resources import bundled, default_data_dir

EXAMPLES = bundled("examples") / "scores"
SCORES = ("taps.mid", "carnival-of-venice.mid", "prince-of-denmarks-march.mid")


def at_random(parts: int, notes: int, seconds: float) -> Score:
    """Parts of notes at random places."""
    generator = np.random.default_rng(0)
    kinds = [a_part(index, f"Part {index}", int(generator.integers(0, 100))) for index in range(parts)]
    rows: list[Row] = [
        (
            int(generator.integers(0, parts)),
            float(generator.uniform(0, seconds)),
            float(generator.uniform(0.1, 1.0)),
            int(generator.integers(40, 85)),
            float(generator.uniform(0.3, 1)),
        )
        for _ in range(notes)
    ]
    return a_score(sorted(rows, key=lambda row: row[1]), kinds)


def processor_time() -> float:
    """Seconds that renderers which have ended took."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


async def arrived(request: SongRequest, number: int) -> float:
    """Wait for a segment; returns the seconds that it took."""
    begun = time.perf_counter()
    while await request.segment(number, within_s=1) is None:
        pass
    return time.perf_counter() - begun


async def measure(name: str, score: Score, folder: Path) -> None:
    """Render a score and print its figures."""
    renderer = SongRenderer(folder, soundfont=find_soundfont(default_data_dir()))
    used = processor_time()
    begun = time.perf_counter()
    request = await renderer.request(score, [PlayedParts((0,))])
    await arrived(request, 0)
    print(f"{name}: first segment after {time.perf_counter() - begun:.2f} s", flush=True)
    late = request.segments.count * 3 // 4
    print(f"{name}: segment {late}, sought at once, after {await arrived(request, late):.2f} s", flush=True)
    song = await request.wait()
    segments = [path.stat().st_size for path in song.parent.glob("*.opus")]
    print(
        f"{name}: whole after {time.perf_counter() - begun:.1f} s; {len(segments)} segments "
        f"{sum(segments) / 1e6:.1f} MB, FLAC {song.stat().st_size / 1e6:.1f} MB, "
        f"WAV {request.segments.frames * 4 / 1e6:.1f} MB",
        flush=True,
    )
    await renderer.aclose()
    print(f"{name}: {processor_time() - used:.1f} s of processor time", flush=True)


if __name__ == "__main__":
    data = Path(tempfile.mkdtemp())
    try:
        for file in SCORES:
            asyncio.run(measure(file, read_score((EXAMPLES / file).read_bytes(), filename=file), data))
        asyncio.run(measure("12 parts, 20 minutes, 30,000 notes", at_random(12, 30_000, 1200.0), data))
    finally:
        shutil.rmtree(data)
