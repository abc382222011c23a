"""Notes and rests of each bar, as values with their ties, tuplets and beams."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from reina.notation.bars import Bar
from reina.notation.metre_shape import MetreShape
from reina.notation.rhythm import Placed, Rhythm
from reina.notation.split import Piece, split, split_in_tuplet
from reina.notation.values import TICKS_PER_QUARTER, Value


@dataclass(frozen=True)
class Entry:
    """A note or a rest of a bar.

    Attributes:
        begin: Ticks from the bar's beginning.
        ticks: How long it lasts.
        value: What is written; of a bar's rest a whole note, whatever the metre.
        placed: The note, or None for a rest.
        is_bar_rest: Whether it is the rest of a whole bar.
        tied_from: Whether a tie comes from the entry before.
        tied_to: Whether one goes to the next.
        tuplet: Which tuplet of the bar it is in, from 0, or None.
        beam: Which beam of the bar it is under, from 0, or None.
    """

    begin: int
    ticks: int
    value: Value
    placed: Placed | None = None
    is_bar_rest: bool = False
    tied_from: bool = False
    tied_to: bool = False
    tuplet: int | None = None
    beam: int | None = None


@dataclass(frozen=True)
class Measure:
    """A bar with its notes.

    Attributes:
        bar: Which.
        entries: What stands in it; together they last as long as it.
        tuplets: Of each tuplet the value that it is counted in, 3 of them in the time of 2 (6 of 4).
    """

    bar: Bar
    entries: tuple[Entry, ...]
    tuplets: tuple[int, ...] = ()

    @property
    def is_silent(self) -> bool:
        """Whether nothing is played in it."""
        return all(entry.placed is None for entry in self.entries)


def measures_of(bars: Sequence[Bar], rhythm: Rhythm) -> list[Measure]:
    """Write a rhythm into bars."""
    measures: list[Measure] = []
    first = 0
    notes = rhythm.notes
    for bar in bars:
        while first < len(notes) and notes[first].end <= bar.begin:
            first += 1
        last = first
        while last < len(notes) and notes[last].begin < bar.end:
            last += 1
        measures.append(_measure(bar, notes[first:last], rhythm))
    return measures


def _measure(bar: Bar, notes: Sequence[Placed], rhythm: Rhythm) -> Measure:
    shape = bar.shape
    if not notes:
        rest = Entry(0, shape.ticks, Value(shape.ticks, 1), is_bar_rest=True)
        return Measure(bar, (rest,))
    regions = _regions(bar, rhythm)
    entries: list[Entry] = []
    for begin, end, placed in _spans(bar, notes):
        pieces = list(_pieces(shape, regions, begin, end, is_rest=placed is None))
        for index, (piece, tuplet) in enumerate(pieces):
            entries.append(
                Entry(
                    piece.begin,
                    piece.ticks,
                    piece.value,
                    placed,
                    tied_from=placed is not None and (index > 0 or placed.begin < bar.begin),
                    tied_to=placed is not None and (index < len(pieces) - 1 or placed.end > bar.end),
                    tuplet=tuplet,
                )
            )
    return Measure(bar, _beamed(shape, entries), tuple(grid for _, _, grid in regions))


def _regions(bar: Bar, rhythm: Rhythm) -> list[tuple[int, int, int]]:
    """Return the tuplets of a bar: begin and end in it and grid, ticks."""
    beats = bar.shape.beats
    return [
        (beat, beat + rhythm.tuplets[bar.begin + beat][0], rhythm.tuplets[bar.begin + beat][1])
        for beat in beats[:-1]
        if bar.begin + beat in rhythm.tuplets
    ]


def _spans(bar: Bar, notes: Sequence[Placed]) -> Iterable[tuple[int, int, Placed | None]]:
    at = 0
    for placed in notes:
        begin = max(placed.begin - bar.begin, 0)
        end = min(placed.end - bar.begin, bar.shape.ticks)
        if begin > at:
            yield at, begin, None
        yield begin, end, placed
        at = end
    if at < bar.shape.ticks:
        yield at, bar.shape.ticks, None


def _pieces(
    shape: MetreShape, regions: Sequence[tuple[int, int, int]], begin: int, end: int, *, is_rest: bool
) -> Iterable[tuple[Piece, int | None]]:
    at = begin
    for number, (first, last, grid) in enumerate(regions):
        if last <= at or first >= end:
            continue
        if at < first:
            yield from ((piece, None) for piece in split(shape, at, first, is_rest))
            at = first
        stop = min(last, end)
        if (at, stop) == (first, last):
            yield from ((piece, None) for piece in split(shape, at, stop, is_rest))
        else:
            for piece in split_in_tuplet(at - first, stop - first, grid):
                yield replace(piece, begin=piece.begin + first), number
        at = stop
    if at < end:
        yield from ((piece, None) for piece in split(shape, at, end, is_rest))


def _beamed(shape: MetreShape, entries: Sequence[Entry]) -> tuple[Entry, ...]:
    """Join short notes under beams: those of a beat, and plain eighths of a group of beats."""
    beamed = list(entries)
    number = 0
    for run in _runs(shape, entries):
        if len(run) > 1:
            for index in run:
                beamed[index] = replace(entries[index], beam=number)
            number += 1
    return tuple(beamed)


def _runs(shape: MetreShape, entries: Sequence[Entry]) -> Iterable[list[int]]:
    for begin, end in pairwise(shape.groups):
        inside = [index for index, entry in enumerate(entries) if begin <= entry.begin < end]
        plain = not shape.is_compound and all(_is_plain_eighth(entries[index]) for index in inside)
        if plain and inside:
            yield inside
            continue
        for first, last in pairwise(shape.beats):
            run: list[int] = []
            for index in inside:
                entry = entries[index]
                if not first <= entry.begin < last:
                    continue
                if entry.placed is not None and entry.value.fraction >= 8:
                    run.append(index)
                else:
                    yield run
                    run = []
            yield run


def _is_plain_eighth(entry: Entry) -> bool:
    return entry.placed is not None and entry.ticks == TICKS_PER_QUARTER // 2 and entry.tuplet is None
