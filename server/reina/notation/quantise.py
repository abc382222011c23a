"""Played times to written ones: onsets and ends on grids that can be notated.

Of each beat the grid is taken that costs least: what it is off the notes, in units of how exactly people
play, and how hard it is to read. So a beat of three notes is a triplet where they lie like one, and a late
eighth stays an eighth. Compare the grammar of C. Raphael, A Hybrid Graphical Model for Rhythmic Parsing
(Artificial Intelligence 137, 2002), whose prior is our table.
"""

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reina.notation.bars import Bar
from reina.notation.rhythm import Placed, Rhythm
from reina.notation.swing import straightened, swing_of
from reina.notation.tuplets import join_tuplets
from reina.notation.values import TICKS_PER_QUARTER

PLAYED_S = 0.02
"""How far people's notes fall from where they are written, as a standard deviation."""
MIN_SPREAD, MAX_SPREAD = 0.012, 0.05
"""Between these that is kept, quarter notes: a file that was written has the least."""

SAME_BEAT = 0.004
"""So near to an eighth or a sixth of a beat, in quarter notes, an onset stands where a program wrote it."""

GRIDS_OF_QUARTER = {48: 0.0, 24: 0.4, 12: 1.2, 16: 2.2, 8: 5.0, 6: 4.5, 3: 9.0}
GRIDS_OF_COMPOUND = {24: 0.0, 12: 0.8, 6: 4.0, 36: 3.0, 18: 6.0, 3: 9.0}
GRIDS_OF_OTHER = {24: 0.2, 12: 0.6, 6: 3.0, 3: 6.0}
"""How hard each grid, ticks, is to read: in a quarter, in a beat of three eighths, in other beats."""
TUPLET_GRIDS = (16, 8)
"""Of a quarter."""

COLLISION = 30.0
"""Of two notes that would fall on one place."""
GRACE, GRACE_OFF = 3.5, 4.0
"""Where the first may be a grace note; and what being off counts at most for it, if the file was played."""
GRACE_S = 0.09
"""A grace note is no longer, and three times shorter than its note."""

FILLED_SHARE = 0.25
"""A note whose silence before the next is no longer than this share of both is written without a rest."""
FILLED_S = 0.09
"""Nor is a rest written that is shorter than this."""
STACCATO_TICKS = 48
"""A note up to this length that sounds for less than `STACCATO_SHARE` has a dot and no rest after it."""
STACCATO_SHARE, RESTED_SHARE = 0.65, 0.3


@dataclass(frozen=True)
class _Cell:
    begin: int
    end: int
    is_compound: bool


def quantise(
    bars: Sequence[Bar],
    onset_beats: Sequence[float],
    end_beats: Sequence[float],
    seconds_per_beat: Sequence[float],
) -> Rhythm:
    """Write a line of notes, one at a time.

    Args:
        bars: The score's bars, past the end of the last note.
        onset_beats: (M,) quarter notes, ascending.
        end_beats: (M,) not after the next onset.
        seconds_per_beat: (M,) the tempo at each onset.
    """
    if not len(onset_beats):
        return Rhythm((), {}, swing=False)
    clock = _Clock(bars)
    onsets, ends = clock.ticks(onset_beats), clock.ticks(end_beats)
    spread = _spreads(onset_beats, seconds_per_beat)
    may_be_grace = _may_be_grace(onset_beats, end_beats, seconds_per_beat)
    cells, cell_of = _cells(bars, onsets, spread)
    onsets, ends, swing = _without_swing(onsets, ends, cells, cell_of, clock)
    grids = _choose_grids(cells, cell_of, onsets, spread, may_be_grace)
    begins = [_nearest(onsets[i], cells[cell_of[i]], grids[cell_of[i]]) for i in range(len(onsets))]
    by_begin = {cell.begin: (cell, grids[index]) for index, cell in enumerate(cells)}
    kept, graces = _graces(begins)
    notes = [
        _placed(at, note, kept, begins, onsets, ends, seconds_per_beat, clock, by_begin, graces)
        for at, note in enumerate(kept)
    ]
    tuplets = {
        cell.begin: (cell.end - cell.begin, grid)
        for cell, grid in zip(cells, grids, strict=True)
        if _is_quarter(cell) and grid in TUPLET_GRIDS
    }
    used = {cells[cell_of[note]].begin for note in kept}
    tuplets = {at: tuplet for at, tuplet in tuplets.items() if at in used}
    return join_tuplets(bars, Rhythm(tuple(notes), tuplets, swing=swing))


class _Clock:
    """Beats to ticks, and ticks to the beat (of the metre) that they are in."""

    def __init__(self, bars: Sequence[Bar]) -> None:
        self._bars = bars
        self._begin_beats = [bar.begin_beats for bar in bars]
        self._begins = [bar.begin for bar in bars]

    def ticks(self, beats: Sequence[float]) -> list[float]:
        """Return places in quarter notes as ticks."""
        places = [max(bisect_right(self._begin_beats, beat + 1e-9) - 1, 0) for beat in beats]
        return [self._bars[place].ticks_at(beat) for place, beat in zip(places, beats, strict=True)]

    def cell_at(self, ticks: float) -> _Cell:
        """Return the beat that a place is in."""
        bar = self._bars[max(bisect_left(self._begins, ticks + 1e-6) - 1, 0)]
        beats = bar.shape.beats
        index = max(bisect_left(beats, ticks - bar.begin + 1e-6) - 1, 0)
        index = min(index, len(beats) - 2)
        return _Cell(bar.begin + beats[index], bar.begin + beats[index + 1], bar.shape.is_compound)


def _spreads(onset_beats: Sequence[float], seconds_per_beat: Sequence[float]) -> list[float]:
    """Return by how many ticks each onset may be off, as a standard deviation."""
    beats = np.array(onset_beats, dtype=np.float64)
    off = [np.abs(beats * parts - np.round(beats * parts)) / parts for parts in (8, 6)]
    written = np.minimum(off[0], off[1]) < SAME_BEAT
    was_written = float(np.mean(written)) > 0.9
    return [
        MIN_SPREAD * TICKS_PER_QUARTER
        if was_written and is_exact
        else min(max(PLAYED_S / seconds, MIN_SPREAD), MAX_SPREAD) * TICKS_PER_QUARTER
        for seconds, is_exact in zip(seconds_per_beat, written.tolist(), strict=True)
    ]


def _may_be_grace(
    onset_beats: Sequence[float], end_beats: Sequence[float], seconds_per_beat: Sequence[float]
) -> list[bool]:
    onsets = [*onset_beats, end_beats[-1]]
    until_next = [
        (later - onset) * seconds
        for onset, later, seconds in zip(onset_beats, onsets[1:], seconds_per_beat, strict=True)
    ]
    return [
        before <= GRACE_S and 3 * before <= after
        for before, after in zip(until_next, [*until_next[1:], 0.0], strict=True)
    ]


def _cells(
    bars: Sequence[Bar], onsets: Sequence[float], spread: Sequence[float]
) -> tuple[list[_Cell], list[int]]:
    """Return the beats that onsets are in, and of each onset which; what is barely early is in the next."""
    clock = _Clock(bars)
    cells: list[_Cell] = []
    cell_of: list[int] = []
    for onset, off in zip(onsets, spread, strict=True):
        cell = clock.cell_at(max(onset + 1.2 * off, 0.0))
        if not cells or cells[-1] != cell:
            cells.append(cell)
        cell_of.append(len(cells) - 1)
    return cells, cell_of


def _is_quarter(cell: _Cell) -> bool:
    return not cell.is_compound and cell.end - cell.begin == TICKS_PER_QUARTER


def _without_swing(
    onsets: Sequence[float],
    ends: Sequence[float],
    cells: Sequence[_Cell],
    cell_of: Sequence[int],
    clock: _Clock,
) -> tuple[list[float], list[float], bool]:
    phases: list[list[float]] = [[] for _ in cells]
    for onset, index in zip(onsets, cell_of, strict=True):
        phases[index].append((onset - cells[index].begin) / TICKS_PER_QUARTER)
    swing = swing_of([phases[index] for index, cell in enumerate(cells) if _is_quarter(cell)])
    if swing is None:
        return list(onsets), list(ends), False

    def straight(at: float, cell: _Cell) -> float:
        phase = (at - cell.begin) / TICKS_PER_QUARTER
        if not _is_quarter(cell) or not 0.0 < phase < 1.0:
            return at
        return cell.begin + TICKS_PER_QUARTER * straightened(phase, swing)

    return (
        [straight(onset, cells[index]) for onset, index in zip(onsets, cell_of, strict=True)],
        [straight(end, clock.cell_at(end)) for end in ends],
        True,
    )


def _choose_grids(
    cells: Sequence[_Cell],
    cell_of: Sequence[int],
    onsets: Sequence[float],
    spread: Sequence[float],
    may_be_grace: Sequence[bool],
) -> list[int]:
    members: list[list[int]] = [[] for _ in cells]
    for note, index in enumerate(cell_of):
        members[index].append(note)
    return [
        _grid(cell, notes, onsets, spread, may_be_grace) for cell, notes in zip(cells, members, strict=True)
    ]


def _grid(
    cell: _Cell,
    notes: Sequence[int],
    onsets: Sequence[float],
    spread: Sequence[float],
    may_be_grace: Sequence[bool],
) -> int:
    length = cell.end - cell.begin
    following = onsets[notes[-1] + 1] if notes[-1] + 1 < len(onsets) else None

    def cost(grid: int, hard: float) -> float:
        total = hard
        places = [_nearest(onsets[note], cell, grid) for note in notes]
        if following is not None and following < cell.end + 6:
            places.append(cell.end)
        for at, note in enumerate(notes):
            off = ((onsets[note] - places[at]) / spread[note]) ** 2
            collides = at + 1 < len(places) and places[at + 1] == places[at]
            if collides and may_be_grace[note]:
                played = spread[note] > MIN_SPREAD * TICKS_PER_QUARTER
                total += GRACE + (min(off, GRACE_OFF) if played else off)
            else:
                total += off + (COLLISION if collides else 0.0)
        return total

    if _is_quarter(cell):
        grids = GRIDS_OF_QUARTER
    elif cell.is_compound and length % 72 == 0:
        grids = GRIDS_OF_COMPOUND
    else:
        grids = GRIDS_OF_OTHER
    usable = {grid: hard for grid, hard in grids.items() if grid <= length} or {length: 0.0}
    return min(usable, key=lambda grid: cost(grid, usable[grid]))


def _nearest(at: float, cell: _Cell, grid: int) -> int:
    steps = round((at - cell.begin) / grid)
    return min(cell.begin + max(steps, 0) * grid, cell.end)


def _graces(begins: Sequence[int]) -> tuple[list[int], dict[int, tuple[int, ...]]]:
    """Return the notes that have a place of their own, and the grace notes before each."""
    kept: list[int] = []
    graces: dict[int, tuple[int, ...]] = {}
    waiting: list[int] = []
    for note, begin in enumerate(begins):
        if note + 1 < len(begins) and begins[note + 1] <= begin:
            waiting.append(note)
            continue
        if kept and begins[kept[-1]] >= begin:
            continue
        kept.append(note)
        if waiting:
            graces[note] = tuple(waiting)
            waiting = []
    return kept, graces


def _placed(
    at: int,
    note: int,
    kept: Sequence[int],
    begins: Sequence[int],
    onsets: Sequence[float],
    ends: Sequence[float],
    seconds_per_beat: Sequence[float],
    clock: _Clock,
    grids: dict[int, tuple[_Cell, int]],
    graces: dict[int, tuple[int, ...]],
) -> Placed:
    begin = begins[note]
    following = begins[kept[at + 1]] if at + 1 < len(kept) else None
    next_onset = onsets[kept[at + 1]] if at + 1 < len(kept) else None
    sounds = ends[note] - onsets[note]
    if following is not None and next_onset is not None:
        whole = next_onset - onsets[note]
        silence_s = (next_onset - ends[note]) / TICKS_PER_QUARTER * seconds_per_beat[note]
        share = sounds / max(whole, 1e-9)
        if share >= 1.0 - FILLED_SHARE or silence_s <= FILLED_S:
            return Placed(note, begin, following, graces=graces.get(note, ()))
        if following - begin <= STACCATO_TICKS and share >= RESTED_SHARE:
            staccato = share < STACCATO_SHARE
            return Placed(note, begin, following, is_staccato=staccato, graces=graces.get(note, ()))
    end = _end(begin, begin + sounds, clock, grids)
    if following is not None:
        end = min(end, following)
    return Placed(note, begin, end, graces=graces.get(note, ()))


def _end(begin: int, at: float, clock: _Clock, grids: dict[int, tuple[_Cell, int]]) -> int:
    """Return the written end of a note: on its beat's grid, or on halves of beats without onsets.

    Most notes are let go a little early, so that the next place is taken rather than the one before.
    """
    cell = clock.cell_at(max(at - 1e-6, 0.0))
    known = grids.get(cell.begin)
    length = cell.end - cell.begin
    grid = known[1] if known else 24
    grid = min(grid, length) if known and grid in TUPLET_GRIDS else min(max(grid, 12), 24, length)
    steps = int((at - cell.begin) / grid + 0.7)
    end = min(cell.begin + steps * grid, cell.end)
    if end > begin:
        return end
    own = clock.cell_at(begin)
    own_grid = grids[own.begin][1] if own.begin in grids else 12
    return min(begin + min(own_grid, 24), own.end) if own.end > begin else begin + 12
