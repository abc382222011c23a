"""Note values: how long what stands in a part lasts."""

from collections.abc import Mapping
from dataclasses import dataclass

TICKS_PER_QUARTER = 48
"""So that sixty-fourths and triplet sixteenths are whole numbers of ticks."""

SHORTEST = 3
"""A sixty-fourth, in ticks."""

TUPLET = (3, 2)
"""So many in the time of so many: triplets, sextuplets and triplets of quarters all are."""


@dataclass(frozen=True)
class Value:
    """A note value.

    Attributes:
        ticks: How long it lasts.
        fraction: Which part of a whole note it is: 4 for a quarter.
        dots: How many dots it has, 0 or 1.
    """

    ticks: int
    fraction: int
    dots: int = 0


def _values() -> dict[int, Value]:
    values: dict[int, Value] = {}
    for power in range(7):
        fraction = 2**power
        ticks = 4 * TICKS_PER_QUARTER // fraction
        values[ticks] = Value(ticks, fraction)
        if ticks % 2 == 0 and fraction > 1:
            values[ticks * 3 // 2] = Value(ticks * 3 // 2, fraction, 1)
    return values


VALUES: Mapping[int, Value] = _values()
"""By their ticks: a whole note to a sixty-fourth, and with a dot a half to a thirty-second."""


def in_tuplet(ticks: int) -> Value | None:
    """Return the value that lasts so long within a tuplet, three in the time of two; None if none does."""
    actual, normal = TUPLET
    return VALUES.get(ticks * actual // normal) if ticks * actual % normal == 0 else None
