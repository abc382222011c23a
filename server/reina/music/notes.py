"""The notes of a score, as columns."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reina.music.arrays import FloatArray, IntArray, read_only

NO_PROGRAM = -1
UNSAID = -1
"""Of a note of which nothing says whether it is tongued."""


@dataclass(frozen=True)
class Note:
    """One note; the fields are those of `Notes`."""

    part: int
    channel: int
    onset_s: float
    duration_s: float
    onset_beats: float
    duration_beats: float
    sounding_pitch: int
    velocity: float
    program: int | None

    @property
    def end_s(self) -> float:
        """The second at which the note is released."""
        return self.onset_s + self.duration_s


@dataclass(frozen=True, eq=False)
class Notes:
    """N notes as read-only columns; ``len(notes)``, ``notes[i] -> Note``.

    Attributes:
        part: (N,) int32, index into the score's parts.
        channel: (N,) int16, MIDI channel counted from 0, 16 to a port (9 of each is the drums' by default).
        onset_s: (N,) float64, seconds.
        duration_s: (N,) float64, seconds, greater than 0.
        onset_beats: (N,) float64, quarter notes.
        duration_beats: (N,) float64, quarter notes, greater than 0.
        sounding_pitch: (N,) int16, MIDI number as sounded.
        velocity: (N,) float64 in 0..1.
        program: (N,) int16, General MIDI program that sounds it, counted from 0; -1 if the file says none.
        tongued: (N,) int8, 1 where a note is begun anew, 0 where a slur leads to it, -1 if the file says
            neither.
    """

    part: NDArray[np.int32]
    channel: NDArray[np.int16]
    onset_s: FloatArray
    duration_s: FloatArray
    onset_beats: FloatArray
    duration_beats: FloatArray
    sounding_pitch: NDArray[np.int16]
    velocity: FloatArray
    program: NDArray[np.int16]
    tongued: NDArray[np.int8]

    @classmethod
    def from_columns(
        cls,
        *,
        part: ArrayLike,
        channel: ArrayLike,
        onset_s: ArrayLike,
        duration_s: ArrayLike,
        onset_beats: ArrayLike,
        duration_beats: ArrayLike,
        sounding_pitch: ArrayLike,
        velocity: ArrayLike,
        program: ArrayLike | None = None,
        tongued: ArrayLike | None = None,
    ) -> "Notes":
        """Make the table from columns of any dtype and order; sorted by onset, then part, then pitch.

        Without `program` no note names one; without `tongued` nothing says how notes begin.

        Raises:
            ValueError: If the columns differ in length or hold what is not a note.
        """
        notes = cls(
            part=np.asarray(part, dtype=np.int32),
            channel=np.asarray(channel, dtype=np.int16),
            onset_s=np.asarray(onset_s, dtype=np.float64),
            duration_s=np.asarray(duration_s, dtype=np.float64),
            onset_beats=np.asarray(onset_beats, dtype=np.float64),
            duration_beats=np.asarray(duration_beats, dtype=np.float64),
            sounding_pitch=np.asarray(sounding_pitch, dtype=np.int16),
            velocity=np.asarray(velocity, dtype=np.float64),
            program=np.full(np.shape(onset_s), NO_PROGRAM, dtype=np.int16)
            if program is None
            else np.asarray(program, dtype=np.int16),
            tongued=np.full(np.shape(onset_s), UNSAID, dtype=np.int8)
            if tongued is None
            else np.asarray(tongued, dtype=np.int8),
        )
        shapes = {column.shape for column in vars(notes).values()}
        if len(shapes) != 1 or any(len(shape) != 1 for shape in shapes):
            raise ValueError(f"columns of notes must be one-dimensional and of one length, not {shapes}")
        times = (notes.onset_s, notes.duration_s, notes.onset_beats, notes.duration_beats)
        if not all(np.all(np.isfinite(time)) for time in times):
            raise ValueError("onsets and durations of notes must be finite")
        if np.any(notes.duration_s <= 0) or np.any(notes.duration_beats <= 0):
            raise ValueError("durations of notes must be greater than 0")
        return notes.take(np.lexsort((notes.sounding_pitch, notes.part, notes.onset_s)))

    def take(self, chosen: IntArray) -> "Notes":
        """Return the notes at the given indices, in their order."""
        return Notes(**{name: read_only(column[chosen]) for name, column in vars(self).items()})

    def __len__(self) -> int:
        return len(self.onset_s)

    def __getitem__(self, index: int) -> Note:
        return Note(
            part=int(self.part[index]),
            channel=int(self.channel[index]),
            onset_s=float(self.onset_s[index]),
            duration_s=float(self.duration_s[index]),
            onset_beats=float(self.onset_beats[index]),
            duration_beats=float(self.duration_beats[index]),
            sounding_pitch=int(self.sounding_pitch[index]),
            velocity=float(self.velocity[index]),
            program=int(self.program[index]) if self.program[index] != NO_PROGRAM else None,
        )

    def __iter__(self) -> Iterator[Note]:
        return (self[index] for index in range(len(self)))

    @property
    def end_s(self) -> FloatArray:
        """(N,) float64: the second at which each note is released."""
        return self.onset_s + self.duration_s
