"""Motion from one skeleton to another, by the turns from their rest poses; loops and blends of motion."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.rotations import conjugate, exp, log, multiply, rotate, slerp
from reina.skeleton.forward_kinematics import forward_kinematics
from reina.skeleton.joint_aliases import humanoid_name
from reina.skeleton.motion_clip import MotionClip

if TYPE_CHECKING:
    from collections.abc import Mapping

    from reina.rotations.arrays import ArrayLike, FloatArray
    from reina.skeleton.skeleton import Skeleton


def clip_of_motion(
    skeleton: Skeleton, rotations: ArrayLike, root_positions: ArrayLike, frame_time_s: float
) -> MotionClip:
    """A clip that any BVH reader shows with the same world positions.

    BVH knows no rest rotation, so that all frames at rest stand along the world's axes; a joint's turn in
    the clip is how its turn from rest differs from its parent's.

    Args:
        skeleton: J joints.
        rotations: Local, rest included, ``(F, J, 4)``.
        root_positions: ``(F, 3)``, metres.
        frame_time_s: Seconds from frame to frame.
    """
    rest_positions, rest_world = forward_kinematics(skeleton, skeleton.rest_rotations)
    _, world = forward_kinematics(skeleton, rotations, root_positions)
    turned = multiply(world, conjugate(rest_world))
    parents = np.maximum(skeleton.parents, 0)
    local = multiply(conjugate(turned[:, parents]), turned)
    local[:, 0] = turned[:, 0]
    offsets = rest_positions - rest_positions[parents]
    offsets[0] = 0.0
    return MotionClip.from_motion(
        skeleton.names,
        skeleton.parents,
        offsets,
        local,
        np.asarray(root_positions, dtype=np.float64),
        frame_time_s,
    )


def retarget(
    clip: MotionClip, skeleton: Skeleton, names: Mapping[str, str] | None = None
) -> tuple[FloatArray, FloatArray]:
    """A clip's motion on another skeleton.

    Both rest poses are taken to be the same stance. Each joint of the skeleton that has a partner turns
    from its rest as the partner does from its own, in the world; one that has none goes with its parent.
    The root's way is scaled by the length of the legs, by the height of the hips where the clip has none.
    The clip's floor is at 0 where its hips are about as high as they stand; else under its rest pose.

    Args:
        clip: The motion.
        skeleton: Whom to move: J joints with VRM names.
        names: The clip's joint names to the skeleton's; by `humanoid_name` where None.

    Returns:
        Local rotations, rest included, ``(F, J, 4)``, and root positions ``(F, 3)``, metres.
    """
    rotations, translations = clip.motion()
    turned = np.empty(rotations.shape)
    for joint, parent in enumerate(clip.parents.tolist()):
        turned[:, joint] = multiply(turned[:, parent], rotations[:, joint]) if joint else rotations[:, 0]
    partner: dict[str, int] = {}
    for joint, name in enumerate(clip.names):
        found = humanoid_name(name) if names is None else names.get(name)
        if found is not None and found not in partner:
            partner[found] = joint
    _, rest_world = forward_kinematics(skeleton, skeleton.rest_rotations)
    world = np.empty((len(clip), len(skeleton), 4))
    local = np.empty(world.shape)
    turn = np.empty(world.shape)
    for joint, parent in enumerate(skeleton.parents.tolist()):
        above = turn[:, parent] if joint else np.array([0.0, 0.0, 0.0, 1.0])
        name = skeleton.names[joint]
        turn[:, joint] = turned[:, partner[name]] if name in partner else above
        world[:, joint] = multiply(turn[:, joint], rest_world[joint])
        local[:, joint] = multiply(conjugate(world[:, parent]), world[:, joint]) if joint else world[:, 0]
    root = partner.get(skeleton.names[0], 0)
    way = translations[:, 0]
    for joint in _path(clip, root)[1:]:
        way = way + rotate(turned[:, clip.parents[joint]], translations[:, joint])
    # Position channels may give bones the lengths that their offsets leave out.
    links = np.median(translations, axis=0) if len(clip) else clip.offsets
    height = _hip_height(clip, links, root)
    floor = _floor(clip, root, way, height)
    return local, (way - [0.0, floor, 0.0]) * _scale(links, skeleton, partner, height)


def _path(clip: MotionClip, joint: int) -> list[int]:
    path = [joint]
    while clip.parents[path[-1]] >= 0:
        path.append(int(clip.parents[path[-1]]))
    return path[::-1]


def _floor(clip: MotionClip, root: int, way: FloatArray, height: float) -> float:
    """The height of the floor in a clip: some files move the hips from the floor, some from their rest."""
    if len(way) == 0 or float(np.median(way[:, 1])) > 0.5 * height:
        return 0.0
    held = [joint for joint in _path(clip, root) if "Yposition" not in clip.channels[joint]]
    return float(sum(clip.offsets[joint, 1] for joint in held)) - height


def _scale(links: FloatArray, skeleton: Skeleton, partner: Mapping[str, int], height: float) -> float:
    """How much longer the skeleton's legs are than the clip's, whose hips are at a height."""
    legs = [f"{side}{bone}" for side in ("left", "right") for bone in ("LowerLeg", "Foot")]
    if all(name in partner and name in skeleton for name in legs):
        own = [skeleton.rest_translations[skeleton.index(name)] for name in legs]
        theirs = [links[partner[name]] for name in legs]
        length = float(np.linalg.norm(theirs, axis=1).sum())
        if length > 0.0:
            return float(np.linalg.norm(own, axis=1).sum()) / length
    return float(skeleton.rest_translations[0, 1]) / height if height > 0.0 else 1.0


def _hip_height(clip: MotionClip, links: FloatArray, root: int) -> float:
    """How far the lowest point of the clip's rest pose is below its hips."""
    heights = np.zeros(len(clip.names))
    lowest = 0.0
    for joint, parent in enumerate(clip.parents.tolist()):
        heights[joint] = (heights[parent] if joint else 0.0) + links[joint, 1]
    for joint, sites in enumerate(clip.end_sites):
        below = min([0.0, *(site[1] for site in sites)])
        lowest = min(lowest, heights[joint] + below - heights[root])
    return -lowest


def looped(rotations: ArrayLike, blend_frames: int) -> FloatArray:
    """Motion ``(F, J, 4)`` whose last frame is its first: what they differ by is taken back along the end.

    Args:
        rotations: Local rotations.
        blend_frames: Over how many of the last frames.

    Raises:
        ValueError: The motion has not so many frames.
    """
    motion = np.asarray(rotations, dtype=np.float64)
    if not 0 < blend_frames <= len(motion):
        raise ValueError(f"a clip of {len(motion)} frames cannot be blended over {blend_frames}")
    share = np.clip((np.arange(len(motion)) - (len(motion) - 1 - blend_frames)) / blend_frames, 0.0, 1.0)
    share = share * share * (3.0 - 2.0 * share)
    back = log(multiply(conjugate(motion[-1]), motion[0]))
    return multiply(motion, exp(share[:, None, None] * back))


def blended(first: ArrayLike, second: ArrayLike, weight: ArrayLike) -> FloatArray:
    """Two motions ``(F, J, 4)`` blended joint by joint; weight ``(F,)`` or a number, 0 first, 1 second."""
    share = np.asarray(weight, dtype=np.float64)
    return slerp(first, second, share[..., None] if share.ndim else share)
