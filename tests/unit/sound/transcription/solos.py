"""Recordings of single lines whose true notes are known, and how many of them are found."""

from __future__ import annotations

import io
from collections import defaultdict
from dataclasses import dataclass, replace
from functools import cache
from typing import TYPE_CHECKING

import mido
import numpy as np
from tests.unit.sound.alignment.renditions import RATE, Rendition, example, record, render, reverberated

from reina.music import Notes, Score, read_score
from reina.sound.transcription.transcribe import Line, transcribe

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Pitches = NDArray[np.int64]

WITHIN_S = 0.05
SOLOS = (
    ("amazing-grace", 0),
    ("carnival-of-venice", 0),
    ("chromatic-scale", 0),
    ("ode-to-joy", 0),
    ("prince-of-denmarks-march", 0),
    ("taps", 0),
    ("trumpet-duet", 0),
    ("trumpet-duet", 1),
)
"""The trumpets' parts of the examples."""
TICKS = 480
VIBRATO_HZ, VIBRATO_CENTS = 5.5, 40


@dataclass(frozen=True, eq=False)
class Solo:
    """A recording of one line.

    Attributes:
        samples: (F,) float32 at RATE.
        onset_s: (N,) where its notes begin.
        pitch: (N,) MIDI numbers.
    """

    samples: NDArray[np.float32]
    onset_s: Floats
    pitch: Pitches


def solo(score: str, part: int, **spoilt: object) -> Solo:
    """One part of an example alone, recorded as a `Rendition` says."""
    others = tuple(each.index for each in example(score).parts if each.index != part)
    recording = record(replace(Rendition(score, without_parts=others), **spoilt))
    notes = recording.score.notes
    own = (notes.part == part) & ~np.isnan(recording.onset_s)
    return Solo(recording.samples, recording.onset_s[own], notes.sounding_pitch[own].astype(np.int64))


@cache
def hard_score(seed: int, program: int) -> Score:
    """A line by chance: runs at eight notes a second, repeats at up to twelve, leaps, vibrato."""
    random = np.random.default_rng(seed)
    events: list[tuple[int, mido.Message | mido.MetaMessage]] = [
        (0, mido.MetaMessage("set_tempo", tempo=500_000)),
        (0, mido.Message("program_change", program=program)),
    ]
    at, pitch = TICKS, 70
    for _ in range(24):
        kind = random.choice(["run", "repeated", "long", "leap"], p=[0.35, 0.25, 0.2, 0.2])
        ticks, steps = {
            "run": (120, random.choice((-1, 1)) * random.integers(1, 3, 6)),
            "repeated": (int(random.choice([80, 120, 160])), np.zeros(5, dtype=int)),
            "long": (TICKS, random.integers(-5, 6, 1)),
            "leap": (240, random.integers(-9, 10, 2)),
        }[str(kind)]
        for step in steps.tolist():
            pitch += step if 58 <= pitch + step <= 84 else -step
            velocity = int(random.integers(60, 112))
            events.append((at, mido.Message("note_on", note=pitch, velocity=velocity)))
            events.append((at + round(0.95 * ticks), mido.Message("note_off", note=pitch)))
            at += ticks
    for tick in range(0, at, 10):
        turn = 2 * np.pi * VIBRATO_HZ * tick / TICKS / 2
        bend = round(VIBRATO_CENTS / 200 * 8191 * np.sin(turn))
        events.append((tick, mido.Message("pitchwheel", pitch=bend)))
    track, before = mido.MidiTrack(), 0
    for tick, message in sorted(events, key=lambda event: (event[0], event[1].type == "note_on")):
        track.append(message.copy(time=tick - before))
        before = tick
    file, data = mido.MidiFile(ticks_per_beat=TICKS), io.BytesIO()
    file.tracks.append(track)
    file.save(file=data)
    return read_score(data.getvalue(), filename="hard.mid")


def hard(seed: int, program: int = 56) -> Solo:
    """Such a line in a room that rings for a second, with noise 25 dB below it."""
    score = hard_score(seed, program)
    random = np.random.default_rng(seed)
    sound = reverberated(render(score), 1.0, random)
    level = float(np.sqrt(np.mean(sound**2))) * 10 ** (-25 / 20)
    sound = sound + (level * random.standard_normal(len(sound))).astype(np.float32)
    notes = score.notes
    return Solo(sound.astype(np.float32), notes.onset_s, notes.sounding_pitch.astype(np.int64))


def found(recording: Solo, line: Line | None = None) -> Notes:
    """The notes that are found in it."""
    return transcribe(recording.samples, RATE, line or Line(), title="solo").notes


def matched(recording: Solo, notes: Notes) -> int:
    """How many notes are found: of the same pitch and within 50 ms, each for one; as many as can be paired.

    Of one pitch, pairing in order of time leaves none out, as every note is within the same of its own place.
    """
    wanted, heard = (
        _by_pitch(recording.onset_s, recording.pitch),
        _by_pitch(notes.onset_s, notes.sounding_pitch),
    )
    return sum(_paired(onsets, heard[pitch]) for pitch, onsets in wanted.items())


def f1(recording: Solo, notes: Notes) -> float:
    """The harmonic mean of precision and recall."""
    return 2 * matched(recording, notes) / (len(recording.pitch) + len(notes))


def _by_pitch(onset_s: Floats, pitch: Iterable[int]) -> dict[int, list[float]]:
    by_pitch: dict[int, list[float]] = defaultdict(list)
    for at_s, key in zip(onset_s.tolist(), map(int, pitch), strict=True):
        by_pitch[key].append(at_s)
    return by_pitch


def _paired(wanted: list[float], heard: list[float]) -> int:
    wanted, heard = sorted(wanted), sorted(heard)
    pairs = first = second = 0
    while first < len(wanted) and second < len(heard):
        off = heard[second] - wanted[first]
        if abs(off) <= WITHIN_S:
            pairs, first, second = pairs + 1, first + 1, second + 1
        elif off < 0:
            second += 1
        else:
            first += 1
    return pairs
