"""Forward kinematics of a chain, with what one wants to see of it: joints, axes, limits as fans."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.lab.errors import LabError
from reina.rotations import cross, from_axis_angle, multiply, rotate

if TYPE_CHECKING:
    from reina.lab.posable_chain import Hinge, PosableChain
    from reina.rotations.arrays import ArrayLike, FloatArray

FAN_STEP_RAD = float(np.radians(5.0))
_FAN_SIZE = 0.42
"""A fan's radius, as a part of its bone's length."""
_MIN_ACROSS = 0.35
"""A bone that leans less than this across its hinge's axis turns about itself: its y axis shows it."""
_SLACK_RAD = 1e-6
_FULL_TURN_RAD = 2.0 * np.pi


@dataclass(frozen=True, eq=False)
class HingeReading:
    """One hinge of a posed chain.

    Attributes:
        angle_rad: From rest.
        beyond_rad: By how much it is beyond the rig's limits, 0 within.
        origin: Where it is, ``(3,)``, metres in the carrier's frame.
        axis: Unit, ``(3,)``.
        fan: Unit directions from the least to the greatest angle that the limits allow, ``(D, 3)``.
        direction: Where the bone now points among them, ``(3,)``.
        radius_m: How large to draw the fan.
    """

    angle_rad: float
    beyond_rad: float
    origin: FloatArray
    axis: FloatArray
    fan: FloatArray
    direction: FloatArray
    radius_m: float


@dataclass(frozen=True)
class FingerReading:
    """A finger's angles as the paper counts them, radians; flexion is negative."""

    abduction_rad: float
    theta_rad: tuple[float, float, float]

    @property
    def phi_rad(self) -> float:
        """The last bone's direction."""
        return sum(self.theta_rad)


@dataclass(frozen=True, eq=False)
class ChainPose:
    """A chain with all angles set, in the frame of the joint that carries it.

    Attributes:
        positions: Of the joints, then of the end, ``(N + 1, 3)``, metres.
        orientations: Of the joints, ``(N, 4)``.
        hinges: From the base on.
        finger: For fingers only.
    """

    positions: FloatArray
    orientations: FloatArray
    hinges: tuple[HingeReading, ...]
    finger: FingerReading | None


def check_angles(
    chain: PosableChain, angles_rad: ArrayLike, *, limits: bool, location: str = "angles_rad"
) -> FloatArray:
    """Hinge angles ``(M,)``, radians from rest, as a chain's own table of angles, ``(N, 3)``.

    Args:
        chain: The chain.
        angles_rad: One for each of its hinges.
        limits: Whether the rig's limits hold; otherwise a full turn does.
        location: What the angles are called in an error.

    Raises:
        LabError: They are not one a hinge, or one is beyond its limits (or a full turn, without limits).
    """
    given = np.asarray(angles_rad, dtype=np.float64)
    hinges = chain.hinges
    if given.shape != (len(hinges),):
        names = ", ".join(f"{chain.joint_names[hinge.joint]} {hinge.axis}" for hinge in hinges)
        raise LabError(
            f"{chain.name} has {len(hinges)} angles ({names}), not {given.size}", location=location
        )
    table = np.zeros((len(chain.joints), 3))
    for index, (hinge, angle) in enumerate(zip(hinges, given.tolist(), strict=True)):
        low, high = _bounds(hinge) if limits else (-_FULL_TURN_RAD, _FULL_TURN_RAD)
        if not low - _SLACK_RAD <= angle <= high + _SLACK_RAD:
            raise LabError(
                f"{chain.joint_names[hinge.joint]} {hinge.axis} turns from {np.degrees(low):.1f}° to "
                f"{np.degrees(high):.1f}°, not to {np.degrees(angle):.1f}°",
                location=f"{location}/{index}",
            )
        table[hinge.joint, hinge.place] = angle
    return table


def pose_chain(chain: PosableChain, angles: FloatArray) -> ChainPose:
    """The chain at angles ``(N, 3)``, in each joint's Euler order (`check_angles` makes them)."""
    joint_chain = chain.limited
    stance = joint_chain.stance(angles[None])
    positions, axes = stance.positions[0], stance.axes[0]
    local = joint_chain.rotations(angles[None])[0]
    orientations = local.copy()
    for joint in range(1, len(local)):
        orientations[joint] = multiply(orientations[joint - 1], local[joint])
    readings = tuple(
        _read_hinge(
            hinge,
            float(angles[hinge.joint, hinge.place]),
            positions[hinge.joint],
            axes[index],
            positions[hinge.joint + 1] - positions[hinge.joint],
            rotate(orientations[hinge.joint], np.array([0.0, 1.0, 0.0])),
        )
        for index, hinge in enumerate(chain.hinges)
    )
    return ChainPose(positions, orientations, readings, _read_finger(chain, angles))


def _read_hinge(
    hinge: Hinge, angle: float, origin: FloatArray, axis: FloatArray, bone: FloatArray, side: FloatArray
) -> HingeReading:
    low, high = _bounds(hinge)
    length = float(np.linalg.norm(bone))
    across = bone - axis * float(axis @ bone)
    if float(np.linalg.norm(across)) < _MIN_ACROSS * length:
        across = side - axis * float(axis @ side)
    if float(np.linalg.norm(across)) < 1e-9:
        across = cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    direction = across / np.linalg.norm(across)
    count = max(2, int(np.ceil((high - low) / FAN_STEP_RAD)) + 1)
    turns = np.linspace(low, high, count) - angle
    return HingeReading(
        angle_rad=angle,
        beyond_rad=max(low - angle, angle - high, 0.0)
        if max(low - angle, angle - high) > _SLACK_RAD
        else 0.0,
        origin=origin,
        axis=axis,
        fan=rotate(from_axis_angle(axis, turns), direction),
        direction=direction,
        radius_m=_FAN_SIZE * length,
    )


def _bounds(hinge: Hinge) -> tuple[float, float]:
    return max(hinge.minimum_rad, -np.pi), min(hinge.maximum_rad, np.pi)


def _read_finger(chain: PosableChain, angles: FloatArray) -> FingerReading | None:
    if chain.kind != "finger":
        return None
    turns = {(hinge.joint, hinge.axis): angles[hinge.joint, hinge.place] for hinge in chain.hinges}
    bends = chain.planar_bends
    theta = [float(turns.get((joint, "z"), 0.0) + bends[joint]) for joint in range(3)]
    return FingerReading(float(turns.get((0, "y"), 0.0)), (theta[0], theta[1], theta[2]))
