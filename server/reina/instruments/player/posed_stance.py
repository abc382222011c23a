"""A person's pose as a way of standing with an instrument."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.instruments.player.body_table import TRUNK
from reina.kinematics import clamp_to_limits
from reina.rotations import conjugate, cross, exp, from_axis_angle, log, multiply, rotate
from reina.skeleton import Limits, forward_kinematics

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.player.held_pose import HeldPose
    from reina.rotations.arrays import FloatArray
    from reina.skeleton import HumanPose, Rig

SIDES = ("left", "right")
ROOM_RAD = np.radians(8.0)
"""So far within the limits of its joints a pose keeps the trunk, for gestures that turn it further."""
AIM_RAD = 0.20
"""How far neck and head turn back at most, so that the player looks and plays where the hold does."""
NEAR_FLOOR_M = 0.05
"""A foot no higher than this above the other stands on the floor too."""
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
    with the chest, and turn back by `AIM_RAD` at most to look where they do in the hold; arms and instrument
    are left to the solvers.

    Args:
        pose: The pose.
        rig: The player's rig.
        held: The playing position.
    """
    skeleton = rig.skeleton
    _, rest_world = forward_kinematics(skeleton, skeleton.rest_rotations)
    facing = _facing(held.world[0], rest_world[0])
    local = held.rotations.copy()
    world = held.world.copy()
    for joint, parent in enumerate(skeleton.parents.tolist()):
        name = skeleton.names[joint]
        above = world[parent] if joint else np.array([0.0, 0.0, 0.0, 1.0])
        if name in pose.turns:
            world[joint] = multiply(multiply(facing, pose.turns[name]), _hung(rig, name, rest_world))
            local[joint] = multiply(conjugate(above), world[joint])
            limits = rig.limits.get(joint)
            # What a knee may do the solver of the legs keeps to.
            if limits is not None and not name.endswith("LowerLeg"):
                kept = limits if name.endswith(("UpperLeg", "Foot")) else _narrowed(limits)
                local[joint] = clamp_to_limits(local[joint], skeleton.rest_rotations[joint], kept)
        world[joint] = multiply(above, local[joint])
    _aim(rig, held, local, world)
    trunk = [skeleton.index(name) for name in TRUNK if name in skeleton]
    turns = log(multiply(conjugate(held.rotations[trunk]), local[trunk]))

    places, turned = forward_kinematics(skeleton, local, np.zeros(3))
    feet = np.array([skeleton.index(f"{side}Foot") for side in SIDES])
    soles = np.stack([_lowest(rig, side, places, turned, rest_world) for side in SIDES])
    floor = min(_lowest(rig, side, held.positions, held.world, rest_world) for side in SIDES)
    root = (held.positions[feet] - places[feet]).mean(axis=0)
    root[1] = floor - soles.min()
    ankles = places[feet] + root
    above_floor = soles - soles.min()
    ankles[:, 1] -= np.where(above_floor < NEAR_FLOOR_M, above_floor, 0.0)
    return PosedStance(
        turns=turns,
        hips=root - held.root,
        feet=ankles - held.positions[feet],
        feet_turns=log(multiply(turned[feet], conjugate(held.world[feet]))),
        knees=np.stack([_hinge(rig, side, places, turned) for side in SIDES])
        - np.stack([_axis(rig, side, held.world) for side in SIDES]),
    )


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


def _narrowed(limits: Limits) -> Limits:
    """Limits that leave `ROOM_RAD` on both sides, half of what there is at most."""
    pairs = list(zip(limits.minimum, limits.maximum, strict=True))
    return Limits(
        limits.order,
        _three([min(low + ROOM_RAD, 0.5 * low) if low < 0.0 else low for low, _ in pairs]),
        _three([max(high - ROOM_RAD, 0.5 * high) if high > 0.0 else high for _, high in pairs]),
    )


def _three(numbers: Sequence[float]) -> tuple[float, float, float]:
    x, y, z = numbers
    return x, y, z


def _aim(rig: Rig, held: HeldPose, local: FloatArray, world: FloatArray) -> None:
    """Turn neck and head back towards where the hold has the head, half of it each."""
    skeleton = rig.skeleton
    head = skeleton.index("head")
    back = log(multiply(held.world[head], conjugate(world[head])))
    size = float(np.linalg.norm(back))
    back = back * min(1.0, AIM_RAD / size) if size > 0.0 else back
    joints = [skeleton.index(name) for name in ("neck", "head") if name in skeleton]
    parent = world[skeleton.parents[joints[0]]]
    for share, joint in enumerate(joints, start=1):
        turned = multiply(exp(back * share / len(joints)), world[joint])
        local[joint] = multiply(conjugate(parent), turned)
        parent = turned


def _lowest(
    rig: Rig, side: str, places: FloatArray, turned: FloatArray, rest_world: FloatArray
) -> FloatArray:
    """The height of a shoe's lowest point: heel, ball or toe."""
    skeleton = rig.skeleton
    rest_places, _ = forward_kinematics(skeleton, skeleton.rest_rotations)
    foot = skeleton.index(f"{side}Foot")
    sole = rig.contact(f"{side}Sole")
    below = rotate(rest_world[foot], sole.offset)[1]
    reach = rest_places[skeleton.index(f"{side}Toes")] - rest_places[foot]
    along = reach * [1.0, 0.0, 1.0]
    length = float(np.linalg.norm(along))
    points = np.stack([along * step for step in (-HEEL_M / length, 1.0, 1.0 + TOE_M / length)])
    points[:, 1] = below
    return np.min(places[foot, 1] + rotate(multiply(turned[foot], conjugate(rest_world[foot])), points)[:, 1])


def _axis(rig: Rig, side: str, turned: FloatArray) -> FloatArray:
    """The direction of a knee's hinge as its thigh has it, ``(3,)``."""
    skeleton = rig.skeleton
    lower = skeleton.index(f"{side}LowerLeg")
    hinge = rotate(skeleton.rest_rotations[lower], np.array([1.0, 0.0, 0.0]))
    return rotate(turned[skeleton.parents[lower]], hinge)


def _hinge(rig: Rig, side: str, places: FloatArray, turned: FloatArray) -> FloatArray:
    """The same of a posed leg: as thigh and shin lie where the knee is bent, else as the thigh is turned."""
    skeleton = rig.skeleton
    upper, lower, foot = (skeleton.index(f"{side}{bone}") for bone in ("UpperLeg", "LowerLeg", "Foot"))
    thigh, shin = places[lower] - places[upper], places[foot] - places[lower]
    axis = _axis(rig, side, turned)
    lies = cross(thigh, shin) / (np.linalg.norm(thigh) * np.linalg.norm(shin))
    # A knee that is bent forward is read as straight.
    mixed = BEND * axis + lies if lies @ axis > 0.0 else axis
    return mixed / np.linalg.norm(mixed)
