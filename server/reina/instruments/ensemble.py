"""The performers of a cast, evaluated together."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.instruments.player.instrument_body import BodyFrames, FigureBody, FramewiseBody
from reina.rotations import BLOCK_FRAMES

if TYPE_CHECKING:
    from collections.abc import Hashable, Sequence

    from reina.instruments.performer import Performer, PerformerFrames
    from reina.instruments.player.instrument_body import BodyMotion, InstrumentBody
    from reina.rotations.arrays import FloatArray


class Ensemble:
    """Who plays at once; players of one figure are posed side by side.

    Args:
        performers: In the cast's order.
    """

    def __init__(self, performers: Sequence[Performer]) -> None:
        self.performers = tuple(performers)
        """Who plays."""
        self._bodies = [
            body if isinstance(body, FigureBody) else None for body in (one.body for one in self.performers)
        ]

    def evaluate(
        self, times_s: FloatArray, shown: FloatArray, stances: Sequence[FloatArray]
    ) -> list[PerformerFrames]:
        """Each performer's frames at song times ``(F,)``.

        Args:
            times_s: Song times, seconds.
            shown: The show's values ``(F, P)``.
            stances: Of each performer, how much of each stance, ``(F, N)``.
        """
        motions = [
            performer.move(times_s, shown, stance)
            for performer, stance in zip(self.performers, stances, strict=True)
        ]
        posed = self._pose([motion.body for motion in motions])
        return [
            performer.finish(pose, motion)
            for performer, pose, motion in zip(self.performers, posed, motions, strict=True)
        ]

    def _pose(self, motions: Sequence[BodyMotion]) -> list[BodyFrames]:
        posed: dict[int, BodyFrames] = {}
        alike: dict[Hashable, list[tuple[int, FigureBody]]] = {}
        for place, (body, motion) in enumerate(zip(self._bodies, motions, strict=True)):
            if body is None:
                posed[place] = _solved(self.performers[place].body, motion)
            else:
                rows = 0 if motion.stance is None else motion.stance.shape[1]
                alike.setdefault((body.figure, rows), []).append((place, body))
        for members in alike.values():
            rotations, roots = members[0][1].pose([motions[place] for place, _ in members])
            for (place, body), own_rotations, own_roots in zip(members, rotations, roots, strict=True):
                posed[place] = BodyFrames(own_rotations, own_roots, body.parameters(motions[place]))
        return [posed[place] for place in range(len(motions))]


def _solved(body: InstrumentBody, motion: BodyMotion) -> BodyFrames:
    """The poses of F frames, block by block unless a body says that it may be asked for many at once."""
    frames = len(motion.times_s)
    framewise = isinstance(body, FramewiseBody) and body.is_framewise
    if framewise or frames <= BLOCK_FRAMES or frames % BLOCK_FRAMES:
        return body.solve(motion)
    starts = range(0, frames, BLOCK_FRAMES)
    solved = [body.solve(motion.rows(slice(first, first + BLOCK_FRAMES))) for first in starts]
    return BodyFrames(
        np.concatenate([one.rotations for one in solved]),
        np.concatenate([one.root_positions for one in solved]),
        np.concatenate([one.parameters for one in solved]),
    )
