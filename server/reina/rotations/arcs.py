"""The shortest arc from one direction to another, and a rotation taken apart into swing and twist."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.rotations.quaternions import as_quaternions, conjugate, cross, dot, multiply

if TYPE_CHECKING:
    from reina.rotations.arrays import ArrayLike, FloatArray


def shortest_arc(start: ArrayLike, end: ArrayLike) -> FloatArray:
    """The smallest rotation ``(..., 4)`` that turns direction ``start`` into ``end``, ``(..., 3)`` each.

    The vectors need not be unit but must not be zero. For opposite directions, where every axis across them
    serves, the axis is the one that leans least on the start's own largest component, so the result is
    still defined.
    """
    a, b = _unit(start), _unit(end)
    a, b = np.broadcast_arrays(a, b)
    # |a + b| = 2 cos(half), |a - b| = 2 sin(half): no cancellation at either end.
    plus = np.sqrt(np.sum((a + b) ** 2, axis=-1))
    minus = np.sqrt(np.sum((a - b) ** 2, axis=-1))
    axis = cross(a, b)
    length: FloatArray = np.sqrt(np.sum(axis * axis, axis=-1))
    across = cross(a, np.eye(3)[np.argmin(np.abs(a), axis=-1)])
    opposite = length < 1e-12
    axis = np.where(opposite[..., None], across, axis)
    length = np.where(opposite, np.sqrt(np.sum(across * across, axis=-1)), length)
    q = np.empty((*a.shape[:-1], 4))
    q[..., :3] = axis * (0.5 * minus / length)[..., None]
    q[..., 3] = 0.5 * plus
    return q / np.sqrt(np.sum(q * q, axis=-1, keepdims=True))


def swing_twist(q: ArrayLike, axis: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """``q = swing · twist``: a turn about unit ``axis`` ``(..., 3)``, then one about an axis across it.

    Where ``q`` turns the axis right round by pi the twist is undetermined and taken as none.

    Returns:
        Swing and twist, ``(..., 4)`` each.
    """
    quaternions = as_quaternions(q)
    direction = np.asarray(axis, dtype=np.float64)
    along = dot(quaternions[..., :3], direction)
    twist = np.empty(np.broadcast_shapes(quaternions.shape, (*direction.shape[:-1], 4)))
    twist[..., :3] = direction * along[..., None]
    twist[..., 3] = quaternions[..., 3]
    length = np.sqrt(np.sum(twist * twist, axis=-1, keepdims=True))
    undetermined = length < 1e-14
    twist = np.where(undetermined, (0.0, 0.0, 0.0, 1.0), twist / np.where(undetermined, 1.0, length))
    return multiply(quaternions, conjugate(twist)), twist


def twist_angle(q: ArrayLike, axis: ArrayLike) -> FloatArray:
    """The angle of the twist of ``q`` about unit ``axis``, radians in -pi..pi, ``(...)``."""
    quaternions = as_quaternions(q)
    along = dot(quaternions[..., :3], axis)
    sign = np.where(quaternions[..., 3] < 0.0, -1.0, 1.0)
    return 2.0 * np.arctan2(along * sign, np.abs(quaternions[..., 3]))


def _unit(vectors: ArrayLike) -> FloatArray:
    array = np.asarray(vectors, dtype=np.float64)
    length = np.sqrt(np.sum(array * array, axis=-1, keepdims=True))
    if np.any(length == 0.0):
        raise ValueError("a direction of length zero points nowhere")
    return array / length
