"""Quaternions to rotation matrices ``(..., 3, 3)`` and back."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.rotations.quaternions import as_quaternions

if TYPE_CHECKING:
    from reina.rotations.arrays import ArrayLike, FloatArray


def to_matrix(q: ArrayLike) -> FloatArray:
    """Rotation matrices ``(..., 3, 3)`` that turn column vectors as ``q`` ``(..., 4)`` does."""
    quaternions = as_quaternions(q)
    x, y, z, w = (quaternions[..., i] for i in range(4))
    x2, y2, z2 = x + x, y + y, z + z
    xx, yy, zz = x * x2, y * y2, z * z2
    xy, xz, yz = x * y2, x * z2, y * z2
    wx, wy, wz = w * x2, w * y2, w * z2
    matrix = np.empty((*quaternions.shape[:-1], 3, 3))
    matrix[..., 0, 0] = 1.0 - (yy + zz)
    matrix[..., 0, 1] = xy - wz
    matrix[..., 0, 2] = xz + wy
    matrix[..., 1, 0] = xy + wz
    matrix[..., 1, 1] = 1.0 - (xx + zz)
    matrix[..., 1, 2] = yz - wx
    matrix[..., 2, 0] = xz - wy
    matrix[..., 2, 1] = yz + wx
    matrix[..., 2, 2] = 1.0 - (xx + yy)
    return matrix


def from_matrix(matrices: ArrayLike) -> FloatArray:
    """Unit quaternions ``(..., 4)`` of rotation matrices ``(..., 3, 3)``.

    Of the four rows of 4 q qᵀ, each linear in the matrix, the one with the largest diagonal is taken, so
    that no small number is ever divided by (Shepperd 1978). The component that was largest comes out
    positive.
    """
    m = np.asarray(matrices, dtype=np.float64)
    if m.shape[-2:] != (3, 3):
        raise ValueError(f"rotation matrices have the shape (..., 3, 3), not {m.shape}")
    m00, m11, m22 = m[..., 0, 0], m[..., 1, 1], m[..., 2, 2]
    rows = np.empty((*m.shape[:-2], 4, 4))
    rows[..., 0, 0] = 1.0 + m00 - m11 - m22
    rows[..., 1, 1] = 1.0 - m00 + m11 - m22
    rows[..., 2, 2] = 1.0 - m00 - m11 + m22
    rows[..., 3, 3] = 1.0 + m00 + m11 + m22
    rows[..., 0, 1] = rows[..., 1, 0] = m[..., 0, 1] + m[..., 1, 0]
    rows[..., 0, 2] = rows[..., 2, 0] = m[..., 0, 2] + m[..., 2, 0]
    rows[..., 1, 2] = rows[..., 2, 1] = m[..., 1, 2] + m[..., 2, 1]
    rows[..., 0, 3] = rows[..., 3, 0] = m[..., 2, 1] - m[..., 1, 2]
    rows[..., 1, 3] = rows[..., 3, 1] = m[..., 0, 2] - m[..., 2, 0]
    rows[..., 2, 3] = rows[..., 3, 2] = m[..., 1, 0] - m[..., 0, 1]
    best = np.argmax(np.einsum("...ii->...i", rows), axis=-1)
    flat = rows.reshape(-1, 4, 4)
    row = flat[np.arange(len(flat)), best.ravel()].reshape(*m.shape[:-2], 4)
    return row / np.sqrt(np.einsum("...i,...i->...", row, row))[..., None]
