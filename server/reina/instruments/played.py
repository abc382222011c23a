"""What an instrument makes of a part: the line that is played, and how it is fingered."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reina.instruments.note_fingerings import NoteFingering
from reina.music.arrays import BoolArray, FloatArray, IntArray, NarrowIntArray
from reina.music.warnings import ScoreWarning
from reina.notation.drums import Struck


@dataclass(frozen=True, eq=False)
class Line:
    """The playable line of a part: M notes as read-only columns.

    Of an instrument that plays one note at a time no note ends after the next one's onset.

    Attributes:
        note_index: (M,) index into the score's notes.
        onset_s: (M,) seconds, ascending.
        end_s: (M,) seconds.
        sounding_pitch: (M,) MIDI number as played: transposed.
        velocity: (M,) in 0..1.
        phrase: (M,) number of the phrase, from 0; a new one begins after a rest long enough to breathe in.
        dropped: indices into the score's notes of the part's notes that are not played.
        shortened: indices into the score's notes of those that end earlier than written.
        tongued: (M,) int8 as `Notes.tongued`: 1, or 0 under a slur, -1 where the score says neither; None
            where it says nothing of any.
    """

    note_index: NarrowIntArray
    onset_s: FloatArray
    end_s: FloatArray
    sounding_pitch: NarrowIntArray
    velocity: FloatArray
    phrase: NarrowIntArray
    dropped: IntArray
    shortened: IntArray
    tongued: NDArray[np.int8] | None = None

    def __len__(self) -> int:
        return len(self.note_index)


@dataclass(frozen=True, eq=False)
class Fingering:
    """How each of the M notes of a line is fingered, or struck.

    Attributes:
        notes: Of each note what the wire says of it; None where it cannot be played.
        playable: (M,) bool, read-only.
        reasons: Of each note what was chosen and why, or why it cannot be played.
    """

    notes: Sequence[NoteFingering | None]
    playable: BoolArray
    reasons: Sequence[str]


@dataclass(frozen=True, eq=False)
class Strokes:
    """What of a line is struck.

    Attributes:
        hits: N strokes by their onset: one for several notes that are one stroke.
        notes: (N,) of each stroke its note's place in the line.
    """

    hits: Sequence[Struck]
    notes: Sequence[int]


@dataclass(frozen=True, eq=False)
class PlayedPart:
    """A part as an instrument plays it.

    Attributes:
        part: Index of the part.
        transposition: Semitones by which its pitches were moved, octave fit and written pitch included.
        line: The playable line.
        fingering: Of each note of the line; an instrument's own columns beside what all have.
        warnings: What was dropped, shortened, moved or cannot be played.
        joined_parts: Indices of the parts that are played together with it, ascending; their notes are in the
            line too.
    """

    part: int
    transposition: int
    line: Line
    fingering: Fingering
    warnings: tuple[ScoreWarning, ...]
    joined_parts: tuple[int, ...] = ()

    @property
    def parts(self) -> tuple[int, ...]:
        """Indices of all parts that are played, `part` first."""
        return (self.part, *self.joined_parts)

    @property
    def strokes(self) -> Strokes | None:
        """What is struck; None of an instrument that is not written as drums are."""
        return None
