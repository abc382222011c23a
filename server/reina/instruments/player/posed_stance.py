"""A person's pose as a way of standing with an instrument."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.instruments.player.body_table import TRUNK
from reina.kinematics import clamp_to_limits
from reina.rotations import IDENTITY, conjugate, cross, exp, from_axis_angle, log, multiply, rotate
from reina.skeleton import Limits, forward_kinematics

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.player.held_pose import HeldPose
    from reina.rotations.arrays import FloatArray
    from reina.skeleton import HumanPose, Rig

SIDES = ("left", "right")
ROOM_RAD = np.radians(10.0)
"""So far within the limits of its joints a pose keeps the trunk, for gestures that turn it further."""
Pairs = tuple[tuple[float, float], ...]
THIGH_RAD: Pairs = ((-0.95, 0.45), (-0.5, 0.5), (-0.3, 0.3))
"""How far thighs turn about x (forward is negative), y and z at most, before `ROOM_RAD`: as far as what
players wear goes along with."""
AIM_RAD = 0.25
"""How far neck and head tip back at most, so that the player plays as level as in the hold. Sideways they go
with the chest: the wrists bear no more."""
CLOSED_M = 0.04
"""How far, in height, the limits may take a leg from its pose for its foot to be brought back to it."""
NEAR_FLOOR_M = 0.05
"""A foot that a pose has no higher than this above the other stands on the floor too."""
HEEL_M = 0.055
TOE_M = 0.07
"""How far a shoe reaches behind the ankle and ahead of the toes' joint."""
BEND = 0.2
"""A knee bent by more than about so many radians says itself which way it points; else the thigh does."""


@dataclass(frozen=True, eq=False)
class PosedStance:
    """What a pose changes of the playing position.

    Attributes:
        turns: Rotation vectors of `TRUNK`'s joints, as far as the rig has them, in their own frames,
            ``(J, 3)``.
        hips: Shift of the hips, metres, ``(3,)``.
        feet: Shift of the ankles, left and right, metres, ``(2, 3)``.
        feet_turns: Rotation vectors of the feet about the world's axes, ``(2, 3)``.
        knees: What is added to the directions of the knees' hinges, ``(2, 3)``.
    """

    turns: FloatArray
    hips: FloatArray
    feet: FloatArray
    feet_turns: FloatArray
    knees: FloatArray

    @property
    def row(self) -> FloatArray:
        """All of it, ``(J + 7, 3)``: turns, hips, feet, their turns, knees."""
        return np.concatenate([self.turns, self.hips[None], self.feet, self.feet_turns, self.knees])


def retarget_pose(pose: HumanPose, rig: Rig, held: HeldPose) -> PosedStance:
    """A person's pose on a player who holds an instrument.

    Hips, spine and legs turn from the rig's rest pose as the person's do from theirs, the spine within its
    limits. The lower foot stands on the floor, and so the hips are as high as the player's own legs have
    them; both feet together stand where they do in the hold, and the hips face as there. Head and neck go
    with the chest, and tip back by `AIM_RAD` at most towards the level of the hold; arms and instrument are
    left to the solvers.

    Args:
        pose: The pose.
        rig: The player's rig.
        held: The playing position.
    """
    skeleton = rig.skeleton
    local = _local(pose, rig, held, within_limits=True)
    places, turned = forward_kinematics(skeleton, local, np.zeros(3))
    feet = np.array([skeleton.index(f"{side}Foot") for side in SIDES])
    # How high the feet are above the floor the pose says; a limited leg does not lift its foot off it.
    free = forward_kinematics(skeleton, _local(pose, rig, held, within_limits=False), np.zeros(3))
    above_floor = _soles(rig, *free)
    above_floor = above_floor - above_floor.min()
    above_floor[above_floor < NEAR_FLOOR_M] = 0.0
    wanted = _soles(rig, held.positions, held.world).min() + above_floor
    heights = wanted - _soles(rig, places, turned)
    root = (held.positions[feet] - places[feet]).mean(axis=0)
    # Two legs that the limits have made unequal share the difference.
    root[1] = heights.max() - min(0.5 * np.ptp(heights), CLOSED_M)
    ankles = places[feet] + root
    ankles[:, 1] += np.maximum(heights - root[1], -CLOSED_M)
    trunk = [skeleton.index(name) for name in TRUNK if name in skeleton]
    turns = log(multiply(conjugate(held.rotations[trunk]), local[trunk]))
    return PosedStance(
        turns=turns,
        hips=root - held.root,
        feet=ankles - held.positions[feet],
        feet_turns=log(multiply(turned[feet], conjugate(held.world[feet]))),
        knees=np.stack([_axis(rig, side, turned) for side in SIDES])
        - np.stack([_axis(rig, side, held.world) for side in SIDES]),
    )


def _local(pose: HumanPose, rig: Rig, held: HeldPose, *, within_limits: bool) -> FloatArray:
    """Local rotations of all joints in a pose, rest included, ``(J, 4)``; others are as in the hold."""
    skeleton = rig.skeleton
    _, rest_world = forward_kinematics(skeleton, skeleton.rest_rotations)
    facing = _facing(held.world[0], rest_world[0])
    local, world = held.rotations.copy(), held.world.copy()
    for joint, parent in enumerate(skeleton.parents.tolist()):
        name = skeleton.names[joint]
        above = world[parent] if joint else IDENTITY
        if name in pose.turns:
            turned = multiply(multiply(facing, pose.turns[name]), _hung(rig, name, rest_world))
            if name.endswith("UpperLeg"):
                lower = name.replace("Upper", "Lower")
                shin = multiply(multiply(facing, pose.turns[lower]), _hung(rig, lower, rest_world))
                turned = _towards_knee(rig, name, turned, shin)
            bends = name.endswith("LowerLeg")
            local[joint] = _knee(rig, joint, above, turned) if bends else multiply(conjugate(above), turned)
            if within_limits and joint in rig.limits:
                kept = _narrowed(rig.limits[joint], THIGH_RAD if name.endswith("UpperLeg") else None)
                local[joint] = clamp_to_limits(local[joint], skeleton.rest_rotations[joint], kept)
        world[joint] = multiply(above, local[joint])
    _aim(rig, held, local, world)
    return local


def _facing(hips: FloatArray, rest: FloatArray) -> FloatArray:
    """The turn about the vertical that a hold has the hips in, ``(4,)``."""
    ahead = rotate(multiply(hips, conjugate(rest)), np.array([0.0, 0.0, 1.0]))
    return from_axis_angle(np.array([0.0, 1.0, 0.0]), float(np.arctan2(ahead[0], ahead[2])))


def _hung(rig: Rig, name: str, rest_world: FloatArray) -> FloatArray:
    """A joint's rotation in the world at rest; of thighs and shins when they hang straight down."""
    skeleton = rig.skeleton
    joint = skeleton.index(name)
    end = name.replace("UpperLeg", "LowerLeg") if "UpperLeg" in name else name.replace("LowerLeg", "Foot")
    if end == name:
        return rest_world[joint]
    bone = rotate(rest_world[joint], skeleton.rest_translations[skeleton.index(end)])
    bone = bone / np.linalg.norm(bone)
    down = np.array([0.0, -1.0, 0.0])
    axis = cross(bone, down)
    sine = float(np.linalg.norm(axis))
    if sine < 1e-9:
        return rest_world[joint]
    return multiply(from_axis_angle(axis / sine, float(np.arctan2(sine, bone @ down))), rest_world[joint])


def _narrowed(limits: Limits, further: Pairs | None) -> Limits:
    """Limits no wider than others that leave `ROOM_RAD` on both sides, half of what there is at most."""
    pairs = list(zip(limits.minimum, limits.maximum, strict=True))
    if further is not None:
        pairs = [(max(a, c), min(b, d)) for (a, b), (c, d) in zip(pairs, further, strict=True)]
    return Limits(
        limits.order,
        _three([min(low + ROOM_RAD, 0.5 * low) if low < 0.0 else low for low, _ in pairs]),
        _three([max(high - ROOM_RAD, 0.5 * high) if high > 0.0 else high for _, high in pairs]),
    )


def _three(numbers: Sequence[float]) -> tuple[float, float, float]:
    x, y, z = numbers
    return x, y, z


def _aim(rig: Rig, held: HeldPose, local: FloatArray, world: FloatArray) -> None:
    """Tip neck and head up or down towards where the hold has the head, half of it each."""
    skeleton = rig.skeleton
    head = skeleton.index("head")
    back = log(multiply(held.world[head], conjugate(world[head])))
    ahead = _facing(world[0], forward_kinematics(skeleton, skeleton.rest_rotations)[1][0])
    left = rotate(ahead, np.array([1.0, 0.0, 0.0]))
    back = left * float(np.clip(back @ left, -AIM_RAD, AIM_RAD))
    joints = [skeleton.index(name) for name in ("neck", "head") if name in skeleton]
    parent = world[skeleton.parents[joints[0]]]
    for share, joint in enumerate(joints, start=1):
        turned = multiply(exp(back * share / len(joints)), world[joint])
        local[joint] = multiply(conjugate(parent), turned)
        parent = turned


def _soles(rig: Rig, places: FloatArray, turned: FloatArray) -> FloatArray:
    """The heights of both shoes' lowest points, heel, ball or toe, ``(2,)``."""
    skeleton = rig.skeleton
    rest_places, rest_world = forward_kinematics(skeleton, skeleton.rest_rotations)
    heights: list[float] = []
    for side in SIDES:
        foot = skeleton.index(f"{side}Foot")
        along = (rest_places[skeleton.index(f"{side}Toes")] - rest_places[foot]) * [1.0, 0.0, 1.0]
        length = float(np.linalg.norm(along))
        points = np.stack([along * step for step in (-HEEL_M / length, 1.0, 1.0 + TOE_M / length)])
        points[:, 1] = rotate(rest_world[foot], rig.contact(f"{side}Sole").offset)[1]
        moved = rotate(multiply(turned[foot], conjugate(rest_world[foot])), points)
        heights.append(float(places[foot, 1] + moved[:, 1].min()))
    return np.array(heights)


def _axis(rig: Rig, side: str, turned: FloatArray) -> FloatArray:
    """The direction of a knee's hinge as its thigh has it, ``(3,)``."""
    skeleton = rig.skeleton
    lower = skeleton.index(f"{side}LowerLeg")
    hinge = rotate(skeleton.rest_rotations[lower], np.array([1.0, 0.0, 0.0]))
    return rotate(turned[skeleton.parents[lower]], hinge)


def _towards_knee(rig: Rig, name: str, upper: FloatArray, lower: FloatArray) -> FloatArray:
    """A thigh's rotation in the world, turned about itself so that its knee bends to where the shin lies.

    Where the knee is straight, or bent forward, the thigh keeps its turn.

    Args:
        rig: The player's rig.
        name: The thigh's joint.
        upper: The thigh's rotation in the world, ``(4,)``.
        lower: The shin's, ``(4,)``.
    """
    skeleton = rig.skeleton
    side = name.removesuffix("UpperLeg")
    knee, foot = skeleton.index(f"{side}LowerLeg"), skeleton.index(f"{side}Foot")
    along = skeleton.rest_translations[foot]
    hinge = rotate(skeleton.rest_rotations[knee], np.array([1.0, 0.0, 0.0]))
    thigh = skeleton.rest_translations[knee] / np.linalg.norm(skeleton.rest_translations[knee])
    shin = rotate(conjugate(upper), rotate(lower, along / np.linalg.norm(along)))
    across = hinge - thigh * (hinge @ thigh)
    lies = cross(thigh, shin)
    wanted = BEND * across + lies if lies @ across > 0.0 else across
    twist = np.arctan2(cross(across, wanted) @ thigh, across @ wanted)
    return multiply(upper, from_axis_angle(thigh, float(twist)))


def _knee(rig: Rig, joint: int, upper: FloatArray, lower: FloatArray) -> FloatArray:
    """A knee's local rotation, rest included, with which the shin comes nearest to where it is to be.

    Args:
        rig: The player's rig.
        joint: The shin's joint.
        upper: The thigh's rotation in the world, ``(4,)``.
        lower: That which the shin is to have, ``(4,)``.
    """
    skeleton = rig.skeleton
    foot = skeleton.index(skeleton.names[joint].replace("LowerLeg", "Foot"))
    rest, along = skeleton.rest_rotations[joint], skeleton.rest_translations[foot]
    hinge = rotate(rest, np.array([1.0, 0.0, 0.0]))
    shin, straight = rotate(conjugate(upper), rotate(lower, along)), rotate(rest, along)
    shin, straight = (each - hinge * (each @ hinge) for each in (shin, straight))
    angle = float(np.arctan2(cross(straight, shin) @ hinge, straight @ shin))
    return multiply(rest, from_axis_angle(np.array([1.0, 0.0, 0.0]), angle))
