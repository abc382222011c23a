"""Rotation vectors (axis times angle), and the exponential and logarithm between them and rotations."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.rotations.matrices import from_matrix, to_matrix
from reina.rotations.quaternions import as_quaternions

if TYPE_CHECKING:
    from reina.rotations.arrays import ArrayLike, FloatArray


def exp(rotation_vectors: ArrayLike) -> FloatArray:
    """Quaternions ``(..., 4)`` of rotation vectors ``(..., 3)``, radians: Rodrigues' formula in half angles.

    Exact to rounding for every length, zero included: sin h / h is 1 to the last bit long before h
    underflows.
    """
    vectors = np.asarray(rotation_vectors, dtype=np.float64)
    half = 0.5 * np.sqrt(np.einsum("...i,...i->...", vectors, vectors))
    q = np.empty((*vectors.shape[:-1], 4))
    divisor = np.maximum(half, 1e-150)
    scale = 0.5 * np.sin(divisor) / divisor
    for axis in range(3):  # faster than all three at once, which would be loops of three numbers
        np.multiply(vectors[..., axis], scale, out=q[..., axis])
    q[..., 3] = np.cos(half)
    return q


def log(q: ArrayLike) -> FloatArray:
    """Rotation vectors ``(..., 3)`` of unit quaternions, radians, of length 0..pi: the short way round.

    atan2 of vector and scalar part keeps full precision near 0 and near pi alike.
    """
    quaternions = as_quaternions(q)
    sign = np.where(quaternions[..., 3] < 0.0, -1.0, 1.0)[..., None]
    vector = quaternions[..., :3] * sign
    length = np.sqrt(np.einsum("...i,...i->...", vector, vector))
    angle = 2.0 * np.arctan2(length, np.abs(quaternions[..., 3]))
    # Below 1e-150 squares underflow; there angle/length is 2 to the last bit.
    tiny = length < 1e-150
    scale = np.where(tiny, 2.0, angle / np.where(tiny, 1.0, length))
    return vector * scale[..., None]


def exp_matrix(rotation_vectors: ArrayLike) -> FloatArray:
    """Rotation matrices ``(..., 3, 3)`` of rotation vectors ``(..., 3)``, radians."""
    return to_matrix(exp(rotation_vectors))


def log_matrix(matrices: ArrayLike) -> FloatArray:
    """Rotation vectors ``(..., 3)`` of rotation matrices, radians.

    By way of the quaternion: acos((tr R - 1)/2) loses half of its digits near 0 and the axis near pi.
    """
    return log(from_matrix(matrices))


def from_axis_angle(axes: ArrayLike, angles_rad: ArrayLike) -> FloatArray:
    """Quaternions ``(..., 4)`` of turns by ``angles_rad`` ``(...)`` about unit ``axes`` ``(..., 3)``."""
    axis = np.asarray(axes, dtype=np.float64)
    half = 0.5 * np.asarray(angles_rad, dtype=np.float64)
    q = np.empty((*np.broadcast_shapes(axis.shape[:-1], half.shape), 4))
    q[..., :3] = axis * np.sin(half)[..., None]
    q[..., 3] = np.cos(half)
    return q


def about_axis(axis: int, angles_rad: ArrayLike) -> FloatArray:
    """Quaternions ``(..., 4)`` of turns about one coordinate axis, 0 for x, 1 for y, 2 for z."""
    half = 0.5 * np.asarray(angles_rad, dtype=np.float64)
    q = np.zeros((*half.shape, 4))
    q[..., axis] = np.sin(half)
    q[..., 3] = np.cos(half)
    return q
