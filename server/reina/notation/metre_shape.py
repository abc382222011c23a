"""How a bar is divided: the beats that values are told by, and the groups that they do not hide."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from reina.notation.values import SHORTEST, TICKS_PER_QUARTER

WHOLE = 4 * TICKS_PER_QUARTER

GROUPS_OF_QUARTERS = {4: (2, 2), 5: (3, 2), 6: (3, 3), 7: (4, 3), 3: (3,)}
"""How so many quarters make groups; other numbers go by twos."""

GROUPS_OF_SHORT_NOTES = {
    5: (3, 2),
    7: (2, 2, 3),
    8: (3, 3, 2),
    10: (3, 3, 2, 2),
    11: (3, 3, 3, 2),
    13: (3, 3, 3, 2, 2),
}
"""How so many eighths (or sixteenths) make beats; multiples of three go by threes, other numbers by twos."""


@dataclass(frozen=True)
class MetreShape:
    """A bar.

    Attributes:
        ticks: How long it is.
        beats: Where its beats begin, ascending from 0, and its end.
        groups: Those beats that must stay visible, from 0, and its end: in 4/4 the first and the third.
        is_compound: Whether its beats are of three parts, as in 6/8.
    """

    ticks: int
    beats: tuple[int, ...]
    groups: tuple[int, ...]
    is_compound: bool = False

    def cut(self, ticks: int) -> "MetreShape":
        """Return a bar of this metre that ends early."""
        return MetreShape(ticks, _within(self.beats, ticks), _within(self.groups, ticks), self.is_compound)

    def pickup(self, ticks: int) -> "MetreShape":
        """Return the end of a bar of this metre, as pieces begin with it."""
        late = self.ticks - ticks
        return MetreShape(
            ticks,
            _within([beat - late for beat in self.beats], ticks),
            _within([group - late for group in self.groups], ticks),
            self.is_compound,
        )


@lru_cache(256)
def shape_of(numerator: int, denominator: int) -> MetreShape:
    """Return the bar of a metre; one whose notes cannot be written is rounded to sixty-fourths."""
    unit = max(SHORTEST, round(WHOLE / denominator / SHORTEST) * SHORTEST)
    if denominator <= 4:
        quarters = max(1, numerator * unit // TICKS_PER_QUARTER)
        beats = _places([1] * quarters, TICKS_PER_QUARTER)
        by_twos = [2] * (quarters // 2) + [1] * (quarters % 2)
        sizes = GROUPS_OF_QUARTERS.get(quarters, by_twos) if denominator == 4 or quarters == 4 else by_twos
        return MetreShape(beats[-1], beats, _places(sizes, TICKS_PER_QUARTER))
    if numerator % 3 == 0:
        beats = _places([3] * (numerator // 3), unit)
        groups = _places([6] * (numerator // 6), unit) if numerator % 12 == 0 else beats
        return MetreShape(beats[-1], beats, groups, is_compound=True)
    twos = [2] * (numerator // 2) + [1] * (numerator % 2)
    beats = _places(GROUPS_OF_SHORT_NOTES.get(numerator, twos), unit)
    return MetreShape(beats[-1], beats, beats)


def _places(sizes: Sequence[int], unit: int) -> tuple[int, ...]:
    places = [0]
    for size in sizes:
        places.append(places[-1] + size * unit)
    return tuple(places)


def _within(places: Sequence[int], ticks: int) -> tuple[int, ...]:
    return (0, *(place for place in places if 0 < place < ticks), ticks)
