"""What a right-handed drummer's hands prefer, in costs: the larger, the less is it done.

Where no number of a study is known the costs are set so that the grooves, fills and rudiments of the test
bed come out as drummers write them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from reina.instruments.drums.hit import PIECES

if TYPE_CHECKING:
    from reina.rotations.arrays import ArrayLike, FloatArray, IntArray

RIGHT, LEFT = 0, 1
"""Columns of the tables: the leading hand first."""

PLACES_M: Final = {
    "snare": (-0.04, 0.40, 0.64),
    "kick": (0.19, 0.76, 0.30),
    "tom_high": (-0.045, 0.72, 0.84),
    "tom_mid": (0.305, 0.72, 0.84),
    "tom_floor": (0.63, 0.27, 0.61),
    "hi_hat": (-0.33, 0.48, 0.87),
    "ride": (0.60, 0.45, 0.94),
    "crash_left": (-0.28, 0.61, 1.06),
    "crash_right": (0.39, 0.57, 1.09),
    "china": (0.68, 0.24, 1.06),
    "splash": (0.12, 0.73, 1.03),
    "cowbell": (0.13, 0.67, 0.97),
}
"""About where each piece is struck, to the player's right, ahead and up, metres: by this travel and crossing
are judged."""

IN_GROOVE: Final = {
    "snare": (1.2, 0.0),
    "tom_high": (0.3, 0.0),
    "tom_mid": (0.1, 0.1),
    "tom_floor": (0.0, 0.6),
    "hi_hat": (0.0, 1.0),
    "ride": (0.0, 1.6),
    "crash_left": (0.0, 0.35),
    "crash_right": (0.0, 0.7),
    "china": (0.0, 0.9),
    "splash": (0.0, 0.2),
    "cowbell": (0.0, 1.2),
    "kick": (0.0, 0.0),
}
"""What it costs to strike a piece with the right and with the left hand while the time is kept on a
cymbal."""

IN_RUN: Final = {
    **IN_GROOVE,
    "snare": (0.0, 0.0),
    "tom_high": (0.0, 0.0),
    "tom_mid": (0.0, 0.0),
    "tom_floor": (0.0, 0.1),
}
"""The same in fills, rolls and whatever else goes on without a cymbal that keeps the time."""

CROSS_STICK: Final = (2.5, 0.0)

TIMEKEEPERS: Final = ("hi_hat", "ride", "china", "cowbell")
"""What the time is kept on."""

LEFT_ON_FAST_HAT: Final = 0.45
"""The left hand on a hi-hat that is played fast and leaves out the backbeat: two hands share it."""

LEFT_ON_FULL_HAT: Final = 2.2
"""The left hand on a fast hi-hat that goes on through the backbeat: the left hand plays that."""

FREE_CROSSINGS: Final = frozenset(
    {("hi_hat", "snare"), ("crash_left", "snare"), ("splash", "snare"), ("cowbell", "snare")}
)
"""What the right and the left hand strike in comfort with the right above the left."""

HARD_CROSSINGS: Final = {("hi_hat", "tom_high"): 1.2}
"""Where the left arm would reach far ahead beneath the right one."""

BOUNCE_S: Final = (0.028, 0.1)
"""Gaps of the second stroke of a double, which rebounds and is not struck anew."""

BOUNCE_COST: Final = 1.0

FASTEST_SINGLES: Final = 20.5
"""Strokes a second that two hands make in turn; faster is a roll of doubles."""

LONG_ROLL: Final = (15.5, 16)
"""So many strokes a second, and so many of them: a roll that goes on is played in doubles before singles are
too fast."""

HIGHEST_RATE: Final = 14.0
"""Strokes a second that one hand can make."""

IMPOSSIBLE: Final = 60.0
"""The cost of what no hand can do."""

_REPEAT = np.array(
    [
        (0.060, 30.0),
        (0.071, 9.0),
        (0.083, 4.5),
        (0.100, 2.2),
        (0.111, 1.5),
        (0.125, 1.0),
        (0.150, 0.5),
        (0.1667, 0.3),
        (0.200, 0.15),
        (0.250, 0.10),
        (0.500, 0.05),
        (1.000, 0.02),
        (2.000, 0.0),
    ]
)
"""Gap in seconds, and what it costs one hand to strike twice in a row."""

_IN_TURN = np.array([(0.060, 30.0), (0.071, 9.0), (0.083, 4.0), (0.091, 1.5), (0.100, 0.35), (0.110, 0.0)])
"""The same with a stroke of the other hand in between, as in single strokes."""

SPEED_M_S: Final = 6.5
"""Of a hand on its way between two pieces."""

REACH_S: Final = 0.03
"""What it takes to leave for another piece beside the way itself."""


def repeat_cost(gap_s: ArrayLike) -> FloatArray:
    """What it costs one hand to strike again after `gap_s` with nothing in between."""
    return _cost(_REPEAT, gap_s)


def in_turn_cost(gap_s: ArrayLike) -> FloatArray:
    """What it costs one hand to strike again after `gap_s`, the other hand having struck in between."""
    return _cost(_IN_TURN, gap_s)


def _cost(table: FloatArray, gap_s: ArrayLike) -> FloatArray:
    gap = np.maximum(np.asarray(gap_s, dtype=np.float64), 1e-3)
    cost = np.exp(np.interp(np.log(gap), np.log(table[:, 0]), np.log(table[:, 1] + 0.01))) - 0.01
    return np.where(gap < table[0, 0], IMPOSSIBLE, np.maximum(cost, 0.0))


def _distances() -> FloatArray:
    places = np.array([PLACES_M[piece] for piece in PIECES])
    return np.linalg.norm(places[:, None] - places[None], axis=-1)


def _crossings() -> FloatArray:
    side = np.array([PLACES_M[piece][0] for piece in PIECES])
    over = np.maximum(side[None, :] - side[:, None] - 0.12, 0.0)
    # Arms lie across each other where it is far.
    cost = np.minimum(2.0 * over + 4.0 * np.maximum(over - 0.3, 0.0), 3.5)
    for (right, left), own in HARD_CROSSINGS.items():
        cost[PIECES.index(right), PIECES.index(left)] = own
    for right, left in FREE_CROSSINGS:
        cost[PIECES.index(right), PIECES.index(left)] = 0.0
    return cost


DISTANCE_M: Final = _distances()
"""(P, P) from piece to piece."""

CROSSING: Final = _crossings()
"""(P, P) what it costs that the right hand is on the first piece while the left is on the second."""


def travel_cost(from_piece: IntArray, to_piece: IntArray, gap_s: FloatArray) -> FloatArray:
    """What it costs a hand to go from piece to piece in a time; indices into `PIECES`."""
    far = DISTANCE_M[from_piece, to_piece]
    need = np.where(far > 0.0, far / SPEED_M_S + REACH_S, 0.0)
    return 0.1 * far + np.minimum(3.0 * np.maximum(need / np.maximum(gap_s, 1e-3) - 1.0, 0.0), IMPOSSIBLE)
