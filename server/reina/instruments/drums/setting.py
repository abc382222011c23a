"""What goes on around each hit: whether time is kept on a cymbal, whether it is a fill, which hand would lead it."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Final

import numpy as np

from reina.instruments.drums.figures import SINGLES, Rudiment, is_even, stretch_rudiment
from reina.instruments.drums.habits import (
    CROSS_STICK,
    FASTEST_SINGLES,
    IN_GROOVE,
    IN_RUN,
    LEFT,
    LEFT_ON_FAST_HAT,
    LEFT_ON_FULL_HAT,
    RIGHT,
    TIMEKEEPERS,
)
from reina.instruments.drums.hit import PIECES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.rotations.arrays import FloatArray, IntArray

SNARE: Final = PIECES.index("snare")
_IS_TIMEKEEPER: Final = np.array([piece in TIMEKEEPERS for piece in PIECES])
_CRASHES: Final = (PIECES.index("crash_left"), PIECES.index("crash_right"))
_LED: Final = [PIECES.index(piece) for piece in ("snare", "tom_high", "tom_mid", "tom_floor")]
_GROOVE: Final = [IN_GROOVE[piece] for piece in PIECES]
_RUN: Final = [IN_RUN[piece] for piece in PIECES]
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

RUN_GAP_S: Final = 0.62
"""A longer gap ends a run."""

GRACED_GAP_S: Final = 1.3
"""As long may the gap be between flams or drags: they alternate even when they are slow."""

LEAD: Final = 0.25
"""What it costs to play with the hand that does not lead where the bar is divided evenly."""

LEAD_FIRST: Final = 0.5
"""What it costs at a run's first stroke."""

ROLLS_APART_S: Final = 1.5
"""Rolls nearer than this begin with one hand and the other in turn."""

FORCED: Final = 40.0
"""What it costs to leave a rudiment's sticking, or one that is written."""

LEAD_UNEVEN: Final = 0.75
"""The same where the bar is not divided evenly, as in triplets: the right hand begins, and they alternate."""

ALTERNATE: Final = 0.15
"""What it costs that a hand strikes twice within a run, at a gap of less than `ALTERNATE_S`."""

ALTERNATE_S: Final = 0.3

LOCAL: Final = 1
"""Gaps on either side that say how the bar is divided at a place."""

SHORTEST_S: Final = 0.045
"""Gaps of less divide no bar."""

EVEN_GRIDS: Final = (2.0, 1.0, 0.5, 0.25, 0.125, 1.0 / 6.0, 1.0 / 12.0)
"""Divisions in quarter notes that put the leading hand on each beat or each second one."""


@dataclass(frozen=True)
class Beat:
    """What the hands strike at one time.

    Attributes:
        onset_s: Seconds.
        beat: Quarter notes since the beginning of the bar.
        hits: Indices of one hit or of two.
        pieces: What they strike.
        velocity: The loudest's.
        is_cross_stick: Whether it is a single cross-stick.
        graces: How many grace notes go before it.
        after_kick: Whether the bass drum is struck since the last one, or with it.
    """

    onset_s: float
    beat: float
    hits: tuple[int, ...]
    pieces: tuple[int, ...]
    velocity: float
    is_cross_stick: bool = False
    graces: int = 0
    after_kick: bool = False


@dataclass
class Setting:
    """What is preferred at each of G beats.

    Attributes:
        cost: (G, 2) of the right and of the left hand.
        place: Of each what goes on there: ``groove``, ``run``, ``fast hat`` or ``rudiment``.
        rudiment: Of each the rudiment that it belongs to.
        again: (G,) what it costs that the hand strikes that struck last.
        turn: (G,) 1 where the hands should change, -1 where the same should go on, 0 where neither matters.
    """

    cost: FloatArray
    place: list[str]
    rudiment: list[Rudiment | None]
    again: FloatArray
    turn: IntArray


def setting_of(beats: Sequence[Beat], named: Sequence[Rudiment | None]) -> Setting:
    """Find what goes on at each beat.

    Args:
        beats: What the hands strike.
        named: Of each beat the rudiment that a part's name or a marker asks for.
    """
    count = len(beats)
    keeps = _timekeeping(beats)
    in_groove = _in_groove(beats, keeps)
    setting = Setting(
        np.zeros((count, 2)),
        ["groove"] * count,
        [None] * count,
        np.zeros(count),
        np.zeros(count, dtype=np.int64),
    )
    for index, beat in enumerate(beats):
        if len(beat.pieces) > 1:
            continue
        table = _GROOVE if in_groove[index] or keeps[index] else _RUN
        setting.cost[index] = CROSS_STICK if beat.is_cross_stick else table[beat.pieces[0]]
    _fast_hats(beats, keeps, setting)
    for run in _runs(beats, keeps, in_groove):
        _lead(beats, run, setting)
    rolled_s = -np.inf
    for stretch in _stretches(beats):
        _rudiments(beats, stretch, named, setting)
        if setting.rudiment[stretch[0]] is None and _is_roll(beats, stretch):
            _roll(stretch, setting, leads=beats[stretch[0]].onset_s - rolled_s > ROLLS_APART_S)
            rolled_s = beats[stretch[-1]].onset_s
    return setting


def _timekeeping(beats: Sequence[Beat]) -> list[bool]:
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


def _in_groove(beats: Sequence[Beat], keeps: Sequence[bool]) -> list[bool]:
    """Whether a beat stands between two of the timekeeper, or at one."""
    count = len(beats)
    before, after = [-1] * count, [count] * count
    kept = [beat.onset_s for beat, is_kept in zip(beats, keeps, strict=True) if is_kept]
    place = (np.cumsum(keeps) - 1).tolist()
    last = -1
    for index in range(count):
        before[index] = last = index if keeps[index] else last
    last = count
    for index in reversed(range(count)):
        after[index] = last = index if keeps[index] else last
    inside: list[bool] = []
    for index in range(count):
        first, second = before[index], after[index]
        if first < 0 and second >= count:
            inside.append(False)
        elif first < 0 or second >= count:
            # At the beginning and at the end of the time-keeping a stroke or two belong to it.
            near = second if first < 0 else first
            few = near <= 1 if first < 0 else count - 1 - first <= GROOVE_BETWEEN
            inside.append(few and abs(beats[near].onset_s - beats[index].onset_s) <= GROOVE_SPAN_S / 2)
        else:
            span = beats[second].onset_s - beats[first].onset_s
            between = second - first - 1
            leaves = between > 1 and span > LEAVES_OUT * _period(kept, place[first])
            inside.append(between <= GROOVE_BETWEEN and span <= GROOVE_SPAN_S and not leaves)
    return inside


def _period(kept: Sequence[float], place: int) -> float:
    """How far a timekeeper's strokes usually are apart around one of them, seconds."""
    near = kept[max(0, place - 4) : place + 6]
    return float(np.median(np.diff(near)))


def _fast_hats(beats: Sequence[Beat], keeps: Sequence[bool], setting: Setting) -> None:
    """Share a fast hi-hat between the hands, unless it goes on through the backbeat."""
    count, begin = len(beats), 0
    while begin < count:
        end = begin + 1
        while end < count and beats[end].onset_s - beats[end - 1].onset_s <= FAST_S:
            end += 1
        hats = [i for i in range(begin, end) if keeps[i] and beats[i].pieces == (_HI_HAT,)]
        if len(hats) >= 4 and any(second - first == 1 for first, second in pairwise(hats)):
            # A bar's length around each hat says whether the backbeat falls together with it.
            full = np.array([len(beats[i].pieces) > 1 for i in range(begin, end)])
            for index in range(begin, end):
                beat = beats[index]
                if len(beat.pieces) > 1:
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
                    wrong = _wrong_hand(beat.beat, 0.25)
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


def _runs(beats: Sequence[Beat], keeps: Sequence[bool], in_groove: Sequence[bool]) -> list[range]:
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


def _lead(beats: Sequence[Beat], run: range, setting: Setting) -> None:
    """The right hand leads: on the beats where the bar is divided evenly, else at the beginning."""
    if len(run) == 1:
        beat = beats[run[0]]
        if len(beat.pieces) == 1:
            setting.cost[run[0]] = _GROOVE[beat.pieces[0]]
        return
    positions = np.array([beats[index].beat for index in run])
    gaps_s = np.diff([beats[index].onset_s for index in run])
    gaps = np.mod(np.diff(positions), 1.0)
    gaps = np.where(gaps_s > SHORTEST_S, np.where(gaps < 0.02, 1.0, gaps), np.inf)
    for place, index in enumerate(run):
        setting.place[index] = "run"
        if beats[index].pieces[0] not in _LED:
            continue
        if place and gaps_s[place - 1] < ALTERNATE_S:
            setting.again[index] = ALTERNATE
        if len(beats[index].pieces) > 1:
            continue
        grid = _nearest_grid(float(np.min(gaps[max(0, place - LOCAL) : place + LOCAL])))
        if grid is not None:
            wrong = _wrong_hand(beats[index].beat, grid)
            if wrong is not None:
                setting.cost[index, wrong] += LEAD_FIRST if place == 0 else LEAD
        elif place == 0:
            setting.cost[index, LEFT] += LEAD_UNEVEN


def _nearest_grid(gap: float) -> float | None:
    """The even division that a gap in quarter notes is of, or None."""
    for grid in EVEN_GRIDS:
        if abs(gap - grid) <= 0.12 * grid:
            return grid
    return None


def _wrong_hand(beat: float, grid: float) -> int | None:
    """The hand that does not lead at a place in the bar; None where it lies off the division."""
    place = beat / grid
    nearest = round(place)
    if abs(place - nearest) > 0.3:
        return None
    return RIGHT if nearest % 2 else LEFT


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
                if next_gap > RUN_GAP_S or (gap and abs(next_gap - gap) > 0.25 * gap):
                    break
                gap = gap or next_gap
                end += 1
            if end - begin >= 2:
                stretches.append(range(begin, end))
        begin = end
    return stretches


def _is_roll(beats: Sequence[Beat], stretch: range) -> bool:
    """Whether notes follow each other too fast for single strokes."""
    span = beats[stretch[-1]].onset_s - beats[stretch[0]].onset_s
    return len(stretch) >= 4 and span < (len(stretch) - 1) / FASTEST_SINGLES


def _roll(stretch: range, setting: Setting, *, leads: bool) -> None:
    """Double strokes from the first note on; the first roll begins with the right hand, the next with the other."""
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
