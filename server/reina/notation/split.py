"""One length as the values that notate it within a bar, so that beats and groups stay visible."""

from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

from reina.notation.metre_shape import MetreShape
from reina.notation.values import SHORTEST, VALUES, Value, in_tuplet


@dataclass(frozen=True)
class Piece:
    """A value in a bar.

    Attributes:
        begin: Ticks from the bar's beginning.
        ticks: How long it lasts.
        value: What is written.
    """

    begin: int
    ticks: int
    value: Value


@lru_cache(8192)
def split(shape: MetreShape, begin: int, end: int, is_rest: bool) -> tuple[Piece, ...]:
    """Return the fewest values for a span of a bar, ticks; of equal ways the one with the longest first."""
    whole = VALUES.get(end - begin)
    if whole is not None and _fits(shape, begin, end, whole, is_rest=is_rest, alone=True):
        return (Piece(begin, end - begin, whole),)
    best: dict[int, tuple[int, tuple[Piece, ...]]] = {end: (0, ())}
    for place in range(end - SHORTEST, begin - 1, -SHORTEST):
        ways = [
            (1 + best[place + ticks][0], -ticks, (Piece(place, ticks, value), *best[place + ticks][1]))
            for ticks, value in VALUES.items()
            if place + ticks in best
            and _fits(shape, place, place + ticks, value, is_rest=is_rest, alone=False)
        ]
        if ways:
            count, _, pieces = min(ways, key=lambda way: way[:2])
            best[place] = (count, pieces)
    return best[begin][1]


@lru_cache(4096)
def split_in_tuplet(begin: int, end: int, grid: int) -> tuple[Piece, ...]:
    """Return the fewest values for a span of a tuplet, ticks from the tuplet's beginning."""
    value = in_tuplet(end - begin)
    if value is not None:
        return (Piece(begin, end - begin, value),)
    for first in range(end - begin - grid, 0, -grid):
        value = in_tuplet(first)
        if value is not None:
            return (Piece(begin, first, value), *split_in_tuplet(begin + first, end, grid))
    raise ValueError(f"{end - begin} ticks are no values of a tuplet of {grid}")


def _fits(shape: MetreShape, begin: int, end: int, value: Value, *, is_rest: bool, alone: bool) -> bool:
    """Whether a value may stand at a place; `alone`: it is the whole note, not a part of a tied one."""
    if not any(begin < beat < end for beat in shape.beats):
        return _fits_beat(shape, begin, value, is_rest=is_rest)
    crosses = any(begin < group < end for group in shape.groups)
    if is_rest:
        return begin in shape.groups and end in shape.groups
    begins_beat, ends_beat = begin in shape.beats, end in shape.beats
    if begins_beat and ends_beat:
        return not crosses or begin in shape.groups or (alone and not shape.is_compound)
    if crosses or shape.is_compound:
        return False
    off_begin, off_end = _off(shape, begin), _off(shape, end)
    halves = all(off == length / 2 for off, length in (off_begin, off_end) if off)
    beats = sum(begin < beat < end for beat in shape.beats)
    return halves and beats == 1 and (begins_beat or ends_beat or (alone and value.dots == 0))


def _fits_beat(shape: MetreShape, begin: int, value: Value, *, is_rest: bool) -> bool:
    off, length = _off(shape, begin)
    ticks = value.ticks
    if ticks == length:
        return True
    if value.dots:
        base = ticks * 2 // 3
        if is_rest:
            return off % base == 0 and not shape.is_compound
        return off % base == 0 or (off + ticks) % base == 0
    return off % ticks == 0 or (not is_rest and ticks % 2 == 0 and off % (ticks // 2) == 0)


def _off(shape: MetreShape, place: int) -> tuple[int, int]:
    """Return how far a place is within its beat, and how long that is."""
    for begin, end in pairwise(shape.beats):
        if begin <= place < end:
            return place - begin, end - begin
    return 0, shape.beats[-1] - shape.beats[-2]
