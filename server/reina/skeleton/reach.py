"""How far from each joint something hangs that turns with it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.skeleton.forward_kinematics import forward_kinematics

if TYPE_CHECKING:
    from reina.rotations.arrays import FloatArray
    from reina.skeleton.rig import Rig


def reaches(rig: Rig) -> FloatArray:
    """The greatest distance from each joint to what it turns, in rest pose, metres, ``(J,)``.

    What it turns: the joints below it, effectors and contacts, and the ends of solid parts. A joint that is
    off by an angle moves nothing by more than this distance times it.
    """
    skeleton = rig.skeleton
    at, _ = forward_kinematics(skeleton, skeleton.rest_rotations)
    # A point's distance from its own joint is the same in every pose; on the way up it only adds.
    farthest = np.zeros(len(skeleton))
    for joint, offset in _points(rig):
        farthest[joint] = max(farthest[joint], float(np.linalg.norm(offset)))
    for joint in range(len(skeleton) - 1, 0, -1):
        parent = int(skeleton.parents[joint])
        link = float(np.linalg.norm(at[joint] - at[parent]))
        farthest[parent] = max(farthest[parent], link + farthest[joint])
    return farthest


def _points(rig: Rig) -> list[tuple[int, FloatArray]]:
    named = [(point.joint, point.offset) for point in (*rig.effectors.values(), *rig.contacts.values())]
    solid = [(part.joint, end) for part in (*rig.capsules, *rig.cylinders) for end in (part.start, part.end)]
    return [*named, *solid]
