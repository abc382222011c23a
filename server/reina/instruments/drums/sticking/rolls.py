"""Even notes on the snare alone: rudiments by their accents or by name, and rolls of doubles."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from reina.instruments.drums.sticking.beat import FORCED, LEAD_FIRST, RUN_GAP_S, SNARE
from reina.instruments.drums.sticking.figures import SINGLES, is_even, is_gap_even, stretch_rudiment
from reina.instruments.drums.sticking.habits import FASTEST_SINGLES, LEFT, LONG_ROLL

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.drums.sticking.beat import Beat, Setting
    from reina.instruments.drums.sticking.figures import Rudiment
    from reina.rotations.arrays import FloatArray

ROLLS_APART_S: Final = 1.5
"""Rolls nearer than this begin with one hand and the other in turn."""


def _stretches(beats: Sequence[Beat]) -> list[range]:
    """Notes on the snare alone, evenly one after the other, with no bass drum."""
    stretches: list[range] = []
    begin = 0
    while begin < len(beats):
        end = begin + 1
        if _is_plain_snare(beats[begin]):
            gap = 0.0
            while end < len(beats) and _is_plain_snare(beats[end]) and not beats[end].after_kick:
                next_gap = beats[end].onset_s - beats[end - 1].onset_s
                if next_gap > RUN_GAP_S or (gap and not is_gap_even(next_gap, gap)):
                    break
                gap = (beats[end].onset_s - beats[begin].onset_s) / (end - begin)
                end += 1
            if end - begin >= 2:
                stretches.append(range(begin, end))
        begin = end
    return stretches


def _is_roll(beats: Sequence[Beat], stretch: range) -> bool:
    """Whether notes are too fast for single strokes, or so fast and so many that doubles are easier."""
    span = beats[stretch[-1]].onset_s - beats[stretch[0]].onset_s
    rate = (len(stretch) - 1) / max(span, 1e-6)
    return len(stretch) >= 4 and (
        rate > FASTEST_SINGLES or (rate >= LONG_ROLL[0] and len(stretch) >= LONG_ROLL[1])
    )


def _roll(stretch: range, setting: Setting, *, leads: bool) -> None:
    """Double strokes from the first note on; one roll begins with the right hand, the next with the left."""
    setting.cost[stretch.start : stretch.stop] = 0.0
    if leads:
        setting.cost[stretch[0], LEFT] = LEAD_FIRST
    for place, index in enumerate(stretch):
        if place:
            setting.turn[index] = -1 if place % 2 else 1
        setting.place[index] = "roll"


def _is_plain_snare(beat: Beat) -> bool:
    return beat.pieces == (SNARE,) and not beat.is_cross_stick and not beat.graces


def _rudiments(
    beats: Sequence[Beat], stretch: range, named: Sequence[Rudiment | None], setting: Setting
) -> None:
    onset_s = np.array([beats[index].onset_s for index in stretch])
    velocity = np.array([beats[index].velocity for index in stretch])
    rudiment = named[stretch[0]] if is_even(onset_s) else None
    if rudiment is None and len(stretch) >= 6:
        rudiment = _by_accents(onset_s, velocity)
    if rudiment is None or len(stretch) < min(rudiment.least, len(rudiment.hands)):
        return
    for place, index in enumerate(stretch):
        hand = "RL".index(rudiment.hands[place % len(rudiment.hands)])
        setting.cost[index] = 0.0
        setting.cost[index, 1 - hand] = FORCED
        setting.rudiment[index] = rudiment
        setting.place[index] = "rudiment" if rudiment is not SINGLES else "run"


def _by_accents(onset_s: FloatArray, velocity: FloatArray) -> Rudiment | None:
    """What a stretch is; its last note may be the beginning of what follows, and close it with an accent."""
    whole = stretch_rudiment(onset_s, velocity)
    return whole or stretch_rudiment(onset_s[:-1], velocity[:-1])


def find_rolls(beats: Sequence[Beat], named: Sequence[Rudiment | None], setting: Setting) -> None:
    """Set what rudiments and rolls ask for."""
    rolled_s = -np.inf
    for stretch in _stretches(beats):
        _rudiments(beats, stretch, named, setting)
        if setting.rudiment[stretch[0]] is None and _is_roll(beats, stretch):
            _roll(stretch, setting, leads=beats[stretch[0]].onset_s - rolled_s > ROLLS_APART_S)
            rolled_s = beats[stretch[-1]].onset_s
