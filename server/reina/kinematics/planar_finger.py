"""The finger of the paper: a planar arm of three bones whose last bone's direction φ is given.

Wang, "6.837 Final Project: Project Reina" (2017), section 4.4, after Asada, "Introduction to Robotics", ch.
4. Angles are each relative to the bone before; flexion is negative; the tip lies at (x, y) in the first
joint's frame.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.kinematics.status import SolveStatus, StatusArray

if TYPE_CHECKING:
    from reina.rotations.arrays import ArrayLike, FloatArray

TABLE_1_RAD: FloatArray = np.radians([[-70.0, 80.0], [-135.0, 0.0], [-45.0, 0.0]])
"""The paper's limits of θ1, θ2 and θ3: least and greatest, radians, ``(3, 2)``."""

VALVE_PHI_RAD: float = float(np.radians(-115.0))
"""The direction of the last bone of a finger on a valve, as the paper sets it."""

_LIMIT_SLACK_RAD = 1e-9


def finger_tip(angles_rad: ArrayLike, lengths: ArrayLike) -> FloatArray:
    """Where the tip is, ``(..., 2)``, for angles ``(..., 3)`` and bone lengths ``(..., 3)``, metres."""
    directions = np.cumsum(np.asarray(angles_rad, dtype=np.float64), axis=-1)
    bones = np.asarray(lengths, dtype=np.float64)
    return np.stack([np.sum(bones * np.cos(directions), -1), np.sum(bones * np.sin(directions), -1)], axis=-1)


def planar_solutions(
    targets: ArrayLike, lengths: ArrayLike, phi_rad: ArrayLike
) -> tuple[FloatArray, FloatArray]:
    """Both solutions of the planar arm with the last bone's direction given, limits aside.

    Args:
        targets: Tip positions, ``(..., 2)``, metres.
        lengths: Bone lengths, ``(..., 3)``, metres.
        phi_rad: Direction of the last bone, θ1 + θ2 + θ3, ``(...)``.

    Returns:
        Angles ``(..., 2, 3)``, radians in -pi..pi, first the solution with θ2 <= 0; and by how much the
        third joint lies out of the reach of the first two bones, ``(...)``, metres, 0 where the solutions
        are real.
    """
    target = np.asarray(targets, dtype=np.float64)
    bones = np.asarray(lengths, dtype=np.float64)
    phi = np.asarray(phi_rad, dtype=np.float64)
    l1, l2, l3 = bones[..., 0], bones[..., 1], bones[..., 2]
    x = target[..., 0] - l3 * np.cos(phi)
    y = target[..., 1] - l3 * np.sin(phi)
    squared = x * x + y * y
    distance = np.sqrt(squared)
    excess = np.maximum(np.maximum(distance - (l1 + l2), np.abs(l1 - l2) - distance), 0.0)
    bend = np.arccos(np.clip((squared - l1 * l1 - l2 * l2) / (2.0 * l1 * l2), -1.0, 1.0))
    theta2 = np.stack([-bend, bend], axis=-1)
    l1, l2 = l1[..., None], l2[..., None]
    theta1 = np.arctan2(y, x)[..., None] - np.arctan2(l2 * np.sin(theta2), l1 + l2 * np.cos(theta2))
    theta3 = phi[..., None] - theta1 - theta2
    return _wrap(np.stack([theta1, theta2, theta3], axis=-1)), excess


def solve_planar(
    targets: ArrayLike,
    lengths: ArrayLike,
    phi_rad: ArrayLike = VALVE_PHI_RAD,
    limits_rad: ArrayLike = TABLE_1_RAD,
) -> tuple[FloatArray, StatusArray]:
    """The paper's solve: of two solutions the one inside all limits; all angles zero where there is none.

    Args:
        targets: Tip positions, ``(..., 2)``, metres.
        lengths: Bone lengths, ``(..., 3)``, metres.
        phi_rad: Direction of the last bone, ``(...)``.
        limits_rad: Least and greatest angle of each joint, ``(..., 3, 2)``.

    Returns:
        Angles ``(..., 3)``, radians, and a `SolveStatus` each, ``(...)``: OUT_OF_REACH where the first two
        bones cannot bring the third to its place, AT_LIMIT where both ways of doing so break a limit.
    """
    solutions, excess = planar_solutions(targets, lengths, phi_rad)
    limits = np.asarray(limits_rad, dtype=np.float64)[..., None, :, :]
    inside = np.all(
        (solutions >= limits[..., 0] - _LIMIT_SLACK_RAD) & (solutions <= limits[..., 1] + _LIMIT_SLACK_RAD),
        axis=-1,
    )
    real = excess <= 1e-12
    valid = inside.any(axis=-1) & real
    angles = np.where(inside[..., :1], solutions[..., 0, :], solutions[..., 1, :]) * valid[..., None]
    status = np.full(valid.shape, SolveStatus.AT_LIMIT, dtype=np.uint8)
    status[~real] = SolveStatus.OUT_OF_REACH
    status[valid] = SolveStatus.REACHED
    return angles, status


def _wrap(angles: FloatArray) -> FloatArray:
    return angles - 2.0 * np.pi * np.round(angles / (2.0 * np.pi))
