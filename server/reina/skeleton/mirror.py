"""Poses reflected from left to right: what one skeleton does, done by its mirror image."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from reina.rotations import dot, rotate
from reina.skeleton.errors import RigError
from reina.skeleton.forward_kinematics import forward_kinematics
from reina.skeleton.hold import Attachment

if TYPE_CHECKING:
    from collections.abc import Mapping

    from reina.rotations.arrays import FloatArray, IntArray
    from reina.skeleton.hold import Hold
    from reina.skeleton.skeleton import Skeleton

ACROSS = np.array([-1.0, 1.0, 1.0])
"""What the reflection does to a place in the world: left and right change places."""

_NEAR_M, _NEAR = 1e-4, 1e-4
"""How far a joint may rest from the other's mirror image, metres, and how far its axes."""

_IN_TURNS = np.array([[3, 2, 1, 0], [2, 3, 0, 1], [1, 0, 3, 2]])
_TURN_SIGNS = np.array([[1.0, 1.0, -1.0, -1.0], [-1.0, 1.0, 1.0, -1.0], [1.0, -1.0, 1.0, -1.0]])
"""A quaternion times half a turn about x, y or z: which components, and their signs."""


def other_side(name: str) -> str:
    """The name on the other side: ``leftHand`` of ``rightHand``; what begins with no side keeps its name."""
    for side, other in (("left", "right"), ("right", "left")):
        if name.startswith(side):
            return other + name.removeprefix(side)
    return name


class Mirror:
    """Turns a pose of one skeleton into the mirror image's, which may be the same skeleton.

    A joint whose name begins with a side stands for the other side's. A joint's axes need not be the mirror
    image of the other's: the bones of both arms lie along +x. Nothing is rounded: components of quaternions
    change places and signs.

    Args:
        of: What is reflected.
        to: What takes the reflection: at rest the mirror image of the other.

    Raises:
        RigError: It is not.
    """

    def __init__(self, of: Skeleton, to: Skeleton | None = None) -> None:
        to = of if to is None else to
        lost = [name for name in to.names if other_side(name) not in of]
        if lost or len(of.names) != len(to.names):
            raise RigError(f"no joint is the mirror image of {(lost or to.names)[0]!r}", location="joints")
        self.partners: IntArray = np.array([of.index(other_side(name)) for name in to.names], dtype=np.intp)
        """Of each joint which of the other skeleton's it reflects, ``(J,)``."""
        places, turns = forward_kinematics(of, of.rest_rotations)
        own_places, own_turns = forward_kinematics(to, to.rest_rotations)
        for joint, partner in enumerate(self.partners.tolist()):
            if np.abs(places[partner] * ACROSS - own_places[joint]).max() > _NEAR_M:
                raise _unlike(of, to, joint, partner)
        self.axes: FloatArray = np.stack(
            [
                _axes(of, to, turns[partner], own_turns[joint], joint, partner)
                for joint, partner in enumerate(self.partners.tolist())
            ]
        )
        """What it does to a place in a joint's frame: a factor of each component, ``(J, 3)``."""
        above = self.axes[np.maximum(to.parents, 0)]
        above[0] = ACROSS
        self.columns, self.signs = _as_quaternions(above, self.axes)
        """Of each component of a joint's rotation which of the partner's it is, and its sign, ``(J, 4)``."""
        rest = self.rotations(of.rest_rotations)
        self.signs[dot(rest, to.rest_rotations) < 0.0] *= -1.0

    def rotations(self, rotations: FloatArray) -> FloatArray:
        """Local rotations of all joints, rest included, reflected: ``(..., J, 4)``."""
        return rotations[..., self.partners[:, None], self.columns] * self.signs

    def turns(self, joints: IntArray, vectors: FloatArray) -> FloatArray:
        """Rotation vectors in the frames of some joints, ``(..., N, 3)``, as these joints' own.

        Args:
            joints: Indices in the skeleton that takes the reflection, ``(N,)``.
            vectors: Of their partners, radians.
        """
        return -vectors * self.axes[joints]


def _axes(
    of: Skeleton, to: Skeleton, turn: FloatArray, own: FloatArray, joint: int, partner: int
) -> FloatArray:
    """Which of a joint's axes points away from the reflection of its partner's, as factors ``(3,)``."""
    between = (
        np.stack([rotate(turn, axis) * ACROSS for axis in np.eye(3)])
        @ np.stack([rotate(own, axis) for axis in np.eye(3)]).T
    )
    factors = np.round(np.diag(between))
    if np.abs(between - np.diag(factors)).max() > _NEAR or np.prod(factors) != -1.0 or factors.sum() != 1.0:
        raise _unlike(of, to, joint, partner)
    return factors


def _unlike(of: Skeleton, to: Skeleton, joint: int, partner: int) -> RigError:
    told = f"{to.names[joint]!r} does not rest as the mirror image of {of.names[partner]!r}"
    return RigError(told, location=f"joints/{joint}")


def _as_quaternions(above: FloatArray, own: FloatArray) -> tuple[IntArray, FloatArray]:
    """As components of quaternions: which of the partner's, and by which factor, ``(J, 4)`` each.

    A joint's rotation R becomes A·R·B, A being the reflection in the parent's frame and B that in its own:
    A·R·A, a reflection, and then A·B, which is no turn, or half a turn about the axis that neither reflects.
    """
    columns = np.tile(np.arange(4), (len(own), 1))
    signs = np.concatenate([-above, np.ones((len(own), 1))], axis=1)
    for joint, (a, b) in enumerate(zip(above, own, strict=True)):
        half = np.flatnonzero(a * b > 0.0)
        if len(half) == 1:
            axis = int(half[0])
            columns[joint] = _IN_TURNS[axis]
            signs[joint] = _TURN_SIGNS[axis] * signs[joint][columns[joint]]
    return columns, signs


def mirrored_hold(hold: Hold, player: Skeleton, carried: Mapping[str, Skeleton], *, instrument: str) -> Hold:
    """How a player holds the mirror image of an instrument.

    Args:
        hold: How the instrument is held.
        player: The player's skeleton, its own mirror image.
        carried: The skeletons of `Hold.attachments`, by name; each one's other side is its mirror image.
        instrument: The name of the mirror image's rig.

    Raises:
        RigError: Something is not the mirror image of the other side.
    """
    mirror = Mirror(player)
    rotations = player.rest_rotations.copy()
    for name, rotation in hold.pose.items():
        rotations[player.index(name)] = rotation
    reflected = mirror.rotations(rotations)
    whole = np.concatenate([-ACROSS, [1.0]])
    attachments: dict[str, Attachment] = {}
    for name, attached in hold.attachments.items():
        other = other_side(name)
        joint = other_side(attached.joint)
        axes = mirror.axes[player.index(joint)]
        own = Mirror(carried[name], carried[other]).axes[0]
        columns, signs = _as_quaternions(axes[None], own[None])
        attachments[other] = Attachment(
            joint, attached.position * axes, attached.rotation[columns[0]] * signs[0]
        )
    return replace(
        hold,
        instrument=instrument,
        pose={name: reflected[player.index(name)] for name in map(other_side, hold.pose)},
        hips_position=None if hold.hips_position is None else hold.hips_position * ACROSS,
        instrument_position=hold.instrument_position * ACROSS,
        instrument_rotation=hold.instrument_rotation * whole,
        attachments=attachments,
    )
