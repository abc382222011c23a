"""A performance: what is on screen at any frame, as a pure function of score, cast, show and time."""

from __future__ import annotations

import copy
from typing import TYPE_CHECKING

import numpy as np

from reina.instruments import Ensemble
from reina.instruments.player import StanceChoice
from reina.performance.frame import FrameBlock, FrameLayout
from reina.rotations import BLOCK_FRAMES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.performer import Performer
    from reina.rotations.arrays import FloatArray
    from reina.show import ShowPlan

PLAYERS_BLOCKS_AT_ONCE = 4
"""Of one player so many blocks are gladly evaluated at once, of several as many less."""
TAIL_S = 4.0
"""After the score's end the players settle for so long; then the last frame holds."""


class Performance:
    """A cast that plays under a show.

    Nothing is carried from frame to frame: `evaluate` gives the same bytes for a block whenever it is asked.

    Args:
        performers: Who plays, in the cast's order.
        show_plan: The show, planned over the same score, and its parameters.
        duration_s: Where the score ends.
        fps: Frames a second.
    """

    def __init__(
        self, performers: Sequence[Performer], show_plan: ShowPlan, *, duration_s: float, fps: int = 60
    ) -> None:
        self.performers = tuple(performers)
        """Who plays."""
        self._ensemble = Ensemble(performers)
        self._end_s = duration_s + TAIL_S
        self._direct(show_plan)
        self.layout = FrameLayout(
            fps=fps,
            skeletons=tuple(layout for performer in self.performers for layout in performer.skeletons),
            parameters=(
                *show_plan.registry,
                *(parameter for performer in self.performers for parameter in performer.parameters),
            ),
        )
        """What every frame holds."""

    def _direct(self, show_plan: ShowPlan) -> None:
        self._show_plan = show_plan
        self._stances = [StanceChoice(show_plan, performer.prefix) for performer in self.performers]

    def with_show(self, show_plan: ShowPlan) -> Performance:
        """The same performance under another show over the same registry; everything else is shared."""
        other = copy.copy(self)
        other._direct(show_plan)
        return other

    @property
    def blocks_at_once(self) -> int:
        """How many blocks are gladly evaluated at once: more cost less each, and hold up who waits."""
        return max(1, PLAYERS_BLOCKS_AT_ONCE // max(1, len(self.performers)))

    def evaluate(self, block: int) -> FrameBlock:
        """Frames 60·block to 60·block + 59.

        Raises:
            ValueError: The block is negative.
        """
        return self.evaluate_blocks(block, 1)[0]

    def evaluate_blocks(self, first: int, count: int) -> list[FrameBlock]:
        """Blocks `first` to `first` + `count` - 1, each to the last bit as `evaluate` gives it.

        Several at once cost less each, since a good part of the time is that of calling NumPy at all.

        Raises:
            ValueError: The first block is negative.
        """
        if first < 0:
            raise ValueError(f"blocks are counted from 0, not {first}")
        frames = np.arange(first * BLOCK_FRAMES, (first + count) * BLOCK_FRAMES)
        return self.sample(frames / self.layout.fps, first * BLOCK_FRAMES).blocks()

    def sample(self, song_time_s: FloatArray, first_frame: int = 0) -> FrameBlock:
        """The same function at any song times ``(F,)``, for exports and measurements.

        Floating point differs in its last bit between a block and a row, so what is streamed comes from
        `evaluate`.
        """
        shown, cuts = self._show_plan.evaluate(song_time_s)
        times = np.minimum(song_time_s, self._end_s)
        stances = [stance.weights(times) for stance in self._stances]
        performed = self._ensemble.evaluate(times, shown, stances)
        return FrameBlock(
            first_frame,
            self.layout.fps,
            song_time_s,
            np.concatenate([one.rotations for one in performed], axis=1, dtype=np.float32),
            np.concatenate([one.root_positions for one in performed], axis=1, dtype=np.float32),
            np.concatenate([shown, *(one.parameters for one in performed)], axis=1, dtype=np.float32),
            cuts,
        )
