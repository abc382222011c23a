"""How far off the onsets of recordings are found, and how long it takes; beside other aligners, if installed.

Run as ``python tests/benchmarks/bench_alignment.py``. The recordings are the example scores, rendered at
other tempos, by other instruments, cut, spoilt (tests/unit/sound/alignment/bed.py). Processor time counts.
"""

from __future__ import annotations

import argparse
import time
from collections import defaultdict
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from machine import heading, peers_version, verdict, version
from other_aligners import OTHERS
from table import SHORT, Row, tell
from tests.unit.sound.alignment.bed import RATE, SCORES, bed, hard_bed, measure, other_music
from tests.unit.sound.alignment.renditions import Rendition, example, record

from reina.sound.alignment import align

if TYPE_CHECKING:
    from tests.unit.sound.alignment.bed import Result

MEDIAN_MS, P95_MS, FILE_MS, FILES_WITHIN, FOUR_MINUTES_S = 10.0, 40.0, 50.0, 0.95, 5.0
FOUR_MINUTES = 240.0
HARD = ("played", "sung")
COMPARED = ("smooth", "instruments")
"""What other aligners are given: they take no cuts, other keys or dropped parts."""
OF_SHORT = SCORES[::3]


def main() -> int:
    """Measure and print; the status is 1 when a bound is missed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1, help="another seed, other recordings")
    parser.add_argument("--worst", type=int, default=3, help="how many of the worst are told")
    options = parser.parse_args()
    print(heading(__file__))
    by_kind: dict[str, list[Result]] = defaultdict(list)
    told: list[tuple[float, str]] = []
    others: dict[str, list[Result]] = defaultdict(list)
    hard: dict[str, list[Result]] = defaultdict(list)
    spent_s: dict[str, list[float]] = defaultdict(list)
    refused = 0
    for kind, rendition in (*bed(options.seed), *hard_bed(options.seed)):
        if SHORT and not (kind in COMPARED and rendition.score in OF_SHORT):
            continue
        recording = record.__wrapped__(rendition)
        begin = time.process_time()
        alignment = align(recording.samples, RATE, recording.score)
        own_s = time.process_time() - begin
        result = measure(recording, alignment)
        refused += not alignment.is_same_music
        (hard if kind in HARD else by_kind)[kind].append(result)
        if kind in HARD:
            continue
        told.append((result.p95_ms, f"{result.median_ms:.1f} / {result.p95_ms:.0f} ms: {kind}, {rendition}"))
        if kind in COMPARED:
            others["Reina"].append(result)
            spent_s["Reina"].append(own_s)
            for name, other in OTHERS.items():
                theirs, took_s = other(recording, RATE)
                others[name].append(theirs)
                spent_s[name].append(took_s)
    tell_rows(others, spent_s)
    if SHORT:
        return 0
    print(f"{'':18} files  median   p95 of all notes   files with a median within {FILE_MS:.0f} ms")
    for kind, results in [*by_kind.items(), *others.items()]:
        print(f"{kind:18} {_row(results)}")
    everything = [result for results in by_kind.values() for result in results]
    print(f"{'all':18} {_row(everything)}")
    print("as people play; beside it the error without what each note is late or early by")
    for kind, results in hard.items():
        beats = np.concatenate([result.beat_errors_ms for result in results])
        print(f"{kind:18} {_row(results)}   beats: {np.median(beats):.1f}, {np.percentile(beats, 95):.1f} ms")
    for _, line in sorted(told, reverse=True)[: options.worst]:
        print(f"  {line}")
    unlike = [
        align(recording.samples, RATE, example(name)).is_same_music for recording, name in other_music()
    ]
    count = len(everything) + sum(map(len, hard.values()))
    print(f"taken for other music: {refused} of {count}; for the same: {sum(unlike)} of {len(unlike)}")
    seconds = _four_minutes_s()
    errors = np.concatenate([result.errors_ms for result in everything])
    median, p95 = float(np.median(errors)), float(np.percentile(errors, 95))
    outside = 1 - float(np.mean([result.median_ms <= FILE_MS for result in everything]))
    print(verdict("median", median, MEDIAN_MS, "ms"))
    print(verdict("p95", p95, P95_MS, "ms"))
    print(verdict("files beyond 50 ms", 100 * outside, 100 * (1 - FILES_WITHIN), "%"))
    print(verdict("four minutes of music", seconds, FOUR_MINUTES_S, "s"))
    met = median <= MEDIAN_MS and p95 <= P95_MS and outside <= 1 - FILES_WITHIN and seconds <= FOUR_MINUTES_S
    return 0 if met else 1


def tell_rows(results: dict[str, list[Result]], spent_s: dict[str, list[float]]) -> None:
    """Tell how far off others are, and how long they took, on the same recordings turn by turn."""
    own, own_s = results["Reina"], spent_s["Reina"]
    own_ms = np.concatenate([result.errors_ms for result in own])
    for name in ("synctoolbox", *(name for name in OTHERS if name != "synctoolbox")):
        theirs = results.get(name)
        their_ms = np.concatenate([result.errors_ms for result in theirs]) if theirs else None
        told = partial(
            Row,
            f"Alignment of {len(own)} recordings with their scores",
            peer=name,
            version=peers_version(name) or version(name) if theirs else "",
            notes="" if theirs else "not installed",
        )
        for what, share in (("an onset's error, median", 50), ("an onset's error, 95th percentile", 95)):
            figures = [
                float(np.percentile(errors, share)) if errors is not None else None
                for errors in (own_ms, their_ms)
            ]
            tell(told(what=what, unit="ms", reina=figures[0] or 0.0, theirs=figures[1]))
        tell(
            told(
                what="processor a recording",
                unit="s",
                reina=float(np.mean(own_s)),
                theirs=float(np.mean(spent_s[name])) if theirs else None,
            )
        )


def _row(results: list[Result]) -> str:
    errors = np.concatenate([result.errors_ms for result in results])
    within = np.mean([result.median_ms <= FILE_MS for result in results])
    return (
        f"{len(results):5}  {np.median(errors):6.1f}   {np.percentile(errors, 95):7.1f} ms"
        f"          {100 * within:5.0f} %"
    )


def _four_minutes_s() -> float:
    """Seconds of processor time for a song of four minutes: the march, three and a half times as slow."""
    slow = FOUR_MINUTES / example("prince-of-denmarks-march").duration_s
    recording = record.__wrapped__(Rendition("prince-of-denmarks-march", (slow, 0.05)))
    begin = time.process_time()
    align(recording.samples, RATE, recording.score)
    return time.process_time() - begin


if __name__ == "__main__":
    raise SystemExit(main())
