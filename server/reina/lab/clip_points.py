"""A motion clip as points in the world, joints and end sites, frame by frame."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from reina.rotations import multiply, rotate

if TYPE_CHECKING:
    from reina.rotations.arrays import FloatArray, IntArray
    from reina.skeleton import MotionClip

MAX_POINTS = 1_000_000
"""Points of all frames together; a longer clip is thinned."""


@dataclass(frozen=True, eq=False)
class ClipPoints:
    """Where everything is.

    Attributes:
        names: P names; an end site is called by its joint's name with `` end`` behind it.
        parents: The point that each hangs from, ``(P,)``; -1 for the root.
        joints: The joint that each is or belongs to, ``(P,)``; joints come first, in their order.
        positions: In the file's unit, ``(F, P, 3)``; one frame at rest of a clip that has none.
        frame_step: Every frame_step-th frame of the clip is there.
    """

    names: tuple[str, ...]
    parents: IntArray
    joints: IntArray
    positions: FloatArray
    frame_step: int


def clip_points(clip: MotionClip, most_points: int = MAX_POINTS) -> ClipPoints:
    """Forward kinematics of a clip, position channels of any joint included.

    Args:
        clip: The clip.
        most_points: Frames are left out evenly until there are no more points than this; one frame stays.
    """
    clip = clip if len(clip) else clip.at_rest()
    sites = [(joint, site) for joint, ends in enumerate(clip.end_sites) for site in ends]
    count = len(clip.names) + len(sites)
    step = max(1, -(-len(clip) * count // most_points))
    rotations, translations = replace(clip, values=clip.values[::step]).motion()
    frames = len(rotations)
    positions = np.empty((frames, count, 3))
    world = np.empty_like(rotations)
    for joint, parent in enumerate(clip.parents.tolist()):
        if parent < 0:
            world[:, joint] = rotations[:, joint]
            positions[:, joint] = translations[:, joint]
        else:
            world[:, joint] = multiply(world[:, parent], rotations[:, joint])
            positions[:, joint] = positions[:, parent] + rotate(world[:, parent], translations[:, joint])
    for index, (joint, site) in enumerate(sites, start=len(clip.names)):
        positions[:, index] = positions[:, joint] + rotate(world[:, joint], np.array(site))
    holders = [joint for joint, _ in sites]
    return ClipPoints(
        names=clip.names + tuple(f"{clip.names[joint]} end" for joint in holders),
        parents=np.concatenate([clip.parents, np.array(holders, dtype=np.intp)]),
        joints=np.concatenate([np.arange(len(clip.names)), np.array(holders, dtype=np.intp)]),
        positions=positions,
        frame_step=step,
    )
