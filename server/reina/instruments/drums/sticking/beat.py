"""What hands strike at one time, and what is preferred there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from reina.instruments.drums.hit import PIECES

if TYPE_CHECKING:
    from reina.instruments.drums.sticking.figures import Rudiment
    from reina.rotations.arrays import FloatArray, IntArray

SNARE: Final = PIECES.index("snare")
DRUMS: Final = tuple(PIECES.index(piece) for piece in ("snare", "tom_high", "tom_mid", "tom_floor"))

FORCED: Final = 40.0
"""What it costs to leave a rudiment's sticking, or one that is written."""

RUN_GAP_S: Final = 0.62
"""A longer gap ends a run."""

LEAD: Final = 0.25
"""What it costs to play with the hand that does not lead where the bar is divided evenly."""

LEAD_FIRST: Final = 0.5
"""What it costs at a run's first stroke."""


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

    @property
    def is_both(self) -> bool:
        """Whether two hands strike."""
        return len(self.hits) > 1


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
