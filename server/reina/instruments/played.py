"""What an instrument makes of a part: the line that is played, and how it is fingered."""

from dataclasses import dataclass

from reina.music.arrays import BoolArray, FloatArray, IntArray
from reina.music.warnings import ScoreWarning


@dataclass(frozen=True, eq=False)
class Line:
    """The playable line of a part: M notes, one at a time, as read-only columns.

    Attributes:
        note_index: (M,) index into the score's notes.
        onset_s: (M,) seconds, increasing.
        end_s: (M,) seconds; none is after the next onset.
        sounding_pitch: (M,) MIDI number as played: transposed.
        velocity: (M,) in 0..1.
        phrase: (M,) number of the phrase, from 0; a new one begins after a rest long enough to breathe in.
        dropped: indices into the score's notes of the part's notes that are not played.
        shortened: indices into the score's notes of those that end earlier than written.
    """

    note_index: IntArray
    onset_s: FloatArray
    end_s: FloatArray
    sounding_pitch: IntArray
    velocity: FloatArray
    phrase: IntArray
    dropped: IntArray
    shortened: IntArray

    def __len__(self) -> int:
        return len(self.note_index)


@dataclass(frozen=True, eq=False)
class Fingering:
    """How each of the M notes of a line is fingered, as read-only columns.

    Attributes:
        valves: (M, V) bool, whether each valve is down; the first column is valve 1, the one nearest the
            face.
        playable: (M,) bool; where not, no valve is down.
        reasons: Of each note what was chosen and why, or why it cannot be played.
        primary: (M,) bool, whether it is the usual fingering.
        cents: (M,) how far the note is off equal temperament before the player corrects it by the lips;
            positive is sharp; 0 where not playable.
        slide: (M,) extension of the third valve's slide, 0 in, 1 out as far as it goes.
    """

    valves: BoolArray
    playable: BoolArray
    reasons: tuple[str, ...]
    primary: BoolArray
    cents: FloatArray
    slide: FloatArray

    def pressed(self, note: int) -> list[int] | None:
        """Return the numbers of the valves that are down at a note of the line; None if not playable."""
        if not self.playable[note]:
            return None
        return [valve + 1 for valve, down in enumerate(self.valves[note].tolist()) if down]


@dataclass(frozen=True, eq=False)
class PlayedPart:
    """A part as an instrument plays it.

    Attributes:
        part: Index of the part.
        transposition: Semitones by which its pitches were moved, octave fit and written pitch included.
        line: The playable line.
        fingering: Of each note of the line.
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
