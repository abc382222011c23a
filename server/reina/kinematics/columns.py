"""Vectors of K limbs in F frames, kept component by component, ``(3, K, F)``.

NumPy's innermost loop then goes over a whole block's frames instead of over three numbers, which on short
blocks is many times faster.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from reina.rotations.arrays import FloatArray

NEXT, LAST = np.array([1, 2, 0]), np.array([2, 0, 1])
"""Of x, y, z the component after each, and the one before."""


def columns(vectors: FloatArray) -> FloatArray:
    """``(F, K, N)`` as ``(N, K, F)``."""
    return np.ascontiguousarray(vectors.transpose(2, 1, 0))


def rows(vectors: FloatArray) -> FloatArray:
    """``(N, K, F)`` as ``(F, K, N)``."""
    return np.ascontiguousarray(vectors.transpose(2, 1, 0))


def dot_columns(a: FloatArray, b: FloatArray) -> FloatArray:
    """Dot products of vectors ``(3, ...)``."""
    return np.add.reduce(a * b)


def cross_columns(a: FloatArray, b: FloatArray) -> FloatArray:
    """Cross products of vectors ``(3, ...)``."""
    product = a.take(NEXT, axis=0)
    product *= b.take(LAST, axis=0)
    product -= a.take(LAST, axis=0) * b.take(NEXT, axis=0)
    return product
