"""Rudiments that a score's own signs ask for: grace notes, and accents that fit one sticking alone.

Notes of equal strength say nothing, and are single strokes unless they are too fast for them. What does say
something:

- A soft note 15 to 60 ms before another on the same drum is the grace note of a flam; two are those of a
  drag (a ruff).
- On the snare alone, with no cymbal and no bass drum, eight even notes or more whose accents come round as
  `ACCENTED` has it.
- Strong and weak notes in twos or threes, as a right and a left hand sound: doubles and triples.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

if TYPE_CHECKING:
    from reina.instruments.drums.sticking.struck import Struck
    from reina.rotations.arrays import FloatArray, IntArray

GRACE_S: Final = (0.012, 0.062)
"""How long before its stroke a flam's grace note sounds."""

DRAG_S: Final = 0.085
"""How far a drag's notes are apart at most."""

APART: Final = 2.3
"""How many times farther a figure's first grace note is from the note before it than from the next."""

SOFTER: Final = 0.85
"""A grace note has at most this part of its stroke's velocity; one nearer than `ALWAYS_GRACE_S` may be as
loud."""

ALWAYS_GRACE_S: Final = 0.045

EVEN: Final = 0.25
"""Gaps that differ by less, as a part of what is usual, are even."""

LATE_S: Final = 0.024
"""And so are those that differ by less than this: hands are not exact."""

ACCENT: Final = 1.12
"""The softest accent is so many times louder than the loudest note that is none."""

FAST_TRIPLES_S: Final = 0.09
"""Accents of every third note at this gap or less are triple strokes; slower they are single strokes."""

FAST_DOUBLES_S: Final = 0.1
"""Accents of every other note at this gap or less are double strokes; slower, a right hand that is
stronger."""


@dataclass(frozen=True)
class Rudiment:
    """A sticking that goes round.

    Attributes:
        name: As drummers call it.
        hands: R and L, of one time round or of two.
        least: How many notes have to be there before it is taken for it.
    """

    name: str
    hands: str
    least: int = 8


SINGLE_PARADIDDLE: Final = Rudiment("single paradiddle", "RLRRLRLL")
DOUBLE_PARADIDDLE: Final = Rudiment("double paradiddle", "RLRLRRLRLRLL", 12)
TRIPLE_PARADIDDLE: Final = Rudiment("triple paradiddle", "RLRLRLRRLRLRLRLL", 16)
PARADIDDLE_DIDDLE: Final = Rudiment("paradiddle-diddle", "RLRRLL", 12)
SIX_STROKE_ROLL: Final = Rudiment("six-stroke roll", "RLLRRL", 6)
DOUBLES: Final = Rudiment("double-stroke roll", "RRLL")
TRIPLES: Final = Rudiment("triple-stroke roll", "RRRLLL", 6)
SINGLES: Final = Rudiment("single-stroke roll", "RL", 2)

ACCENTED: Final = {
    (4, (0,)): SINGLE_PARADIDDLE,
    (6, (0, 2)): DOUBLE_PARADIDDLE,
    (8, (0, 2, 4)): TRIPLE_PARADIDDLE,
    (6, (0,)): PARADIDDLE_DIDDLE,
    (6, (0, 5)): SIX_STROKE_ROLL,
    (4, (0, 1)): DOUBLES,
    (6, (0, 1, 2)): TRIPLES,
}
"""After how many notes the accents come round, which they are, and what is played so."""

NAMED: Final = {
    "paradiddle-diddle": PARADIDDLE_DIDDLE,
    "paradiddle diddle": PARADIDDLE_DIDDLE,
    "triple paradiddle": TRIPLE_PARADIDDLE,
    "double paradiddle": DOUBLE_PARADIDDLE,
    "paradiddle": SINGLE_PARADIDDLE,
    "six-stroke roll": SIX_STROKE_ROLL,
    "six stroke roll": SIX_STROKE_ROLL,
    "triple stroke": TRIPLES,
    "triple-stroke": TRIPLES,
    "double stroke": DOUBLES,
    "double-stroke": DOUBLES,
    "single stroke": SINGLES,
    "single-stroke": SINGLES,
}
"""What a name says, the longer ones first: that of a part, or a marker's."""


@dataclass(frozen=True, eq=False)
class Graces:
    """Which hits are grace notes, and of which.

    Attributes:
        main: (N,) the index of the stroke that a hit is a grace note of; -1 of others.
        drag: (N,) whether it is one of a drag's two.
    """

    main: IntArray
    drag: IntArray


def find_graces(struck: Struck) -> Graces:
    """Find the grace notes among N hits."""
    count = len(struck)
    main = np.full(count, -1, dtype=np.int64)
    drag = np.zeros(count, dtype=np.int64)
    at: list[float] = struck.onset_s.tolist()
    piece: list[int] = struck.piece.tolist()
    loud: list[float] = struck.velocity.tolist()
    begin = 0
    while begin < count - 1:
        gap = at[begin + 1] - at[begin]
        before = at[begin] - at[begin - 1] if begin else np.inf
        if gap > DRAG_S or gap < GRACE_S[0] or piece[begin] != piece[begin + 1] or before < APART * gap:
            begin += 1
            continue
        third = at[begin + 2] - at[begin + 1] if begin + 2 < count else np.inf
        after = at[begin + 3] - at[begin + 2] if begin + 3 < count else np.inf
        if GRACE_S[0] <= third <= DRAG_S and after >= APART * third:
            stroke = begin + 2
            if max(loud[begin], loud[begin + 1]) <= SOFTER * loud[stroke]:
                main[begin : begin + 2] = stroke
                drag[begin : begin + 2] = 1
                begin = stroke
                continue
        soft = loud[begin] <= SOFTER * loud[begin + 1] or gap <= ALWAYS_GRACE_S
        if gap <= GRACE_S[1] and third >= APART * gap and soft:
            main[begin] = begin + 1
        begin += 1
    return Graces(main, drag)


def stretch_rudiment(onset_s: FloatArray, velocity: FloatArray) -> Rudiment | None:
    """Return what a stretch of notes on one drum is by its accents; None where they do not say it.

    Args:
        onset_s: (N,) seconds.
        velocity: (N,) in 0..1.
    """
    if not is_even(onset_s):
        return None
    gap = float(np.median(np.diff(onset_s)))
    for (period, places), rudiment in ACCENTED.items():
        if len(onset_s) >= rudiment.least and _comes_round(velocity, period, places):
            return rudiment
    if len(onset_s) >= TRIPLES.least and gap <= FAST_TRIPLES_S and _comes_round(velocity, 3, (0,)):
        return TRIPLES
    if len(onset_s) >= DOUBLES.least and gap <= FAST_DOUBLES_S and _comes_round(velocity, 2, (0,)):
        return DOUBLES
    return None


def is_even(onset_s: FloatArray) -> bool:
    """Return whether notes follow each other at one gap."""
    gaps = np.diff(onset_s)
    if not len(gaps):
        return False
    median = float(np.median(gaps))
    return all(is_gap_even(gap, median) for gap in gaps.tolist())


def is_gap_even(gap_s: float, usual_s: float) -> bool:
    """Return whether a gap is one of an even row, played by hand."""
    return abs(gap_s - usual_s) <= max(EVEN * usual_s, LATE_S)


def named_rudiment(text: str) -> Rudiment | None:
    """Return the rudiment that a text names."""
    lowered = text.casefold().replace("_", " ")
    return next((rudiment for name, rudiment in NAMED.items() if name in lowered), None)


def _comes_round(velocity: FloatArray, period: int, places: tuple[int, ...]) -> bool:
    """Whether the accents are those places of each period and no others."""
    expected = np.isin(np.arange(len(velocity)) % period, places)
    if expected.all() or not expected.any():
        return False
    return bool(velocity[expected].min() >= ACCENT * velocity[~expected].max())
