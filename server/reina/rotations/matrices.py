"""Quaternions to rotation matrices ``(..., 3, 3)`` and back."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.rotations.products import product
from reina.rotations.quaternions import as_quaternions

if TYPE_CHECKING:
    from reina.rotations.arrays import ArrayLike, FloatArray


def _to_rows() -> FloatArray:
    """What each element of a matrix, row by row, adds to the elements of 4 q qᵀ, ``(9, 16)``."""
    rows = np.zeros((3, 3, 4, 4))
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        rows[i, i, i, i] = rows[i, i, 3, 3] = 1.0
        rows[i, i, j, j] = rows[i, i, k, k] = -1.0
        # m[i, j] + m[j, i] = 4 q_i q_j, m[k, j] - m[j, k] = 4 q_i w
        rows[i, j, i, j] = rows[i, j, j, i] = rows[j, i, i, j] = rows[j, i, j, i] = 1.0
        rows[k, j, i, 3] = rows[k, j, 3, i] = 1.0
        rows[j, k, i, 3] = rows[j, k, 3, i] = -1.0
    return rows.reshape(9, 16)


_TO_ROWS: FloatArray = _to_rows()
_DIAGONAL = slice(0, 16, 5)


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
    flat = m.reshape(*m.shape[:-2], 9) if m.ndim > 2 else m.reshape(1, 9)
    rows = product(flat, _TO_ROWS).reshape(-1, 16)
    rows[:, _DIAGONAL] += 1.0
    best = np.argmax(rows[:, _DIAGONAL], axis=-1)
    row = rows.reshape(-1, 4)[best + np.arange(0, 4 * len(rows), 4)].reshape(*m.shape[:-2], 4)
    return row / np.sqrt(np.einsum("...i,...i->...", row, row))[..., None]
