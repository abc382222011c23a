"""One frame of a motion file as a person's pose: how trunk and legs are turned, whatever skeleton it has."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.rotations import conjugate, cross, from_axis_angle, from_matrix, multiply, rotate
from reina.skeleton.errors import PoseError
from reina.skeleton.joint_aliases import humanoid_name

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.rotations.arrays import FloatArray
    from reina.skeleton.motion_clip import MotionClip

TRUNK: tuple[str, ...] = ("hips", "spine", "chest", "upperChest")
LEGS: tuple[str, ...] = tuple(
    f"{side}{bone}" for side in ("left", "right") for bone in ("UpperLeg", "LowerLeg", "Foot")
)
POSED: tuple[str, ...] = (*TRUNK, *LEGS)
"""What a pose says of a person, parents first."""

STEEPEST = np.radians(60.0)
"""No thigh of a rest pose is further from hanging down; in no pose are the hips further from upright."""
_STRAIGHT = 0.94
"""How near a rest pose's way up or ahead is to an axis to be that axis: a cosine, 20°."""
_MOST_LISTED = 40


@dataclass(frozen=True, eq=False)
class HumanPose:
    """A person's pose without its place, its size and the way that it faces.

    Attributes:
        turns: How each of `POSED` is turned from a person who stands upright with legs straight down and
            looks ahead: a rotation in the world (+x the person's left, +y up, +z ahead), ``(4,)``.
    """

    turns: dict[str, FloatArray]


def human_pose(clip: MotionClip, time_s: float) -> HumanPose:
    """The pose in a clip's frame at a time; the nearest frame counts.

    Each joint's turn is that from the clip's rest pose (all rotations 0), about the axes in which that pose
    stands; a thigh or shin that does not hang straight down in it is taken as it points. Turned about the
    vertical so that the hips face ahead. Lengths do not matter, so neither does the file's unit. The spine is
    what lies between hips and neck, whatever it is called and however many joints it has.

    Args:
        clip: The motion.
        time_s: Seconds from its first frame.

    Raises:
        PoseError: A joint is not there, the clip has no such time, or nobody stands in it.
    """
    frame = _frame(clip, time_s)
    joints = _joints(clip)
    one = clip.values[frame : frame + 1]
    rotations, translations = type(clip)(
        clip.names, clip.parents, clip.offsets, clip.end_sites, clip.channels, one, clip.frame_time_s
    ).motion()
    # Position channels may give bones the lengths that their offsets leave out.
    links = np.where(np.abs(clip.offsets).max(axis=1, keepdims=True) > 0.0, clip.offsets, translations[0])
    at_rest = np.zeros_like(links)
    turned = np.empty((len(clip.names), 4))
    for joint, parent in enumerate(clip.parents.tolist()):
        at_rest[joint] = links[joint] + (at_rest[parent] if joint else 0.0)
        turned[joint] = multiply(turned[parent], rotations[0, joint]) if joint else rotations[0, 0]
    stands = _standing(at_rest, joints)
    world = {
        name: multiply(multiply(conjugate(stands), turned[joint]), stands) for name, joint in joints.items()
    }
    for side in ("left", "right"):
        for bone, end in (("UpperLeg", "LowerLeg"), ("LowerLeg", "Foot")):
            along = at_rest[joints[side + end]] - at_rest[joints[side + bone]]
            hangs = _onto_down(rotate(conjugate(stands), along), clip.names[joints[side + bone]])
            world[side + bone] = multiply(world[side + bone], hangs)
    ahead = rotate(world["hips"], np.array([0.0, 0.0, 1.0]))
    if rotate(world["hips"], np.array([0.0, 1.0, 0.0]))[1] < np.cos(STEEPEST):
        raise PoseError(
            "nobody stands in this frame, its hips lie on their side or back; choose one of somebody upright",
            location=f"{frame * clip.frame_time_s:.2f} s",
        )
    facing = from_axis_angle(np.array([0.0, 1.0, 0.0]), -np.arctan2(ahead[0], ahead[2]))
    return HumanPose({name: multiply(facing, world[name]) for name in POSED})


def _frame(clip: MotionClip, time_s: float) -> int:
    if len(clip) == 0:
        raise PoseError("the file has no frames, so there is no pose in it")
    frame = round(time_s / clip.frame_time_s)
    if not 0 <= frame < len(clip):
        last = (len(clip) - 1) * clip.frame_time_s
        detail = f"there is no frame; the file has them from 0 to {last:.2f} s"
        raise PoseError(detail, location=f"{time_s:g} s")
    return frame


def _joints(clip: MotionClip) -> dict[str, int]:
    """The joint of each of `POSED`, and of the neck as ``top``; the first of a name counts."""
    named: dict[str, int] = {}
    for joint, name in enumerate(clip.names):
        meant = humanoid_name(name)
        if meant is not None:
            named.setdefault(meant, joint)
    top = named.get("neck", named.get("head"))
    missing = [name for name in LEGS if name not in named]
    missing += [] if top is not None else ["neck or head"]
    if missing or top is None:
        more = f" and {len(clip.names) - _MOST_LISTED} more" if len(clip.names) > _MOST_LISTED else ""
        known = ", ".join(clip.names[:_MOST_LISTED]) + more
        raise PoseError(f"the file has no joint for {', '.join(missing)}; its joints are {known}")
    above = _way(clip, top)
    shared = set(_way(clip, named["leftUpperLeg"])) & set(_way(clip, named["rightUpperLeg"])) & set(above)
    if not shared:
        raise PoseError("legs and head of the figure hang on no joint together, so it has no hips")
    hips = named.get("hips", -1)
    hips = hips if hips in shared else max(shared, key=above.index)
    spine = above[above.index(hips) + 1 :] or [hips]
    return {
        "hips": hips,
        "spine": spine[0],
        "chest": spine[round((len(spine) - 1) / 2)],
        "upperChest": spine[-1],
        "top": top,
        **{name: named[name] for name in LEGS},
    }


def _way(clip: MotionClip, joint: int) -> list[int]:
    """From the root down to a joint's parent."""
    way: list[int] = []
    parent = int(clip.parents[joint])
    while parent >= 0:
        way.append(parent)
        parent = int(clip.parents[parent])
    return way[::-1]


def _standing(at_rest: FloatArray, joints: dict[str, int]) -> FloatArray:
    """The turn from a person's axes to those of a rest pose, ``(4,)``."""
    hips = 0.5 * (at_rest[joints["leftUpperLeg"]] + at_rest[joints["rightUpperLeg"]])
    feet = 0.5 * (at_rest[joints["leftFoot"]] + at_rest[joints["rightFoot"]])
    left = at_rest[joints["leftUpperLeg"]] - at_rest[joints["rightUpperLeg"]]
    up = _unit(hips - feet, "a hip is where a foot is")
    left = _unit(left - up * (left @ up), "both thighs begin at one place")
    up, left = _nearest_axis(up), _nearest_axis(left)
    if _unit(at_rest[joints["top"]] - hips, "the neck is where the hips are") @ up < np.cos(STEEPEST):
        raise PoseError(
            "in the file's rest pose, all rotations 0, the head is not above the hips and the legs below; "
            "export it with a rest pose that stands, such as a T-pose"
        )
    left = _unit(left - up * (left @ up), "both thighs begin at one place")
    return from_matrix(np.stack([left, up, cross(left, up)], axis=-1))


def _nearest_axis(direction: FloatArray) -> FloatArray:
    """A rest pose stands along the axes, however its bones lean; unless it plainly does not."""
    largest = int(np.argmax(np.abs(direction)))
    if abs(direction[largest]) < _STRAIGHT:
        return direction
    return np.sign(direction[largest]) * np.eye(3)[largest]


def _onto_down(along: FloatArray, name: str) -> FloatArray:
    """The shortest turn from straight down to where a bone points in the rest pose."""
    bone = _unit(along, "a bone of its legs has no length")
    down = np.array([0.0, -1.0, 0.0])
    axis, cosine = cross(down, bone), float(np.clip(down @ bone, -1.0, 1.0))
    if np.arccos(cosine) > STEEPEST:
        raise PoseError(
            "in the file's rest pose, all rotations 0, the legs do not hang down; export it with a rest "
            "pose that stands, such as a T-pose",
            location=name,
        )
    sine = float(np.linalg.norm(axis))
    if sine < 1e-9:
        return np.array([0.0, 0.0, 0.0, 1.0])
    return from_axis_angle(axis / sine, float(np.arccos(cosine)))


def _unit(vector: FloatArray, fault: str) -> FloatArray:
    length = float(np.linalg.norm(vector))
    if length < 1e-9:
        raise PoseError(f"the figure in the file has no size: {fault}")
    return vector / length


def pose_of(turns: Sequence[Sequence[float]]) -> HumanPose:
    """A pose of what `pose_numbers` gave."""
    return HumanPose(dict(zip(POSED, np.asarray(turns, dtype=np.float64), strict=True)))


def pose_numbers(pose: HumanPose) -> list[list[float]]:
    """The turns of `POSED` as numbers, x, y, z, w each."""
    return [pose.turns[name].tolist() for name in POSED]
