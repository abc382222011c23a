"""The fingers of a rig, solved side by side."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.kinematics.coupled_finger import CoupledFinger
from reina.kinematics.finger_plane import finger_rotations, project_on_finger_plane
from reina.kinematics.planar_finger import TABLE_1_RAD, solve_planar
from reina.kinematics.status import SolveStatus, StatusArray
from reina.rotations import conjugate, multiply, rotate, to_matrix
from reina.skeleton import RigError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.rotations.arrays import ArrayLike, FloatArray, IntArray
    from reina.skeleton import Chain, Rig

_STRAIGHT_TOLERANCE = 1e-4
_OFF_PLANE_TOLERANCE_M = 1e-9


class FingerChains:
    """K fingers of one hand, all with the same solver, taken from a rig's chains.

    The rig's fingers are coplanar: bones lie along x, the last two joints rest turned about z alone, the
    pad lies on the last bone's x axis. Planar angles are absolute, so they include the rest pose's bend.

    Args:
        rig: The player's rig.
        names: K chains.

    Raises:
        RigError: A chain is no finger, the solvers differ, or a finger is not coplanar.
    """

    def __init__(self, rig: Rig, names: Sequence[str]) -> None:
        chains = [rig.chain(name) for name in names]
        if len({(chain.solver, chain.kappa, chain.phi_rad) for chain in chains}) != 1:
            raise RigError(
                f"the fingers {', '.join(names)} have different solvers or settings", location="chains"
            )
        self.names = tuple(names)
        self.joints: IntArray = np.array([chain.joints for chain in chains], dtype=np.intp)
        """Indices ``(K, 3)``."""
        skeleton = rig.skeleton
        self.origins: FloatArray = skeleton.rest_translations[self.joints[:, 0]]
        """First joints in the hand's frame ``(K, 3)``, metres."""
        self._rest: FloatArray = skeleton.rest_rotations[self.joints[:, 0]]
        self._parent_to_rest: FloatArray = to_matrix(conjugate(self._rest))
        self.lengths: FloatArray = np.array([_bone_lengths(rig, chain) for chain in chains])
        """Bone lengths ``(K, 3)``, metres."""
        limits, abduction = _planar_limits(rig, self.joints)
        self._abduction_limits = abduction
        self.limits = limits
        """Planar limits ``(K, 3, 2)``, radians."""
        self._phi = chains[0].phi_rad
        self._coupled = (
            CoupledFinger(self.lengths, chains[0].kappa, limits) if chains[0].kappa is not None else None
        )

    def solve(self, targets: ArrayLike) -> tuple[FloatArray, StatusArray]:
        """Local rotations that bring the pads to targets.

        Args:
            targets: In the frame of the joint that carries the fingers (the hand), ``(..., K, 3)``, metres.

        Returns:
            Local rotations, rest included, ``(..., K, 3, 4)``, and a `SolveStatus` each, ``(..., K)``.
        """
        return self.solve_at_rest(self.turn_to_rest(np.asarray(targets, dtype=np.float64) - self.origins))

    def turn_to_rest(self, vectors: ArrayLike) -> FloatArray:
        """Vectors in the hand's frame ``(..., K, 3)`` in that of each finger's first joint at rest."""
        return np.einsum("kij,...kj->...ki", self._parent_to_rest, np.asarray(vectors, dtype=np.float64))

    def solve_at_rest(self, point: FloatArray) -> tuple[FloatArray, StatusArray]:
        """As `solve`, for targets ``(..., K, 3)`` in each first joint's rest axes, that joint the origin."""
        abduction, planar, off_plane = project_on_finger_plane(point, self._abduction_limits)
        if self._coupled is not None:
            angles, status = self._coupled.solve(planar)
        else:
            angles, status = solve_planar(planar, self.lengths, self._phi or 0.0, self.limits)
        beside = (np.abs(off_plane) > _OFF_PLANE_TOLERANCE_M) & (status == SolveStatus.REACHED)
        status = np.where(beside, np.uint8(SolveStatus.AT_LIMIT), status)
        return self._rotations(abduction, angles), status

    def rotations_at_rest(self, point: FloatArray) -> FloatArray:
        """The rotations that `solve_at_rest` gives, for who has no use for the status."""
        if self._coupled is None:
            return self.solve_at_rest(point)[0]
        abduction, planar, _ = project_on_finger_plane(point, self._abduction_limits)
        return self._rotations(abduction, self._coupled.angles(planar))

    def _rotations(self, abduction: FloatArray, angles: FloatArray) -> FloatArray:
        rotations = finger_rotations(abduction, angles)
        rotations[..., 0, :] = multiply(self._rest, rotations[..., 0, :])
        return rotations

    def tips(self, rotations: ArrayLike) -> FloatArray:
        """Where the pads are for local rotations ``(..., K, 3, 4)``: in the hand's frame, ``(..., K, 3)``."""
        local = np.asarray(rotations, dtype=np.float64)
        tip = rotate(
            local[..., 2, :], np.stack([self.lengths[:, 2], *np.zeros((2, len(self.names)))], axis=-1)
        )
        for bone in (1, 0):
            tip[..., 0] += self.lengths[:, bone]
            tip = rotate(local[..., bone, :], tip)
        return tip + self.origins


def _bone_lengths(rig: Rig, chain: Chain) -> list[float]:
    if chain.effector is None or len(chain.joints) != 3:
        raise RigError(
            f"{chain.name!r} is no finger: it needs three joints and an effector", location="chains"
        )
    skeleton = rig.skeleton
    bones = [*skeleton.rest_translations[list(chain.joints[1:])], rig.effector(chain.effector).offset]
    for bone, joint in zip(bones, chain.joints, strict=True):
        if bone[0] <= 0.0 or np.hypot(bone[1], bone[2]) > _STRAIGHT_TOLERANCE * bone[0]:
            raise RigError(
                f"the bone of {skeleton.names[joint]!r} must lie along its x axis", location="joints"
            )
    for joint in chain.joints[1:]:
        if np.hypot(*skeleton.rest_rotations[joint, :2]) > _STRAIGHT_TOLERANCE:
            raise RigError(f"{skeleton.names[joint]!r} must rest turned about z alone", location="joints")
    return [float(bone[0]) for bone in bones]


def _planar_limits(rig: Rig, joints: IntArray) -> tuple[FloatArray, FloatArray]:
    """Limits of the planar angles ``(K, 3, 2)`` and of abduction ``(K, 2)``; Table 1 where none are said."""
    limits = np.broadcast_to(TABLE_1_RAD, (len(joints), 3, 2)).copy()
    abduction = np.tile([-0.5 * np.pi, 0.5 * np.pi], (len(joints), 1))
    for finger, chain in enumerate(joints.tolist()):
        for place, joint in enumerate(chain):
            found = rig.limits.get(joint)
            if found is None:
                continue
            rest = rig.skeleton.rest_rotations[joint]
            bend = 2.0 * np.arctan2(rest[2], rest[3]) if place > 0 else 0.0
            limits[finger, place] = found.minimum[2] + bend, found.maximum[2] + bend
            if place == 0:
                abduction[finger] = found.minimum[1], found.maximum[1]
    return limits, abduction
