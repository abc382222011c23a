"""Where every joint is: world transforms from local rotations."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.rotations import multiply, rotate

if TYPE_CHECKING:
    from reina.rotations.arrays import ArrayLike, FloatArray
    from reina.skeleton.skeleton import Skeleton


def forward_kinematics(
    skeleton: Skeleton, rotations: ArrayLike, root_positions: ArrayLike | None = None
) -> tuple[FloatArray, FloatArray]:
    """World positions and rotations of all joints, for any number of frames at once.

    A joint's world transform is its parent's, then its rest translation (the link), then its local rotation
    (the joint). The root's translation is given by the frame: a floating base.

    Args:
        skeleton: J joints.
        rotations: Local rotations, rest included, ``(..., J, 4)``.
        root_positions: The root in the world, metres, ``(..., 3)``; its rest translation where None.

    Returns:
        World positions ``(..., J, 3)``, metres, and world rotations ``(..., J, 4)``.
    """
    local = np.asarray(rotations, dtype=np.float64)
    if local.shape[-2:] != (len(skeleton), 4):
        raise ValueError(
            f"{len(skeleton)} joints need rotations (..., {len(skeleton)}, 4), not {local.shape}"
        )
    root = (
        skeleton.rest_translations[0]
        if root_positions is None
        else np.asarray(root_positions, dtype=np.float64)
    )
    world_rotations = np.empty(local.shape)
    world_positions = np.empty((*local.shape[:-1], 3))
    world_rotations[..., 0, :] = local[..., 0, :]
    world_positions[..., 0, :] = root
    for joints in skeleton.levels[1:]:
        parents = skeleton.parents[joints]
        parent_rotations = world_rotations[..., parents, :]
        world_rotations[..., joints, :] = multiply(parent_rotations, local[..., joints, :])
        links = rotate(parent_rotations, skeleton.rest_translations[joints])
        world_positions[..., joints, :] = world_positions[..., parents, :] + links
    return world_positions, world_rotations
