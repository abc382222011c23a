"""Which part an instrument plays: a ranking with its reasons."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from reina.instruments.part_names import desk_of_name, kinds_of_name
from reina.instruments.pitch_names import pitch_name
from reina.music.gm import PROGRAM_NAMES
from reina.music.notes import Notes
from reina.music.score import Part, Score

LEGATO_S = 0.08
"""Notes that overlap by less are played one after the other."""


@dataclass(frozen=True)
class PartRanking:
    """How well a part suits an instrument.

    Attributes:
        part: Index of the part.
        score: The sum of what speaks for it and against; comparable within one score alone.
        reasons: What it is made of, in words, the strongest first.
    """

    part: int
    score: float
    reasons: tuple[str, ...]


@dataclass(frozen=True)
class Suitability:
    """What speaks for a part, as an instrument sees it.

    Attributes:
        programs: Weight of each General MIDI program; what is not listed weighs nothing.
        names: Weight of each kind of name (`part_names.KINDS`), the weightiest that fits counts.
        lowest: Lowest sounding pitch.
        highest: Highest sounding pitch.
        drums: Weight of a part of drums.
    """

    programs: Mapping[int, float]
    names: Mapping[str, float]
    lowest: int
    highest: int
    drums: float = -20.0


IN_RANGE, ONE_AT_A_TIME, FEW_NOTES, LATER_DESK = 3.0, 2.0, -1.5, -0.2
HALF_OUT_OF_RANGE = -3.0


def rank_parts(score: Score, suitability: Suitability) -> tuple[PartRanking, ...]:
    """Rank the parts of a score, the best first; of equals the earlier."""
    counts = np.bincount(score.notes.part, minlength=len(score.parts))
    rankings = [
        _rank(part, score.notes.take(score.note_indices(part.index)), int(counts.max()), suitability)
        for part in score.parts
    ]
    return tuple(sorted(rankings, key=lambda ranking: (-ranking.score, ranking.part)))


def _rank(part: Part, notes: Notes, most_notes: int, suitability: Suitability) -> PartRanking:
    evidence: list[tuple[float, str]] = []
    is_struck = part.is_drums and suitability.drums > 0
    if part.is_drums:
        # What is struck has no range to be out of, and is struck together as it likes.
        evidence.append((suitability.drums + (IN_RANGE + ONE_AT_A_TIME if is_struck else 0.0), "drums"))
    evidence += _of_program(part, suitability)
    evidence += _of_name(part, suitability)
    if is_struck:
        return _ranked(part, notes, most_notes, evidence)
    inside = float(
        np.mean((notes.sounding_pitch >= suitability.lowest) & (notes.sounding_pitch <= suitability.highest))
    )
    span = f"{pitch_name(suitability.lowest)}–{pitch_name(suitability.highest)}"
    evidence.append(
        (
            IN_RANGE * inside + (HALF_OUT_OF_RANGE if inside < 0.5 else 0.0),
            f"{inside:.0%} of its notes within {span}",
        )
    )
    alone = monophony(notes)
    evidence.append((ONE_AT_A_TIME * alone, f"{alone:.0%} one note at a time"))
    return _ranked(part, notes, most_notes, evidence)


def _ranked(part: Part, notes: Notes, most_notes: int, evidence: list[tuple[float, str]]) -> PartRanking:
    if len(notes) < 0.05 * most_notes:
        evidence.append((FEW_NOTES, f"few notes ({len(notes)})"))
    evidence.sort(key=lambda item: -abs(item[0]))
    total = sum(weight for weight, _ in evidence)
    return PartRanking(
        part.index, round(total, 3), tuple(f"{what} ({weight:+.1f})" for weight, what in evidence)
    )


def _of_program(part: Part, suitability: Suitability) -> list[tuple[float, str]]:
    if part.is_drums or part.program is None:
        return []
    weight = suitability.programs.get(part.program, 0.0)
    return [(weight, f"its sound is {PROGRAM_NAMES[part.program]}, program {part.program}")] if weight else []


def _of_name(part: Part, suitability: Suitability) -> list[tuple[float, str]]:
    kinds = kinds_of_name(part.name) if part.named else frozenset[str]()
    weights = {kind: suitability.names[kind] for kind in kinds if kind in suitability.names}
    if not weights:
        return []
    kind = max(weights, key=lambda kind: weights[kind])
    evidence = [(weights[kind], f"named “{part.name}”")]
    desk = desk_of_name(part.name)
    if desk is not None and desk > 1 and weights[kind] > 0:
        evidence.append((LATER_DESK * (desk - 1), f"desk {desk}"))
    return evidence


def monophony(notes: Notes) -> float:
    """Return which share of the notes, in order of onset, sound alone (legato overlaps aside)."""
    if len(notes) < 2:
        return 1.0
    end = notes.end_s
    overlap = np.maximum.accumulate(end)[:-1] - notes.onset_s[1:]
    together = overlap > np.minimum(LEGATO_S, 0.5 * np.minimum(notes.duration_s[1:], notes.duration_s[:-1]))
    return 1.0 - float(np.mean(together))
