"""How many notes of recordings of one line are found, whether mixes are refused, and how long it takes.

Run as ``python tests/benchmarks/bench_transcription.py``. The recordings are the trumpets' parts of the
example scores, rendered alone, and lines by chance that are hard (tests/unit/sound/transcription/solos.py).
A note is found if one of its pitch begins within 50 ms; F1 counts what is missing and what is too much
alike. Processor time counts.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np
from machine import heading, verdict
from tests.unit.sound.alignment.renditions import RATE, Rendition, record
from tests.unit.sound.transcription.solos import SOLOS, Solo, hard, matched, solo

from reina.errors import InputError
from reina.sound.transcription.transcribe import Line, MixError, transcribe

if TYPE_CHECKING:
    from collections.abc import Iterable

LEAST_F1, MINUTE_S = 0.93, 5.0
KINDS: dict[str, dict[str, object]] = {
    "as it is": {},
    "a room of 0.8 s": {"reverberation_s": 0.8},
    "1.2 s and noise": {"reverberation_s": 1.2, "noise_db": -30.0},
    "1.7 times as fast": {"tempo": (0.6, 0.05)},
}
HARD = {"trumpet": 56, "muted trumpet": 59, "trombone": 57, "horn": 60, "alto saxophone": 65, "clarinet": 71}
SEEDS = (1, 2)
MIXES = {
    "march": Rendition("prince-of-denmarks-march"),
    "carnival": Rendition("carnival-of-venice"),
    "carnival in a room": Rendition("carnival-of-venice", reverberation_s=0.8, noise_db=-30.0),
    "trumpet and cello": Rendition("ode-to-joy"),
    "two trumpets": Rendition("trumpet-duet", without_parts=(2, 3)),
    "two trumpets, organ": Rendition("trumpet-duet"),
}


def main() -> int:
    """Measure and print; the status is 1 when a bound is missed."""
    print(heading(__file__))
    print(f"{'':24} recordings   F1 mean   least   onsets off, median   p95")
    means: list[float] = []
    lengths_s = spent_s = 0.0
    for kind, spoilt in KINDS.items():
        recordings = [solo(score, part, **spoilt) for score, part in SOLOS]
        begin = time.process_time()
        row, mean = _row(recordings)
        spent_s += time.process_time() - begin
        lengths_s += sum(len(each.samples) / RATE for each in recordings)
        means.append(mean)
        print(f"{kind:24} {row}")
    for name, program in HARD.items():
        print(f"{'hard, ' + name:24} {_row([hard(seed, program) for seed in SEEDS])[0]}")
    refused = [name for name, rendition in MIXES.items() if _is_refused(rendition)]
    print(f"mixes refused: {len(refused)} of {len(MIXES)}")
    minute_s = 60 * spent_s / lengths_s
    print(verdict("missed by the solos", 100 * (1 - means[0]), 100 * (1 - LEAST_F1), "%"))
    print(verdict("a minute of music", minute_s, MINUTE_S, "s"))
    return 0 if means[0] >= LEAST_F1 and minute_s <= MINUTE_S and len(refused) == len(MIXES) else 1


def _row(recordings: Iterable[Solo]) -> tuple[str, float]:
    scores: list[float] = []
    off: list[float] = []
    for recording in recordings:
        try:
            notes = transcribe(recording.samples, RATE, Line(), title="bench").notes
        except InputError as error:
            print(f"  {error}")
            scores.append(0.0)
            continue
        scores.append(2 * matched(recording, notes) / (len(recording.pitch) + len(notes)))
        for at_s, pitch in zip(recording.onset_s.tolist(), recording.pitch.tolist(), strict=True):
            own = notes.onset_s[notes.sounding_pitch == pitch]
            nearest = float(np.min(np.abs(own - at_s), initial=np.inf))
            if nearest <= 0.05:
                off.append(1000 * nearest)
    mean = float(np.mean(scores))
    median, p95 = (float(np.percentile(off, share)) if off else float("nan") for share in (50, 95))
    return f"{len(scores):10}   {mean:7.3f}   {min(scores):5.3f}   {median:15.1f} ms   {p95:.0f} ms", mean


def _is_refused(rendition: Rendition) -> bool:
    try:
        transcribe(record(rendition).samples, RATE, Line(), title="mix")
    except MixError:
        return True
    return False


if __name__ == "__main__":
    raise SystemExit(main())
