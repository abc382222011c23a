"""The score that a line makes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.music import (
    MetreMap,
    Notes,
    Part,
    Score,
    ScoreWarning,
    TempoMap,
    TimeSignature,
    from_second_zero,
)
from reina.music.controls import Control

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from reina.sound.transcription.pulse import Pulse

NO_BEAT = "no_beat"
"""The kind of the warning that the onsets tell no beat."""
SHORTEST_S = 0.02
"""A note that is let go of at once is written so long."""


@dataclass(frozen=True, eq=False)
class HeardNotes:
    """N notes as they are heard.

    Attributes:
        onset_s: (N,) ascending.
        end_s: (N,) after `onset_s`, and not after the next onset.
        pitch: (N,) int64, MIDI numbers.
        velocity: (N,) 0..1.
    """

    onset_s: NDArray[np.float64]
    end_s: NDArray[np.float64]
    pitch: NDArray[np.int64]
    velocity: NDArray[np.float64]


def make_score(notes: HeardNotes, pulse: Pulse, *, title: str, part_name: str, program: int) -> Score:
    """Write notes as a score of one part, in the recording's own seconds.

    Args:
        notes: One at least.
        pulse: The beats under them.
        title: What it is called.
        part_name: What its part is called.
        program: The General MIDI program that plays it.
    """
    tempo_map = TempoMap.through(np.arange(len(pulse.beats_s), dtype=np.float64), pulse.beats_s)
    end_s = np.maximum(notes.end_s, notes.onset_s + SHORTEST_S)
    onset_beats = np.maximum(tempo_map.beats(notes.onset_s), 0.0)
    zeros = np.zeros(len(notes.pitch))
    table = Notes.from_columns(
        part=zeros,
        channel=zeros,
        onset_s=notes.onset_s,
        duration_s=end_s - notes.onset_s,
        onset_beats=onset_beats,
        duration_beats=tempo_map.beats(end_s) - onset_beats,
        sounding_pitch=notes.pitch,
        velocity=notes.velocity,
        program=zeros + program,
    )
    metre = MetreMap([TimeSignature(0.0, pulse.bar_beats, 4)], pickup_beats=float(pulse.pickup_beats))
    warnings = () if pulse.is_clear else (_unclear(),)
    score = Score(
        title=title,
        parts=(Part(0, part_name, program, is_drums=False),),
        notes=table,
        tempo_map=tempo_map,
        metre_map=metre,
        controls=(Control("program", 0.0, 0.0, 0, 0, program),),
        warnings=warnings,
        duration_s=float(np.max(table.end_s)),
    )
    return from_second_zero(score)


def _unclear() -> ScoreWarning:
    return ScoreWarning(
        NO_BEAT, "whole score", "the recording tells no clear beat; 120 beats a minute are written"
    )
