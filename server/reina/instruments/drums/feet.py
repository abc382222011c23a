"""Which foot: the right has the bass drum and the left the hi-hat, until the right alone is too slow."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

from reina.instruments.drums.sticking.habits import LEFT, RIGHT

if TYPE_CHECKING:
    from reina.rotations.arrays import FloatArray, IntArray

COMFORT: Final = 7.0
"""Strokes a second that one foot goes on with."""

DOUBLE: Final = 9.0
"""Strokes a second of two by one foot, one after the other."""

HIGHEST_RATE: Final = 13.0
"""Strokes a second that a foot can make at most; two feet make twice as many."""

BUSY_S: Final = 0.1
"""So near a stroke of the hi-hat's pedal the left foot has no time for the bass drum."""

GRID: Final = 0.25
"""The division in quarter notes by which the right foot leads."""

SIDES: Final = ("right", "left")

UNPLAYED: Final = -1


@dataclass(frozen=True, eq=False)
class Feet:
    """Which foot strikes each of N hits.

    Attributes:
        foot: (N,) 0 right, 1 left, -1 neither: it cannot be played.
        reasons: Of each hit.
    """

    foot: IntArray
    reasons: tuple[str, ...]


def choose_feet(onset_s: FloatArray, beat: FloatArray, velocity: FloatArray, pedal_s: FloatArray) -> Feet:
    """Choose the feet of the bass drum, right-handed.

    Args:
        onset_s: (N,) when it is struck, seconds, ascending.
        beat: (N,) quarter notes since the beginning of the bar.
        velocity: (N,) in 0..1.
        pedal_s: When the left foot closes the hi-hat, seconds, ascending.
    """
    count = len(onset_s)
    foot = np.zeros(count, dtype=np.int64)
    reasons = ["right foot on the bass drum"] * count
    gaps = np.diff(onset_s, prepend=-np.inf)
    begins = np.flatnonzero(gaps >= 1.0 / COMFORT)
    if not count:
        return Feet(foot, ())
    for begin, end in zip(begins.tolist(), [*begins[1:].tolist(), count], strict=True):
        if end - begin == 1:
            continue
        rate = (end - begin - 1) / float(onset_s[end - 1] - onset_s[begin] + 1e-9)
        if end - begin == 2 and rate <= DOUBLE:
            reasons[begin + 1] = "right foot: double, one motion of the foot"
            continue
        first = _leading(float(beat[begin]))
        for place, hit in enumerate(range(begin, end)):
            side = (first + place) % 2
            if side == LEFT and _is_busy(float(onset_s[hit]), pedal_s):
                side = RIGHT
            foot[hit] = side
            reasons[hit] = (
                f"{SIDES[side]} foot: the feet take turns, as {rate:.0f} a second is too fast for one"
            )
    _leave_out(onset_s, velocity, foot, reasons)
    return Feet(foot, tuple(reasons))


def _leading(beat: float) -> int:
    place = beat / GRID
    is_between = abs(place - round(place)) < 0.2 and round(place) % 2
    return LEFT if is_between else RIGHT


def _is_busy(at_s: float, pedal_s: FloatArray) -> bool:
    place = int(np.searchsorted(pedal_s, at_s))
    near = pedal_s[max(0, place - 1) : place + 1]
    return bool(len(near)) and bool(np.min(np.abs(near - at_s)) < BUSY_S)


def _leave_out(onset_s: FloatArray, velocity: FloatArray, foot: IntArray, reasons: list[str]) -> None:
    """Leave out what no foot can do: of two strokes the softer."""
    last = [-1, -1]
    for hit in range(len(onset_s)):
        side = int(foot[hit])
        before = last[side]
        if before >= 0 and onset_s[hit] - onset_s[before] < 1.0 / HIGHEST_RATE:
            softer = hit if velocity[hit] <= velocity[before] else before
            foot[softer] = UNPLAYED
            gap = float(onset_s[hit] - onset_s[before])
            reasons[softer] = f"no foot strikes the bass drum again after {gap * 1000:.0f} ms"
            if softer == hit:
                continue
        last[side] = hit
