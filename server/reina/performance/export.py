"""A performance as a motion clip, for programs that read BVH."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.performance.frame import BLOCK_FRAMES
from reina.skeleton import MotionClip, clip_of_motion

if TYPE_CHECKING:
    from reina.performance.performance import Performance
    from reina.skeleton import Rig


def performance_clip(performance: Performance, player_rig: Rig, first_frame: int, frames: int) -> MotionClip:
    """The player's motion over some frames, with the same world positions as the frames have.

    Args:
        performance: The performance; its frame rate is the clip's.
        player_rig: The rig that it was made with.
        first_frame: The clip's first frame, from 0.
        frames: How many, at least one.

    Raises:
        ValueError: The span begins before 0 or is empty.
    """
    if first_frame < 0 or frames < 1:
        raise ValueError(f"a clip needs frames from 0 on, not {frames} from {first_frame}")
    first_block = first_frame // BLOCK_FRAMES
    last_block = (first_frame + frames - 1) // BLOCK_FRAMES
    blocks = [performance.evaluate(block) for block in range(first_block, last_block + 1)]
    span = slice(first_frame - first_block * BLOCK_FRAMES, first_frame - first_block * BLOCK_FRAMES + frames)
    joints = len(player_rig.skeleton)
    rotations = np.concatenate([block.rotations[:, :joints] for block in blocks])[span].astype(np.float64)
    roots = np.concatenate([block.root_positions[:, 0] for block in blocks])[span].astype(np.float64)
    return clip_of_motion(player_rig.skeleton, rotations, roots, 1.0 / performance.layout.fps)
