"""A skeleton's motion as the text of a BVH file, block by block."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from reina.errors import InputError
from reina.performance import BLOCK_FRAMES
from reina.skeleton import bvh_head, bvh_rows, clip_of_motion

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from reina.sessions.production import Production
    from reina.skeleton import MotionClip


def player_skeleton(production: Production, player: int) -> str:
    """Name of the skeleton that is a player's body.

    Args:
        production: What is played.
        player: The player's place in the cast, the first being 0.

    Raises:
        InputError: So many do not play.
    """
    count = len(production.cast.castings)
    if not 0 <= player < count:
        told = (
            f"there are players 0 to {count - 1}, not {player}"
            if count > 1
            else f"only player 0 plays, not {player}"
        )
        raise InputError(told, location="player")
    return production.performers[player].skeletons[0].name


class BvhExport:
    """Frames `first` ... `end` - 1 of one skeleton; the same frames as the stream's, in metres and degrees.

    Angles go on from block to block without turns of 360°.

    Args:
        production: What is played, at the export's rate.
        skeleton: The skeleton's name in the frame: ``player``.
        first: The first frame.
        end: The frame before which it ends.
        angles: `angles` of another that has written the blocks before.

    Raises:
        InputError: There is no such skeleton.
    """

    def __init__(
        self,
        production: Production,
        skeleton: str,
        first: int,
        end: int,
        *,
        angles: NDArray[np.float64] | None = None,
    ) -> None:
        layouts = production.performance.layout.skeletons
        names = [layout.name for layout in layouts]
        if skeleton not in names:
            raise InputError(f"the skeletons are {', '.join(names)}, not {skeleton!r}", location="skeleton")
        self._performance = production.performance
        self._index = names.index(skeleton)
        self._skeleton = production.stage.rigs[layouts[self._index].rig].skeleton
        start = sum(len(layout.joints) for layout in layouts[: self._index])
        self._joints = slice(start, start + len(layouts[self._index].joints))
        self._first, self._end = first, end
        self.angles = angles
        """Of the last frame that was written, degrees: those that follow go on from there."""

    @property
    def blocks(self) -> range:
        """The aligned blocks of frames that it takes in, for `text`."""
        last = max(self._first, self._end - 1)
        return range(self._first // BLOCK_FRAMES, last // BLOCK_FRAMES + 1)

    def text(self, block: int) -> str:
        """The lines of a block's frames, behind the head of the file for the first; to be called in order."""
        clip = self._clip(block)
        head = bvh_head(clip, self._end - self._first) if block == self.blocks.start else ""
        return head + bvh_rows(clip)

    def _clip(self, block: int) -> MotionClip:
        frames = self._performance.evaluate(block)
        begin = block * BLOCK_FRAMES
        inside = slice(max(self._first - begin, 0), max(self._end - begin, 0))
        clip = clip_of_motion(
            self._skeleton,
            frames.rotations[inside, self._joints].astype(np.float64),
            frames.root_positions[inside, self._index].astype(np.float64),
            1.0 / frames.fps,
        )
        if not len(clip):
            return clip
        values: NDArray[np.float64] = clip.values.copy()
        if self.angles is not None:  # behind the root's position
            values[:, 3:] += 360.0 * np.round((self.angles - values[0, 3:]) / 360.0)
        self.angles = values[-1, 3:]
        return replace(clip, values=values)
