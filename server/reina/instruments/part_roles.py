"""What a part is among those of the same family: a line of its own, or what another player shows already."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np

from reina.instruments.instrument import Instrument
from reina.instruments.part_names import desk_of_name, kinds_of_name
from reina.instruments.part_overlap import overlap_share, unison_share
from reina.music.gm import PROGRAM_NAMES
from reina.music.notes import Notes
from reina.music.score import Part, Score

FAMILY = ("trumpet", "cornet", "flugelhorn")
"""Instruments whose parts are found by themselves; of a name that speaks of two, the first."""

PROGRAMS = frozenset({56, 59})
"""General MIDI's trumpet and muted trumpet."""

MIN_IN_RANGE = 0.5
"""A part of which less is in its instrument's range is another instrument's, whatever it is called."""

MIN_NOTES = 0.05
"""A part that has fewer notes than this share of another's is an effect and no player's part."""

DOUBLED = 0.9
"""A part of which another has so much, at the same time and pitch, doubles it."""

APART = 0.05
"""Parts that sound together for less than this share of their time take turns."""


@dataclass(frozen=True)
class FamilyPart:
    """That a part is one for the family.

    Attributes:
        instrument: For which of `FAMILY`.
        reason: Why, in words.
    """

    instrument: str
    reason: str


def family_part(part: Part) -> FamilyPart | None:
    """Return for which instrument of the family a part is, by its name or else its program; None for none."""
    if part.is_drums:
        return None
    kinds = kinds_of_name(part.name) if part.named else frozenset[str]()
    named = next((instrument for instrument in FAMILY if instrument in kinds), None)
    if named is not None and ("other" not in kinds or part.program in PROGRAMS):
        return FamilyPart(named, f"named “{part.name}”")
    if part.program is not None and part.program in PROGRAMS and kinds <= {"brass", "melody"}:
        return FamilyPart("trumpet", f"its sound is {PROGRAM_NAMES[part.program]}, program {part.program}")
    return None


class Kind(Enum):
    """What a part is to those that are played already."""

    OWN = "a line of its own"
    OUT_OF_RANGE = "out of range"
    FEW = "few notes"
    DOUBLE = "the same as another"
    CONTINUATION = "where another rests"


@dataclass(frozen=True)
class Role:
    """What a part is to those that are played already.

    Attributes:
        kind: Which of these.
        reason: In words.
        other: The part that it doubles or continues.
    """

    kind: Kind
    reason: str
    other: int | None = None


class PartNotes:
    """The notes of a score, part by part.

    Args:
        score: The score.
    """

    def __init__(self, score: Score) -> None:
        self.score = score
        self._order = np.argsort(score.notes.part, kind="stable")
        counts = np.bincount(score.notes.part, minlength=len(score.parts))
        self._ends = np.concatenate([[0], np.cumsum(counts)])

    def __getitem__(self, part: int) -> Notes:
        """A part's notes, in their order."""
        return self.score.notes.take(self._order[self._ends[part] : self._ends[part + 1]])


def role_of(
    notes_of: PartNotes, part: int, played: Sequence[int], instruments: Mapping[str, Instrument]
) -> Role:
    """Say what a part of the family is to those that are played.

    Args:
        notes_of: The score's notes.
        part: Index of a part that `family_part` knows.
        played: Indices of the parts that are played already.
        instruments: By name, those of the family that there are.
    """
    described, notes = notes_of.score.parts[part], notes_of[part]
    found = family_part(described)
    if found and found.instrument in instruments:
        inside = _in_range(notes, instruments[found.instrument])
        if inside < MIN_IN_RANGE:
            return Role(Kind.OUT_OF_RANGE, f"only {inside:.0%} of its notes are a {found.instrument}'s")
    most = max(played, key=lambda index: len(notes_of[index]), default=part)
    if len(notes) < MIN_NOTES * len(notes_of[most]):
        count = f"{len(notes)} note{'' if len(notes) == 1 else 's'}"
        return Role(
            Kind.FEW, f"only {count}, beside {len(notes_of[most])} of “{notes_of.score.parts[most].name}”"
        )
    overlaps: dict[int, float] = {}
    for index in played:
        shared = unison_share(notes, notes_of[index])
        if shared >= DOUBLED:
            told = f"{shared:.0%} of its notes are “{notes_of.score.parts[index].name}”'s too"
            return Role(Kind.DOUBLE, told, index)
        overlaps[index] = overlap_share(notes, notes_of[index])
    same_desk = [index for index in played if _same_desk(described, notes_of.score.parts[index])]
    if same_desk and all(overlaps[index] < APART for index in same_desk):
        name = notes_of.score.parts[same_desk[0]].name
        told = f"it plays only where “{name}” rests, as one player's music in two parts does"
        return Role(Kind.CONTINUATION, told, same_desk[0])
    together = max(overlaps.values(), default=None)
    beside = "" if together is None else f"; beside others it sounds for {together:.0%} of its time"
    return Role(Kind.OWN, f"a line of its own{beside}")


def _in_range(notes: Notes, instrument: Instrument) -> float:
    """Which share of some notes an instrument has."""
    pitches, counts = np.unique(notes.sounding_pitch, return_counts=True)
    has = np.array([instrument.can_play(pitch) for pitch in pitches.tolist()], dtype=np.bool_)
    return float(counts[has].sum() / len(notes))


def _same_desk(part: Part, other: Part) -> bool:
    """Whether two parts may be one player's: one instrument, and no number that says otherwise."""
    of_part, of_other = family_part(part), family_part(other)
    one = of_part is not None and of_other is not None and of_part.instrument == of_other.instrument
    return one and desk_of_name(part.name) == desk_of_name(other.name)
