"""The steps above and below a note, as its key and the accidentals of its measure have them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reina.music.musicxml import tables

if TYPE_CHECKING:
    from reina.music.musicxml.element import Element

SHARPS = "FCGDAEB"
"""In which order a signature has them; flats come the other way round."""


class Neighbours:
    """What a part's ornaments need to know of the notes beside theirs."""

    def __init__(self) -> None:
        self._fifths: dict[str, int] = {}
        self._raised: dict[tuple[str, str, int], int] = {}

    def begin_measure(self) -> None:
        """Forget the accidentals of the measure before."""
        self._raised.clear()

    def set_key(self, staff: str, fifths: int) -> None:
        """Take a written key, of a staff or ("") of all."""
        self._fifths[staff] = fifths

    def add(self, staff: str, step: str, octave: int, alter: int) -> None:
        """Take a note as it is written, whose accidental holds in its measure."""
        self._raised[staff, step, octave] = alter

    def pitch(self, note: Element, steps: int, alter: int | None, transposition: int) -> int:
        """Return the pitch, as it sounds, of a step beside a note.

        Args:
            note: The element ``note``.
            steps: How many steps above it.
            alter: By how many semitones an accidental raises it; None: as measure and key have it.
            transposition: Semitones from what is written to what sounds.
        """
        pitch = note.first("pitch")
        name = pitch.said("step").upper() if pitch else ""
        if pitch is None or name not in tables.STEPS:
            return tables.SNARE
        staff = note.said("staff")
        octaves, index = divmod(tables.STEP_NAMES.index(name) + steps, len(tables.STEP_NAMES))
        step, octave = tables.STEP_NAMES[index], round(pitch.number("octave") or 0.0) + octaves
        if alter is None:
            key = key_alter(step, self._fifths.get(staff, self._fifths.get("", 0)))
            alter = self._raised.get((staff, step, octave), key)
        number = 12 * (octave + 1) + tables.STEPS[step] + alter + transposition
        return min(max(number, 0), 127)


def key_alter(step: str, fifths: int) -> int:
    """Return by how much a key raises a step: 1 for F of G major, -1 for B of F major."""
    place = SHARPS.index(step)
    return (fifths > place) - (fifths < place - 6)
