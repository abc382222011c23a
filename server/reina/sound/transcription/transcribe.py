"""A recording of one line into the score of what is heard in it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.errors import InputError
from reina.sound.transcription.line import likeliest_line
from reina.sound.transcription.novelty import novelty
from reina.sound.transcription.onsets import refined
from reina.sound.transcription.posteriors import FRAME_RATE, LOWEST_PITCH, PITCHES, RATE, hear
from reina.sound.transcription.pulse import find_pulse
from reina.sound.transcription.resample import resampled
from reina.sound.transcription.score import HeardNotes, make_score
from reina.sound.transcription.second_voice import MOST_SHARE, second_voice_share

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from reina.instruments import Instrument
    from reina.music import Score
    from reina.sound.transcription.line import FoundLine

LONGEST_S = 900.0
SILENCE = 1e-5
"""Full scale is 1; a recording that never goes above this is silent."""
FEWEST_NOTES = 3
LATE_S = 0.008
"""The network hears a beginning so much after it."""
LEVEL_S = 0.1
"""How long after an onset a note's level is listened for."""
LOUD_VELOCITY, LOUD_PERCENTILE = 0.85, 90
"""Velocities go with the root of the amplitude, as General MIDI has it for synthesizers."""
FAINTEST = 0.003
"""What is 50 dB softer than loud notes is none."""
SHORTEST_S = 0.005
SOFTEST, LOUDEST = 0.15, 1.0
LISTENING = 0.9
"""The share of the time that the network takes."""


class MixError(InputError):
    """More than one line sounds."""


@dataclass(frozen=True)
class Line:
    """What is looked for.

    Attributes:
        part_name: What the part is called.
        program: General MIDI program, from 0.
        lowest: The lowest sounding MIDI pitch.
        highest: The highest.
    """

    part_name: str = "Solo"
    program: int = 56
    lowest: int = 36
    highest: int = 96

    def __post_init__(self) -> None:
        last = LOWEST_PITCH + PITCHES - 1
        if not LOWEST_PITCH <= self.lowest <= self.highest <= last:
            raise InputError(
                f"the lowest and the highest pitch must be in order and within {LOWEST_PITCH} to {last}, "
                f"not {self.lowest} and {self.highest}"
            )


def line_of(instrument: Instrument) -> Line:
    """The line that an instrument plays: what it can play bounds what is looked for."""
    pitches = [
        pitch for pitch in range(LOWEST_PITCH, LOWEST_PITCH + PITCHES) if instrument.can_play(pitch)
    ] or [LOWEST_PITCH]
    program = Line.program if instrument.program is None else instrument.program
    return Line(instrument.title, program, pitches[0], pitches[-1])


def transcribe(
    samples: NDArray[np.float32],
    rate: int,
    line: Line,
    *,
    title: str,
    tell: Callable[[float], None] = lambda _: None,
) -> Score:
    """Find the notes of a recording in which one line sounds.

    Args:
        samples: (S,) float32 with full scale 1.
        rate: Samples a second.
        line: What instrument it is, as far as that is known.
        title: What the score is called.
        tell: Called with the share that is done, 0..1.

    Returns:
        A score of one part whose seconds are the recording's.

    Raises:
        MixError: More than one line sounds.
        NoRuntimeError: What listens is not installed.
        InputError: The recording is too long, or no notes are heard in it.
    """
    length_s = len(samples) / rate
    if length_s > LONGEST_S:
        raise InputError(
            f"the recording lasts {length_s / 60:.0f} minutes; the notes of {LONGEST_S / 60:.0f} minutes at "
            "most are looked for: cut it into pieces"
        )
    if not len(samples) or float(np.max(np.abs(samples))) < SILENCE:
        raise InputError("the recording is silent; there are no notes in it")
    samples = resampled(samples, rate, RATE)
    heard = hear(samples, lambda share: tell(LISTENING * share)).where_audible(samples)
    found = likeliest_line(heard, novelty(samples), line.lowest, line.highest)
    if len(found.pitch) < FEWEST_NOTES:
        raise InputError(
            "no notes were heard in the recording; one instrument or voice that plays a melody is looked for"
        )
    share = second_voice_share(heard, found)
    if share > MOST_SHARE:
        raise MixError(
            f"this is a mix: more than one note sounds for {100 * share:.0f} % of the time. The notes of a "
            "single line can be found, those of a mix cannot: use a recording of the solo alone, or give the "
            "score beside the recording"
        )
    notes = _as_heard(samples, found)
    pulse = find_pulse(notes.onset_s, float(notes.end_s[-1]))
    tell(1.0)
    return make_score(notes, pulse, title=title, part_name=line.part_name, program=line.program)


def _as_heard(samples: NDArray[np.float32], found: FoundLine) -> HeardNotes:
    onset_s = refined(samples, np.maximum(found.begin / FRAME_RATE - LATE_S, 0.0), found.pitch)
    level = _levels(samples, onset_s)
    loud = max(float(np.percentile(level, LOUD_PERCENTILE)), 1e-9)
    # In silence the network hears what it likes.
    kept = np.flatnonzero(level > FAINTEST * loud)
    kept = kept[np.argsort(onset_s[kept], kind="stable")]
    onset_s = onset_s[kept]
    # Two that were moved to one place are one after the other all the same.
    steps = SHORTEST_S * np.arange(len(kept))
    onset_s = np.maximum.accumulate(onset_s - steps) + steps
    earliest = onset_s + SHORTEST_S
    ends_s = np.clip(found.end[kept] / FRAME_RATE, earliest, np.append(onset_s[1:], np.inf))
    velocity = np.clip(LOUD_VELOCITY * np.sqrt(level[kept] / loud), SOFTEST, LOUDEST)
    onset_s = np.asarray(onset_s, dtype=np.float64)
    return HeardNotes(onset_s, ends_s, found.pitch[kept], velocity)


def _levels(samples: NDArray[np.float32], onset_s: NDArray[np.float64]) -> NDArray[np.float64]:
    """(N,): how loud each note begins."""
    energy = np.concatenate(([0.0], np.cumsum(samples.astype(np.float64) ** 2)))
    first = np.clip((onset_s * RATE).astype(int), 0, len(samples) - 1)
    last = np.minimum(first + round(LEVEL_S * RATE), len(samples))
    return np.sqrt(np.maximum(energy[last] - energy[first], 0.0) / (last - first))
