"""The mute in the bell: where the score asks for a muted trumpet, or as a show has it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.curves import Parameter

if TYPE_CHECKING:
    from reina.curves import ParameterRegistry
    from reina.instruments.played import Line
    from reina.music.score import Score
    from reina.rotations.arrays import FloatArray

MUTED_TRUMPET = 59
"""General MIDI's program, counted from 0."""

CHOICES = ("as_scored", "open", "straight")

MUTE_CHOICE = Parameter(
    path="player/mute",
    type="choice",
    default="as_scored",
    choices=CHOICES,
    blend=False,
    documentation="Which mute is in the bell: what the score asks for (program 59), none, or a straight one.",
)


def mute_parameter(instrument: str) -> Parameter:
    """What every frame holds of an instrument's mute."""
    return Parameter(
        path=f"{instrument}/mute",
        type="boolean",
        default=False,
        blend=False,
        documentation="Whether the mute is in the bell.",
    )


class Mute:
    """Whether the mute is in, at any times: a pure function of score and show.

    It goes in and out at the end of the last note before one of another program, while nothing sounds.

    Args:
        score: The programs of its notes ask for the mute, whatever channel they come on.
        line: The notes that are played.
        registry: The show's parameters; where `MUTE_CHOICE` is not among them the score decides.
        prefix: What the player's paths begin with.
    """

    def __init__(self, score: Score, line: Line, registry: ParameterRegistry, prefix: str = "") -> None:
        muted = score.notes.program[line.note_index] == MUTED_TRUMPET
        changes = np.flatnonzero(np.diff(muted)) + 1
        self._from_s: FloatArray = np.concatenate(([0.0], line.end_s[changes - 1]))
        # Of a line without notes, too, there is a beginning.
        begins = muted[:1] if len(muted) else [False]
        self._scored: FloatArray = np.concatenate((begins, muted[changes])).astype(np.float64)
        path = prefix + MUTE_CHOICE.path
        self._column = registry.layout()[path][0] if path in registry else None

    def evaluate(self, times_s: FloatArray, shown: FloatArray) -> FloatArray:
        """0 away, 1 in the bell, ``(F,)``, from song times ``(F,)`` and a show's values ``(F, P)``."""
        change = np.searchsorted(self._from_s, times_s, side="right") - 1
        scored = self._scored[np.maximum(change, 0)]
        if self._column is None:
            return scored
        choice = shown[:, self._column]
        return np.where(choice == 0.0, scored, choice == CHOICES.index("straight"))
