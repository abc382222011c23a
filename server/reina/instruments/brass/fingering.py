"""How the notes of a line are fingered on valved brass."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

from reina.instruments.brass.chart import Valves
from reina.instruments.note_fingerings import ValvesFingering
from reina.instruments.played import Fingering, PlayedPart
from reina.music.arrays import BoolArray


@dataclass(frozen=True, eq=False)
class BrassFingering(Fingering):
    """How each of the M notes of a line is fingered, as read-only columns.

    Attributes:
        valves: (M, V) bool, whether each valve is down; the first column is valve 1, the one nearest the
            face. Where a note is not playable no valve is down.
        primary: (M,) bool, whether it is the usual fingering.
        cents: (M,) how far the note is off equal temperament before the player corrects it by the lips;
            positive is sharp; 0 where not playable.
        slide: (M,) extension of the third valve's slide, 0 in, 1 out as far as it goes.
    """

    valves: BoolArray
    primary: BoolArray
    cents: Sequence[float]
    slide: Sequence[float]


@dataclass(frozen=True, eq=False)
class BrassPart(PlayedPart):
    """A part as valved brass plays it."""

    fingering: BrassFingering


@cache
def pressed(valves: Valves) -> ValvesFingering:
    """Valves as the wire has them; the same object for the same valves."""
    return ValvesFingering(valves=valves)


def brass_fingering(played: PlayedPart) -> BrassFingering:
    """The fingering of a part that valved brass plays.

    Raises:
        TypeError: Another instrument plays it.
    """
    if not isinstance(played.fingering, BrassFingering):
        raise TypeError(f"valved brass plays what it has fingered itself, not a {type(played.fingering)}")
    return played.fingering
