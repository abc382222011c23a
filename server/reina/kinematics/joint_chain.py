"""A chain of joints as the iterative solvers see it: a row of hinges."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from reina.kinematics.joint_limits import limit_angles
from reina.kinematics.status import SolveStatus, StatusArray
from reina.rotations import about_axis, from_euler, multiply, rotate
from reina.skeleton import Limits, RigError

if TYPE_CHECKING:
    from reina.rotations.arrays import ArrayLike, FloatArray, IntArray
    from reina.skeleton import Rig

TOLERANCE_M = 1e-4

FREE = Limits("yxz", (-np.inf, -np.inf, -np.inf), (np.inf, np.inf, np.inf))
"""The limits of a joint that has none."""


class Stance(NamedTuple):
    """A chain with all angles set, for B poses."""

    positions: FloatArray
    """Of the joints, then of the end, ``(B, N + 1, 3)``, metres."""
    axes: FloatArray
    """Unit axes of the hinges, ``(B, M, 3)``."""


class JointChain:
    """N joints from a fixed base to an end, taken apart into M hinges.

    A joint turns by the Euler angles of its limits' order; each angle that the limits leave room is a hinge
    whose axis the turns before it have moved. So limits are bounds of single numbers, and are kept exactly.

    Args:
        links: Each joint in its parent's frame, then the end in the last joint's, metres, ``(N + 1, 3)``;
            the first is the chain's base in the frame in which targets are given.
        rest: Local rest rotations, ``(N, 4)``.
        limits: Of each joint, None where it turns freely.

    Raises:
        ValueError: The links or limits are not as many as the joints ask for, or no joint can turn.
    """

    def __init__(self, links: ArrayLike, rest: ArrayLike, limits: tuple[Limits | None, ...]) -> None:
        self.links: FloatArray = np.asarray(links, dtype=np.float64)
        self.rest: FloatArray = np.asarray(rest, dtype=np.float64)
        count = len(self.rest)
        if self.links.shape != (count + 1, 3) or len(limits) != count:
            raise ValueError(f"{count} joints need {count + 1} links and {count} limits")
        self.limits: tuple[Limits, ...] = tuple(FREE if one is None else one for one in limits)
        order = np.array([["xyz".index(letter) for letter in one.order] for one in self.limits])
        self._letters: list[list[int]] = order.tolist()
        low = np.array([one.minimum for one in self.limits])
        high = np.array([one.maximum for one in self.limits])
        self.low: FloatArray = np.take_along_axis(low, order, axis=1)
        """Least angles in each joint's order, ``(N, 3)``."""
        self.high: FloatArray = np.take_along_axis(high, order, axis=1)
        """Greatest angles, ``(N, 3)``."""
        joints, places = np.nonzero(self.low < self.high)
        self.hinges: list[tuple[int, int]] = list(zip(joints.tolist(), places.tolist(), strict=True))
        """Joint and place in its order of each hinge, from the base on."""
        self.hinge_joints: IntArray = joints
        if not self.hinges:
            raise ValueError("no joint of the chain can turn")

    @classmethod
    def from_rig(cls, rig: Rig, name: str) -> JointChain:
        """A chain of a rig; targets are in the frame of the joint that carries it.

        Raises:
            RigError: There is no such chain.
        """
        chain = rig.chain(name)
        skeleton = rig.skeleton
        joints = list(chain.joints)
        if chain.effector is not None:
            end = rig.effector(chain.effector).offset
        else:
            # The last joint is itself the end: it is moved by those before it.
            end = skeleton.rest_translations[joints.pop()]
        if not joints:
            raise RigError(f"{name!r} has no joint to move", location="chains")
        return cls(
            np.concatenate([skeleton.rest_translations[joints], end[None]]),
            skeleton.rest_rotations[joints],
            tuple(rig.limits.get(joint) for joint in joints),
        )

    @property
    def reach(self) -> float:
        """No end is further from the base than this, metres."""
        return float(np.sum(np.sqrt(np.sum(self.links[1:] ** 2, axis=-1))))

    def angles(self, rotations: ArrayLike) -> FloatArray:
        """Angles ``(B, N, 3)`` of local rotations ``(B, N, 4)``, brought within the limits."""
        local = np.asarray(rotations, dtype=np.float64)
        found = [limit_angles(local[:, j], self.rest[j], one) for j, one in enumerate(self.limits)]
        return np.minimum(np.maximum(np.stack(found, axis=1), self.low), self.high)

    def rotations(self, angles: FloatArray) -> FloatArray:
        """Local rotations, rest included, ``(B, N, 4)`` of angles ``(B, N, 3)``."""
        turned = [from_euler(angles[:, j], one.order) for j, one in enumerate(self.limits)]
        return multiply(self.rest, np.stack(turned, axis=1))

    def stance(self, angles: FloatArray) -> Stance:
        """Where joints, end and hinge axes are for angles ``(B, N, 3)``."""
        poses = len(angles)
        positions = np.empty((poses, len(self.links), 3))
        axes = np.empty((poses, len(self.hinges), 3))
        frame: FloatArray = np.broadcast_to([0.0, 0.0, 0.0, 1.0], (poses, 4))
        place: FloatArray = np.broadcast_to(self.links[0], (poses, 3))
        hinge = 0
        for joint, letters in enumerate(self._letters):
            positions[:, joint] = place
            frame = multiply(frame, self.rest[joint])
            for order, letter in enumerate(letters):
                if self.low[joint, order] < self.high[joint, order]:
                    axes[:, hinge] = rotate(frame, np.eye(3)[letter])
                    hinge += 1
                frame = multiply(frame, about_axis(letter, angles[:, joint, order]))
            place = place + rotate(frame, self.links[joint + 1])
        positions[:, -1] = place
        return Stance(positions, axes)


@dataclass(frozen=True, eq=False)
class ChainSolution:
    """What an iterative solver found for B targets."""

    rotations: FloatArray
    """Local rotations, rest included, within the limits, ``(B, N, 4)``."""
    status: StatusArray
    """A `SolveStatus` each, ``(B,)``."""
    error: FloatArray
    """Distance of the end from the target, metres, ``(B,)``."""
    iterations: IntArray
    """How many rounds it took, ``(B,)``."""


def judge(
    chain: JointChain, targets: FloatArray, angles: FloatArray, iterations: IntArray, tolerance_m: float
) -> ChainSolution:
    """What angles that a solver has come to are worth."""
    ends = chain.stance(angles).positions[:, -1]
    error = np.sqrt(np.sum((ends - targets) ** 2, axis=-1))
    beyond = np.sqrt(np.sum((targets - chain.links[0]) ** 2, axis=-1)) > chain.reach + tolerance_m
    status = np.full(len(targets), SolveStatus.NOT_CONVERGED, dtype=np.uint8)
    status[beyond] = SolveStatus.OUT_OF_REACH
    status[error <= tolerance_m] = SolveStatus.REACHED
    return ChainSolution(chain.rotations(angles), status, error, iterations)
