"""What the aligner is measured on: every way a recording may differ, on every example."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from tests.unit.sound.alignment.renditions import RATE, Recording, Rendition, example, record

if TYPE_CHECKING:
    from collections.abc import Iterable

    from reina.sound.alignment import Alignment

SCORES = (
    "amazing-grace",
    "carnival-of-venice",
    "chromatic-scale",
    "ode-to-joy",
    "prince-of-denmarks-march",
    "taps",
    "trumpet-duet",
)
MELODIES, ACCOMPANIMENTS = (56, 60, 65, 68, 71, 73, 0), (0, 19, 24, 42, 61)
VOICE = 53
"""General MIDI programs: a voice; brass, reeds, flute, piano; piano, organ, guitar, cello, brass section."""


@dataclass(frozen=True)
class Result:
    """How far off an alignment is.

    Attributes:
        errors_ms: (N,) of every note that is heard, without its sign.
        beat_errors_ms: (N,) of its place of the score: without what the player is early or late by.
        median_ms: Their median.
        p95_ms: What 95 in a hundred are within.
    """

    errors_ms: np.ndarray[tuple[int], np.dtype[np.float64]]
    beat_errors_ms: np.ndarray[tuple[int], np.dtype[np.float64]]

    @property
    def median_ms(self) -> float:
        return float(np.median(self.errors_ms))

    @property
    def p95_ms(self) -> float:
        return float(np.percentile(self.errors_ms, 95))


def measure(recording: Recording, alignment: Alignment) -> Result:
    """Hold an alignment against the truth."""
    heard = ~np.isnan(recording.onset_s)
    found = alignment.song_times(recording.score.notes.onset_s[heard])
    return Result(
        1000 * np.abs(found - recording.onset_s[heard]), 1000 * np.abs(found - recording.beat_s[heard])
    )


def bed(seed: int = 1) -> Iterable[tuple[str, Rendition]]:
    """What each rendition is to show, and the rendition; all tempos, instruments and places by chance."""
    random = np.random.default_rng(seed)
    for score in SCORES:
        parts = len(example(score).parts)

        def tempo(depth: float) -> tuple[float, float]:
            return (round(float(random.uniform(0.75, 1.3)), 2), depth)

        def orchestra(parts: int = parts) -> tuple[int, ...]:
            return (
                int(random.choice(MELODIES)),
                *(int(program) for program in random.choice(ACCOMPANIMENTS, parts - 1)),
            )

        number = int(random.integers(1000))
        yield "smooth", Rendition(score, tempo(0.12), lead_in_s=3.1, tail_s=4, noise_db=-25, seed=number)
        yield "sudden", Rendition(score, tempo(0.25), sudden=True, reverberation_s=1.5, seed=number)
        yield (
            "instruments",
            Rendition(score, tempo(0.1), programs=orchestra(), lead_in_s=1, reverberation_s=1, seed=number),
        )
        if parts > 1:
            dropped = int(random.integers(parts))
            yield "parts dropped", Rendition(score, tempo(0.1), without_parts=(dropped,), seed=number)
        cut = (round(float(random.uniform(5, 9)), 1), 12.0)
        yield "cut", Rendition(score, (1.0, 0.08), cut=cut, lead_in_s=1, noise_db=-30, seed=number)
        yield "wrong notes", Rendition(score, tempo(0.1), wrong=0.2, noise_db=-25, seed=number)
        semitones = int(random.choice((-5, -3, -2, 2, 3, 4)))
        yield (
            "key and tuning",
            Rendition(
                score,
                tempo(0.1),
                transposition=semitones,
                cents=round(float(random.uniform(-45, 45))),
                seed=number,
            ),
        )
        yield "counted in", Rendition(score, tempo(0.05), count_in=4, lead_in_s=4, noise_db=-30, seed=number)


def hard_bed(seed: int = 1) -> Iterable[tuple[str, Rendition]]:
    """As people play: rubato, notes early, late, wrong and left out, vibrato, breath, a room; sung, too."""
    random = np.random.default_rng(1000 + seed)
    for score in SCORES:
        parts = len(example(score).parts)
        for kind, melody in (("played", int(random.choice(MELODIES))), ("sung", VOICE)):
            others = (int(program) for program in random.choice(ACCOMPANIMENTS, parts - 1))
            yield (
                kind,
                Rendition(
                    score,
                    (round(float(random.uniform(0.8, 1.25)), 2), 0.08),
                    lead_in_s=1.7,
                    tail_s=3,
                    noise_db=-32,
                    reverberation_s=1.2,
                    programs=(melody, *others),
                    rubato=0.08,
                    jitter_s=round(float(random.uniform(0.015, 0.025)), 3),
                    missing=0.05,
                    wrong=0.05,
                    vibrato_cents=35 if kind == "sung" else 20,
                    breath_db=-15 if kind == "sung" else -22,
                    seed=int(random.integers(1000)),
                ),
            )


def other_music() -> Iterable[tuple[Recording, str]]:
    """Recordings, each with the name of a score that it is not."""
    names = [name for name in SCORES if name != "trumpet-duet"]
    for index, played in enumerate(names):
        recording = record(Rendition(played, (1.1, 0.12), lead_in_s=3.1, tail_s=4, noise_db=-25))
        for written in (names[(index + 1) % len(names)], names[(index + 3) % len(names)]):
            yield recording, written


__all__ = ["RATE", "Result", "bed", "hard_bed", "measure", "other_music", "record"]
