"""Which hand strikes: the way through a whole part that costs the hands least, by dynamic programming.

A state is which hand struck last and how many strokes it has made in a row, so what the other hand struck
last, and when, is known too. A stroke costs what the hand prefers there (`setting`), what it takes to strike
again after so short a time, the way from piece to piece, and crossed arms.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

from reina.instruments.drums.hit import PIECES
from reina.instruments.drums.sticking.beat import FORCED
from reina.instruments.drums.sticking.figures import TRIPLES
from reina.instruments.drums.sticking.habits import (
    BOUNCE_COST,
    BOUNCE_S,
    CROSSING,
    IN_GROOVE,
    LEFT,
    RIGHT,
    TIMEKEEPERS,
    in_turn_cost,
    repeat_cost,
    travel_cost,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.drums.sticking.beat import Beat, Setting
    from reina.rotations.arrays import FloatArray, IntArray

LONGEST_RUN: Final = 4
"""Strokes of one hand in a row are counted up to this."""

TOGETHER_S: Final = 0.2
"""Hands that strike within this time are there together, and may cross; the more so the shorter it is."""

STATIC_LEFT_HAT: Final = 1.6
"""The left hand on the hi-hat where the right one strikes something else with it."""

IN_PASSING: Final = 0.6
"""Arms that cross one after the other disturb each other by this part of what they do at once, at most."""

FREE_S: Final = (0.22, 0.45)
"""From the first gap on a hand is free to leave the crossing to the other, at the second wholly so."""

REST_S: Final = 2.6
"""After so long a hand is not there any more."""

SKIP: Final = 1.6
"""A stroke that follows another of its hand after a rest so many times longer is the second of a pair."""

SKIP_COST: Final = 0.2
MIN_GAP_S: Final = 0.07

LOUDER: Final = 1.25
"""So many times louder than its first stroke the second of a double may be, unless it is part of a roll."""

_KEEPS: Final = np.array([piece in TIMEKEEPERS for piece in PIECES])
_DRUMS: Final = np.array(
    [piece not in ("ride", "crash_left", "crash_right", "china", "splash") for piece in PIECES]
)
_BOTH: Final = 2 * LONGEST_RUN


@dataclass(frozen=True, eq=False)
class Sticking:
    """Which hands strike at each of G beats.

    Attributes:
        hand: (G,) 0 right, 1 left, 2 both.
        pieces: (G, 2) what the right and what the left hand strike; -1 where a hand does not.
        in_a_row: (G,) how many strokes in a row the hand has made, up to `LONGEST_RUN`.
    """

    hand: IntArray
    pieces: IntArray
    in_a_row: IntArray


def stick(beats: Sequence[Beat], setting: Setting) -> Sticking:
    """Choose the hands of all beats.

    Args:
        beats: What hands strike, by time.
        setting: What is preferred at each.
    """
    count = len(beats)
    at = np.array([beat.onset_s for beat in beats])
    pieces = np.array([_sides(beat.pieces) for beat in beats], dtype=np.int64).reshape(-1, 2)
    is_both = np.array([beat.is_both for beat in beats], dtype=np.bool_)
    loud = np.array([beat.velocity for beat in beats])
    stay, switch, from_both, into_both, both_both = _costs(at, pieces, loud, setting)
    own = setting.cost
    states = 2 * LONGEST_RUN + 1
    cost = [np.inf] * states
    back: list[list[int]] = []
    doubles = is_both.tolist()
    stays, switches = stay.tolist(), switch.tolist()
    from_boths, into_boths, both_boths = from_both.tolist(), into_both.tolist(), both_both.tolist()
    owns: list[list[float]] = own.tolist()
    for beat in range(count):
        new, source = [np.inf] * states, [-1] * states
        if beat == 0:
            if doubles[0]:
                new[_BOTH] = 0.0
            else:
                new[0], new[LONGEST_RUN] = owns[0]
        elif doubles[beat]:
            best, where = cost[_BOTH] + both_boths[beat], _BOTH
            for hand in (RIGHT, LEFT):
                base, costs = hand * LONGEST_RUN, into_boths[beat][hand]
                for run in range(LONGEST_RUN):
                    candidate = cost[base + run] + costs[run]
                    if candidate < best:
                        best, where = candidate, base + run
            new[_BOTH], source[_BOTH] = best, where
        else:
            for hand in (RIGHT, LEFT):
                base, other = hand * LONGEST_RUN, (1 - hand) * LONGEST_RUN
                best, where = cost[_BOTH] + from_boths[beat][hand], _BOTH
                costs = switches[beat][hand]
                for run in range(LONGEST_RUN):
                    candidate = cost[other + run] + costs[run]
                    if candidate < best:
                        best, where = candidate, other + run
                mine = owns[beat][hand]
                new[base], source[base] = best + mine, where
                costs = stays[beat][hand]
                for run in range(LONGEST_RUN):
                    to = base + min(run + 1, LONGEST_RUN - 1)
                    candidate = cost[base + run] + costs[run] + mine
                    if candidate < new[to]:
                        new[to], source[to] = candidate, base + run
        cost = new
        back.append(source)
    hand, in_a_row = np.zeros(count, dtype=np.int64), np.ones(count, dtype=np.int64)
    state = min(range(states), key=cost.__getitem__) if count else 0
    for beat in reversed(range(count)):
        hand[beat] = 2 if state == _BOTH else state // LONGEST_RUN
        in_a_row[beat] = 1 if state == _BOTH else state % LONGEST_RUN + 1
        state = back[beat][state]
    struck = pieces.copy()
    struck[(hand == LEFT), RIGHT] = -1
    struck[(hand == RIGHT), LEFT] = -1
    return Sticking(hand, struck, in_a_row)


def _sides(pieces: tuple[int, ...]) -> tuple[int, int]:
    """What the right and what the left hand strike where two pieces are struck at once."""
    if len(pieces) == 1:
        return pieces[0], pieces[0]
    first, second = pieces
    return (first, second) if _pair_cost(first, second) <= _pair_cost(second, first) else (second, first)


def _pair_cost(right: int, left: int) -> float:
    of_left = STATIC_LEFT_HAT if PIECES[left] == "hi_hat" else IN_GROOVE[PIECES[left]][LEFT]
    return IN_GROOVE[PIECES[right]][RIGHT] + of_left + float(CROSSING[right, left])


def _costs(
    at: FloatArray, pieces: IntArray, loud: FloatArray, setting: Setting
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]:
    """What each way from beat to beat costs beside what is preferred.

    Returns:
        ``stay`` and ``switch``, (G, 2, R): the hand that strikes now struck last too, or the other one did,
        with R strokes in a row. ``from_both`` (G, 2): both struck last. ``into_both`` (G, 2, R): both strike
        now, and that hand struck last. ``both_both`` (G,).
    """
    count = len(at)
    index = np.arange(count)
    before = np.maximum(index - 1, 0)
    gap = np.where(index > 0, at - at[before], np.inf)
    stay = np.zeros((count, 2, LONGEST_RUN))
    switch, into_both = np.zeros_like(stay), np.zeros_like(stay)
    from_both = np.zeros((count, 2))
    repeated = repeat_cost(gap)
    again = [repeated + travel_cost(pieces[before, h], pieces[:, h], gap) for h in (RIGHT, LEFT)]
    same = pieces[before, RIGHT] == pieces[:, RIGHT]
    is_triple = np.array([rudiment is TRIPLES for rudiment in setting.rudiment], dtype=np.bool_)
    # A cymbal's skip beat is one motion of the fingers.
    skips = same & _KEEPS[pieces[:, RIGHT]] & (gap > MIN_GAP_S) & ((index < 2) | (gap[before] >= SKIP * gap))
    bounces = (
        same
        & _DRUMS[pieces[:, RIGHT]]
        & (gap >= BOUNCE_S[0])
        & (gap <= BOUNCE_S[1])
        & ((loud <= LOUDER * loud[before]) | (setting.turn < 0))
    )
    for run in range(LONGEST_RUN):
        other = index - 2 - run
        known = other >= 0
        other = np.maximum(other, 0)
        other_gap = np.where(known, at - at[other], np.inf)
        for h in (RIGHT, LEFT):
            # The other hand is where it struck last, if that is not long ago.
            there = np.where(known & (run < LONGEST_RUN - 1), other_gap, np.inf)
            crossed = _crossing(h, pieces[:, h], pieces[other, 1 - h], there)
            stay[:, h, run] = np.where(skips, SKIP_COST, 1.0) * again[h] + crossed
            came = np.where(known, in_turn_cost(other_gap), 0.0)
            if run < LONGEST_RUN - 1:
                came = came + np.where(known, travel_cost(pieces[other, h], pieces[:, h], other_gap), 0.0)
            switch[:, h, run] = came + _crossing(h, pieces[:, h], pieces[before, 1 - h], gap)
            in_turn = np.where(known, in_turn_cost(other_gap), 0.0)
            into_both[:, h, run] = again[h] + in_turn
        if run <= 1:
            rebounds = bounces & (is_triple | (run == 0))
            cheap = np.minimum(stay[:, :, run], BOUNCE_COST)
            stay[:, :, run] = np.where(rebounds[:, None], cheap, stay[:, :, run])
    stay += setting.again[:, None, None]
    stay += np.where(setting.turn > 0, FORCED, 0.0)[:, None, None]
    switch += np.where(setting.turn < 0, FORCED, 0.0)[:, None, None]
    for h in (RIGHT, LEFT):
        from_both[:, h] = again[h] + _crossing(h, pieces[:, h], pieces[before, 1 - h], gap)
    return stay, switch, from_both, into_both, again[RIGHT] + again[LEFT]


def _crossing(hand: int, piece: IntArray, other_piece: IntArray, gap_s: FloatArray) -> FloatArray:
    """What it costs that a hand is on one piece so soon after the other was on another."""
    crossing = CROSSING[piece, other_piece] if hand == RIGHT else CROSSING[other_piece, piece]
    hurried = IN_PASSING * np.maximum(1.0 - gap_s / TOGETHER_S, 0.0)
    # Where there is time for either hand nobody crosses: the other waits where it struck.
    free = np.clip((gap_s - FREE_S[0]) / (FREE_S[1] - FREE_S[0]), 0.0, 1.0) * (gap_s < REST_S)
    return (hurried + free) * crossing
