"""Fills, rolls and whatever else goes on without a timekeeper: who leads."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from reina.instruments.drums.hit import PIECES
from reina.instruments.drums.sticking.beat import DRUMS, LEAD, LEAD_FIRST, RUN_GAP_S
from reina.instruments.drums.sticking.grids import nearest_grid, wrong_hand
from reina.instruments.drums.sticking.habits import IN_GROOVE, LEFT

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.drums.sticking.beat import Beat, Setting

_GROOVE: Final = [IN_GROOVE[piece] for piece in PIECES]

GRACED_GAP_S: Final = 1.3
"""As long may the gap be between flams or drags: they alternate even when they are slow."""

LEAD_UNEVEN: Final = 0.75
"""The same where the bar is not divided evenly, as in triplets: the right hand begins, and they alternate."""

ALTERNATE: Final = 0.15
"""What it costs that a hand strikes twice within a run, at a gap of less than `ALTERNATE_S`."""

ALTERNATE_S: Final = 0.3

LOCAL: Final = 1
"""Gaps on either side that say how the bar is divided at a place."""

SHORTEST_S: Final = 0.045
"""Gaps of less divide no bar."""


def runs_of(beats: Sequence[Beat], keeps: Sequence[bool], in_groove: Sequence[bool]) -> list[range]:
    """Fills and rolls: single strokes one after the other without a timekeeper."""
    runs: list[range] = []
    begin = 0
    while begin < len(beats):
        if keeps[begin] or in_groove[begin]:
            begin += 1
            continue
        end = begin + 1
        while end < len(beats) and not keeps[end] and not in_groove[end]:
            graced = beats[end].graces and beats[end - 1].graces
            if beats[end].onset_s - beats[end - 1].onset_s > (GRACED_GAP_S if graced else RUN_GAP_S):
                break
            end += 1
        runs.append(range(begin, end))
        begin = end
    return runs


def lead(beats: Sequence[Beat], run: range, setting: Setting) -> None:
    """The right hand leads: on the beats where the bar is divided evenly, else at the beginning."""
    if len(run) == 1:
        beat = beats[run[0]]
        if not beat.is_both:
            setting.cost[run[0]] = _GROOVE[beat.pieces[0]]
        return
    positions = np.array([beats[index].beat for index in run])
    gaps_s = np.diff([beats[index].onset_s for index in run])
    gaps = np.mod(np.diff(positions), 1.0)
    gaps = np.where(gaps_s > SHORTEST_S, np.where(gaps < 0.02, 1.0, gaps), np.inf)
    for place, index in enumerate(run):
        setting.place[index] = "run"
        if beats[index].pieces[0] not in DRUMS:
            continue
        if place and gaps_s[place - 1] < ALTERNATE_S:
            setting.again[index] = ALTERNATE
        if beats[index].is_both:
            continue
        grid = nearest_grid(float(np.min(gaps[max(0, place - LOCAL) : place + LOCAL])))
        if grid is not None:
            wrong = wrong_hand(beats[index].beat, grid)
            if wrong is not None:
                setting.cost[index, wrong] += LEAD_FIRST if place == 0 else LEAD
        elif place == 0:
            setting.cost[index, LEFT] += LEAD_UNEVEN
