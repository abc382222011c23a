"""Which stance is stood in when: what a show chooses, with a smooth passage from one to the next."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.instruments.player.stances import STANCES
from reina.kinematics import minimum_jerk
from reina.show import ShowPlan

if TYPE_CHECKING:
    from reina.rotations.arrays import FloatArray, IntArray

PATH = "player/stance"
PASSAGE_S = 1.5
"""From one stance to another a player takes so long, beginning when the show says."""

GRID_FPS = 60
"""Choices are read on this grid, whatever the frame rate."""

_IN_A_ROW = 1000
"""Times no further apart than so many ticks are read as one row."""


class StanceChoice:
    """Weights of the stances at any times, a pure function of the show.

    A choice steps, a body does not: the weights follow it with minimum jerk over the time before each frame.

    Args:
        show_plan: The show; where it has no `PATH` the first of `STANCES` is chosen, and there are no others.
        prefix: What the player's paths begin with.
    """

    def __init__(self, show_plan: ShowPlan, prefix: str = "") -> None:
        registry, path = show_plan.registry, prefix + PATH
        track = show_plan.tracks.get(path)
        self._column = registry.layout()[path][0] if path in registry else None
        self._count = len(registry[path].choices) if path in registry else len(STANCES)
        self._steady = 0 if self._column is None else int(registry.defaults()[self._column])
        self._plan = (
            None
            if track is None
            else ShowPlan((track,), registry, show_plan.time_map, triggers=show_plan.triggers, fps=GRID_FPS)
        )
        done = minimum_jerk(np.arange(int(PASSAGE_S * GRID_FPS) + 1) / (PASSAGE_S * GRID_FPS))
        self._steps: FloatArray = np.diff(done)

    def weights(self, times_s: FloatArray) -> FloatArray:
        """``(F, how many stances there are)``, each row's sum 1."""
        if self._plan is None or self._column is None:
            chosen = np.zeros((len(times_s), self._count))
            chosen[:, self._steady] = 1.0
            return chosen
        tick = np.floor(times_s * GRID_FPS + 1e-6).astype(np.int64)[:, None]
        asked = tick - np.arange(len(self._steps))
        first, last = int(asked.min()), int(asked.max())
        read: IntArray = np.arange(first, last + 1) if last - first <= _IN_A_ROW else np.unique(asked)
        place = asked - first if len(read) > last - first else np.searchsorted(read, asked)
        values, _ = self._plan.evaluate(np.maximum(read, 0) / GRID_FPS)
        chosen = values[:, self._column].astype(np.int64)
        whole = np.eye(self._count)
        if np.all(chosen == chosen[0]):
            return np.broadcast_to(whole[chosen[0]], (len(times_s), self._count))
        passed = chosen[place].reshape(asked.shape)
        mixed = np.einsum("t,ftc->fc", self._steps, whole[passed])
        # Where nothing changes there is the whole of one, whatever else is asked for beside it.
        steady = np.all(passed == passed[:, :1], axis=1)
        return np.where(steady[:, None], whole[passed[:, 0]], mixed)
