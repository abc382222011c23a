"""From space to the finger's plane and back: the eight steps of the paper's section 4.5."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.rotations import conjugate, rotate

if TYPE_CHECKING:
    from reina.rotations.arrays import ArrayLike, FloatArray


def target_in_hand(
    R_world_hand: ArrayLike, origin: ArrayLike, target: ArrayLike, axis_signs: ArrayLike = (1.0, 1.0, 1.0)
) -> FloatArray:
    """Steps 1 to 4: the target in the hand joint's axes with the finger's first joint as the origin.

    Args:
        R_world_hand: The hand joint's rotation in the world, ``(..., 4)``.
        origin: World position of the finger's first joint, ``(..., 3)``.
        target: World position of the target, ``(..., 3)``.
        axis_signs: -1 for each of the joint's axes that is to be flipped, so that x points away from the
            wrist and y away from the palm. Reina's rigs are built so already.

    Returns:
        ``(..., 3)``, metres.
    """
    offset = np.asarray(target, dtype=np.float64) - np.asarray(origin, dtype=np.float64)
    return rotate(conjugate(R_world_hand), offset) * np.asarray(axis_signs, dtype=np.float64)


def project_on_hand_planes(target: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Steps 5 and 6 as the paper has them: abduction from the xz plane, planar target from the xy plane.

    The xy projection is that of the hand, not of the finger once it has turned sideways by the abduction a:
    the planar target comes out short by the factor cos a along x. `project_on_finger_plane` has not that
    error.

    Returns:
        Abduction about y, ``(...)``, radians, and planar targets ``(..., 2)``, metres.
    """
    point = np.asarray(target, dtype=np.float64)
    abduction = np.arctan2(-point[..., 2], point[..., 0])
    return abduction, point[..., :2].copy()


def project_on_finger_plane(
    target: ArrayLike, abduction_limits_rad: ArrayLike = (-0.5 * np.pi, 0.5 * np.pi)
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Steps 5 and 6 in the finger's own plane: exact, and within the limits of abduction.

    A target behind the knuckle is met by bending, not by turning the finger round: the abduction is taken
    within ±90°, and the planar x is negative there.

    Args:
        target: In the first joint's rest axes with that joint as the origin, ``(..., 3)``, metres.
        abduction_limits_rad: Least and greatest, ``(..., 2)``.

    Returns:
        Abduction ``(...)``; planar targets ``(..., 2)``; and how far the target lies off the finger's
        plane, ``(...)``, metres, 0 unless the abduction stopped at a limit.
    """
    point = np.asarray(target, dtype=np.float64)
    limits = np.asarray(abduction_limits_rad, dtype=np.float64)
    x, z = point[..., 0], point[..., 2]
    abduction = np.arctan2(np.where(x < 0.0, z, -z), np.abs(x))
    abduction = np.minimum(np.maximum(abduction, limits[..., 0]), limits[..., 1])
    cosine, sine = np.cos(abduction), np.sin(abduction)
    planar = np.empty((*x.shape, 2))
    planar[..., 0] = x * cosine - z * sine
    planar[..., 1] = point[..., 1]
    return abduction, planar, x * sine + z * cosine


def finger_rotations(abduction_rad: ArrayLike, angles_rad: ArrayLike) -> FloatArray:
    """Steps 7 and 8: the joints' turns from rest, ``(..., 3, 4)``: Ry(a) Rz(θ1), Rz(θ2), Rz(θ3)."""
    half = 0.5 * np.asarray(angles_rad, dtype=np.float64)
    half_abduction = 0.5 * np.asarray(abduction_rad, dtype=np.float64)
    sine, cosine = np.sin(half), np.cos(half)
    side, ahead = np.sin(half_abduction), np.cos(half_abduction)
    q = np.zeros((*half.shape, 4))
    q[..., 2] = sine
    q[..., 3] = cosine
    q[..., 0, 0] = side * sine[..., 0]
    q[..., 0, 1] = side * cosine[..., 0]
    q[..., 0, 2] *= ahead
    q[..., 0, 3] *= ahead
    return q
