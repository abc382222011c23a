"""Unit quaternions as arrays ``(..., 4)`` in the order x, y, z, w.

Leading axes broadcast, so every function takes one quaternion or a block of frames alike. Quaternions are
taken to be unit; nothing but `normalize` scales them. ``multiply(a, b)`` turns by ``b`` first and then by
``a``, as matrices do.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from reina.rotations.arrays import ArrayLike, FloatArray

IDENTITY: FloatArray = np.array([0.0, 0.0, 0.0, 1.0])
IDENTITY.flags.writeable = False

_CONJUGATE: FloatArray = np.array([-1.0, -1.0, -1.0, 1.0])


def as_quaternions(q: ArrayLike) -> FloatArray:
    """``q`` as a float64 array ``(..., 4)`` whose last axis is contiguous; no copy where it is."""
    array = np.asarray(q, dtype=np.float64)
    if array.ndim == 0 or array.shape[-1] != 4:
        raise ValueError(f"quaternions have the shape (..., 4), x y z w, not {array.shape}")
    return array if array.strides[-1] == array.itemsize else np.ascontiguousarray(array)


def multiply(a: ArrayLike, b: ArrayLike) -> FloatArray:
    """Hamilton product ``a b``, ``(..., 4)``: the rotation ``b`` followed by ``a``, both about fixed axes.

    A quaternion is two complex numbers over k: q = A + B i with A = w + z k, B = x + y k, and i A = conj(A)
    i. Hence A' = A1 A2 - B1 conj(B2) and B' = A1 B2 + B1 conj(A2): four products of whole complex arrays in
    place of sixteen of real ones. In memory x, y are B, and z, w are C = k conj(A), so that
    B' = k conj(C1) B2 - k B1 C2 and C' = -k C1 C2 - k conj(B1) B2. The left factor is multiplied by -k
    beforehand: one pass over whole memory, where the two halves of the result would take two over every
    other number of it.
    """
    left = as_quaternions(a).view(np.complex128) * -1j
    right = as_quaternions(b).view(np.complex128)
    conjugated = left.conj()
    b2, c2 = right[..., 0], right[..., 1]
    xy = left[..., 0] * c2
    xy += conjugated[..., 1] * b2
    zw = left[..., 1] * c2
    zw -= conjugated[..., 0] * b2
    halves = np.empty((*xy.shape, 2), dtype=np.complex128)
    halves[..., 0], halves[..., 1] = xy, zw
    return halves.view(np.float64)


def conjugate(q: ArrayLike) -> FloatArray:
    """The inverse of unit quaternions, ``(..., 4)``."""
    return as_quaternions(q) * _CONJUGATE


def normalize(q: ArrayLike) -> FloatArray:
    """``q`` scaled to unit length, ``(..., 4)``.

    Raises:
        ValueError: A quaternion is zero or not finite, so that it names no rotation.
    """
    array = as_quaternions(q)
    # Scaling by the largest component first keeps tiny and huge quaternions from under- or overflowing.
    largest = np.max(np.abs(array), axis=-1, keepdims=True)
    if not np.all(np.isfinite(largest)) or np.any(largest == 0.0):
        raise ValueError("a quaternion that is zero or not finite is no rotation")
    scaled = array / largest
    return scaled / np.sqrt(np.sum(scaled * scaled, axis=-1, keepdims=True))


def rotate(q: ArrayLike, vectors: ArrayLike) -> FloatArray:
    """``vectors`` ``(..., 3)`` turned by ``q`` ``(..., 4)``: the vector part of q v q⁻¹."""
    quaternions = as_quaternions(q)
    v = np.asarray(vectors, dtype=np.float64)
    pure = np.zeros((*v.shape[:-1], 4))
    pure[..., :3] = v
    return multiply(multiply(quaternions, pure), quaternions * _CONJUGATE)[..., :3]


def cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Cross product over the last axis, ``(..., 3)``; on small blocks far faster than `numpy.cross`."""
    # x y z x y, so that the cyclic shifts of a vector are slices of it.
    a_cycle, b_cycle = np.empty((*a.shape[:-1], 5)), np.empty((*b.shape[:-1], 5))
    a_cycle[..., :3], a_cycle[..., 3:] = a, a[..., :2]
    b_cycle[..., :3], b_cycle[..., 3:] = b, b[..., :2]
    product = a_cycle[..., 1:4] * b_cycle[..., 2:5]
    product -= a_cycle[..., 2:5] * b_cycle[..., 1:4]
    return product


def dot(a: ArrayLike, b: ArrayLike) -> FloatArray:
    """Dot product over the last axis, ``(...)``."""
    return np.einsum("...i,...i->...", np.asarray(a, dtype=np.float64), np.asarray(b, dtype=np.float64))


def angle_between(a: ArrayLike, b: ArrayLike) -> FloatArray:
    """The angle of the rotation from ``a`` to ``b``, radians in 0..pi, ``(...)``.

    4 atan2(|a - b|, |a + b|) for the nearer of b and -b: as exact at 0 and at pi as in between, where acos
    of the dot product loses half of its digits.
    """
    first, second = as_quaternions(a), as_quaternions(b)
    minus = np.sqrt(np.sum((first - second) ** 2, axis=-1))
    plus = np.sqrt(np.sum((first + second) ** 2, axis=-1))
    return 4.0 * np.arctan2(np.minimum(minus, plus), np.maximum(minus, plus))


def same_hemisphere(q: ArrayLike, reference: ArrayLike) -> FloatArray:
    """``q`` or ``-q``, whichever has dot(q, reference) >= 0, ``(..., 4)``; the rotation is the same."""
    quaternions = as_quaternions(q)
    sign = np.where(dot(quaternions, reference) < 0.0, -1.0, 1.0)
    return quaternions * sign[..., None]


def continuous(q: ArrayLike, axis: int = 0) -> FloatArray:
    """A sequence ``(..., 4)`` with each quaternion's sign chosen nearest the one before along ``axis``.

    The first keeps its sign.
    """
    quaternions = np.moveaxis(as_quaternions(q), axis, 0)
    if quaternions.shape[0] < 2:
        return np.moveaxis(quaternions.copy(), 0, axis)
    steps = np.where(dot(quaternions[1:], quaternions[:-1]) < 0.0, -1.0, 1.0)
    signs = np.concatenate([np.ones((1, *steps.shape[1:])), np.cumprod(steps, axis=0)])
    return np.moveaxis(quaternions * signs[..., None], 0, axis)
