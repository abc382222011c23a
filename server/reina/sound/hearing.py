"""What of a score somebody wants to hear: all of it, one player's part, or the rest; and how high."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from reina.sound.events import SoundPlan
from reina.sound.passages import Passage

MOST_SEMITONES = 12

Stem = Literal["all", "part", "rest"]


@dataclass(frozen=True)
class Hearing:
    """A way to hear a score.

    Attributes:
        stem: Everything, one player's part alone, or everything else. Part and rest are as loud as they are
            in the whole: together they are the whole.
        player: Whose part, a place in the cast; of no account where everything is heard.
        transposition: Semitones by which all but the drums sounds higher.
    """

    stem: Stem = "all"
    player: int = 0
    transposition: int = 0

    @property
    def is_whole(self) -> bool:
        """Whether it is the score as it is."""
        return self.stem == "all" and self.transposition == 0


AS_WRITTEN = Hearing()


def heard_notes(plan: SoundPlan, parts: Sequence[int], stem: Stem) -> NDArray[np.bool_]:
    """Return which of a plan's notes are heard, (N,).

    Args:
        plan: The whole.
        parts: The player's parts.
        stem: What is heard of it.
    """
    if stem == "all":
        return np.ones(len(plan.notes), dtype=np.bool_)
    own = np.isin(plan.parts, parts)
    return own if stem == "part" else ~own


def only_heard(passages: Sequence[Passage], heard: NDArray[np.bool_]) -> list[Passage]:
    """Leave out of passages the notes that are not heard, (N,); those where none is left are silent.

    The passages are those of the whole, so that what is heard of one is just its share of it.
    """
    left = [
        Passage(one.port, one.start, one.end, one.length, one.notes[heard[one.notes]]) for one in passages
    ]
    return [passage for passage in left if len(passage.notes)]
