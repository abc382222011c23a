"""A score in another key: as a recording of it sounds."""

from dataclasses import replace

import numpy as np

from reina.music.score import Score

LOWEST, HIGHEST = 0, 127
"""MIDI pitches."""


def transposed(score: Score, semitones: int) -> Score:
    """Return a score whose tones and keys are so many semitones higher; drums stay.

    What would be no MIDI pitch is an octave further in.
    """
    if not semitones:
        return score
    is_drums = np.array([part.is_drums for part in score.parts], dtype=np.bool_)
    notes = score.notes
    moved = notes.sounding_pitch.astype(np.int64) + np.where(is_drums[notes.part], 0, semitones)
    moved += 12 * (moved < LOWEST) - 12 * (moved > HIGHEST)
    return replace(
        score,
        notes=replace(notes, sounding_pitch=moved.astype(notes.sounding_pitch.dtype)),
        key_signatures=tuple(key.moved(semitones) for key in score.key_signatures),
    )
