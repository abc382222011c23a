"""Where a cymbal keeps the time, what stands within its groove, and which hands a fast hi-hat asks for."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Final

import numpy as np

from reina.instruments.drums.hit import PIECES
from reina.instruments.drums.sticking.beat import DRUMS, LEAD, SNARE
from reina.instruments.drums.sticking.grids import wrong_hand
from reina.instruments.drums.sticking.habits import LEFT, LEFT_ON_FAST_HAT, LEFT_ON_FULL_HAT, TIMEKEEPERS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.drums.sticking.beat import Beat, Setting

_IS_TIMEKEEPER: Final = tuple(piece in TIMEKEEPERS for piece in PIECES)
_CRASHES: Final = (PIECES.index("crash_left"), PIECES.index("crash_right"))
_HI_HAT: Final = PIECES.index("hi_hat")
_FLOOR: Final = PIECES.index("tom_floor")

GROOVE_SPAN_S: Final = 1.45
"""Two strokes of the timekeeper that are farther apart leave the time to others."""

GROOVE_BETWEEN: Final = 2
"""More strokes than these between two of the timekeeper are a fill."""

LEAVES_OUT: Final = 2.2
"""Where the timekeeper leaves out so many of its strokes, several others are a fill."""

FAST_S: Final = 0.2
"""Strokes of a timekeeper at this gap or less may be shared by both hands."""


def find_timekeeping(beats: Sequence[Beat]) -> list[bool]:
    """Whether a cymbal that keeps the time is struck; a crash does where it comes again at once."""
    keeps: list[bool] = []
    for index, beat in enumerate(beats):
        crash = next((piece for piece in beat.pieces if piece in _CRASHES), None)
        again = crash is not None and sum(
            crash in other.pieces and abs(other.onset_s - beat.onset_s) < 0.8
            for other in beats[max(0, index - 3) : index + 4]
        )
        floor = _FLOOR in beat.pieces and _is_floor_groove(beats, index)
        keeps.append(any(_IS_TIMEKEEPER[piece] for piece in beat.pieces) or again > 2 or floor)
    return keeps


def _is_floor_groove(beats: Sequence[Beat], index: int) -> bool:
    """Whether the floor tom goes on under the snare's strokes, in a cymbal's stead."""
    near = beats[max(0, index - 5) : index + 6]
    goes_on = sum(_FLOOR in beat.pieces for beat in near)
    under = sum(_FLOOR in beat.pieces and SNARE in beat.pieces for beat in near)
    return goes_on >= 0.75 * len(near) and 0 < under < goes_on - under


def find_groove(beats: Sequence[Beat], keeps: Sequence[bool]) -> list[bool]:
    """Whether a beat stands between two of the timekeeper, or at one."""
    count = len(beats)
    before, after = [-1] * count, [count] * count
    kept = [beat.onset_s for beat, is_kept in zip(beats, keeps, strict=True) if is_kept]
    place = (np.cumsum(keeps) - 1).tolist()
    drums = np.cumsum([beat.pieces[0] in DRUMS for beat in beats]).tolist()
    last = -1
    for index in range(count):
        before[index] = last = index if keeps[index] else last
    last = count
    for index in reversed(range(count)):
        after[index] = last = index if keeps[index] else last
    inside: list[bool] = []
    for index in range(count):
        first, second = before[index], after[index]
        if keeps[index]:
            inside.append(True)
        elif first < 0 and second >= count:
            inside.append(False)
        elif first < 0 or second >= count:
            # At the beginning and at the end of the time-keeping a stroke or two belong to it.
            near = second if first < 0 else first
            few = near <= 1 if first < 0 else count - 1 - first <= GROOVE_BETWEEN
            inside.append(few and abs(beats[near].onset_s - beats[index].onset_s) <= GROOVE_SPAN_S / 2)
        else:
            span = beats[second].onset_s - beats[first].onset_s
            between = second - first - 1
            of_drums = drums[second - 1] - drums[first]
            leaves = of_drums > 1 and span > LEAVES_OUT * _period(kept, place[first])
            inside.append(between <= GROOVE_BETWEEN and span <= GROOVE_SPAN_S and not leaves)
    return inside


def _period(kept: Sequence[float], place: int) -> float:
    """How far a timekeeper's strokes usually are apart around one of them, seconds."""
    near = kept[max(0, place - 4) : place + 6]
    return float(np.median(np.diff(near)))


def share_fast_hats(beats: Sequence[Beat], keeps: Sequence[bool], setting: Setting) -> None:
    """Share a fast hi-hat between the hands, unless it goes on through the backbeat."""
    count, begin = len(beats), 0
    while begin < count:
        end = begin + 1
        while end < count and beats[end].onset_s - beats[end - 1].onset_s <= FAST_S:
            end += 1
        hats = [i for i in range(begin, end) if keeps[i] and beats[i].pieces == (_HI_HAT,)]
        if len(hats) >= 4 and any(second - first == 1 for first, second in pairwise(hats)):
            # A bar's length around each hat says whether the backbeat falls together with it.
            full = np.array([beats[i].is_both for i in range(begin, end)])
            for index in range(begin, end):
                beat = beats[index]
                if beat.is_both:
                    continue
                near = full[max(0, index - begin - 8) : index - begin + 9]
                is_shared = not near.any()
                if beat.pieces[0] == _HI_HAT:
                    setting.cost[index, LEFT] = LEFT_ON_FAST_HAT if is_shared else LEFT_ON_FULL_HAT
                elif beat.pieces[0] == SNARE and is_shared and _amid_hats(beats, index, keeps):
                    setting.cost[index] = (0.0, 0.0)
                else:
                    continue
                if is_shared:
                    setting.place[index] = "fast hat"
                    wrong = wrong_hand(beat.beat, 0.25)
                    if wrong is not None:
                        setting.cost[index, wrong] += LEAD
        begin = end


def _amid_hats(beats: Sequence[Beat], index: int, keeps: Sequence[bool]) -> bool:
    """Whether a snare stands in the place of one hat of an even row."""
    if not 0 < index < len(beats) - 1 or not (keeps[index - 1] and keeps[index + 1]):
        return False
    rows = [(index - 2, index - 1), (index + 1, index + 2)]
    gap = 0.5 * (beats[index + 1].onset_s - beats[index - 1].onset_s)
    return any(
        first >= 0 and second < len(beats) and keeps[first] and keeps[second]
        and abs(beats[second].onset_s - beats[first].onset_s - gap) <= 0.25 * gap
        for first, second in rows
    )  # fmt: skip
