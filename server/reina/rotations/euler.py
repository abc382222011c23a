"""Euler angles in every order.

An order is written as the matrices are: ``"yzx"`` is R = Ry Rz Rx, each turn about the axes that
the turns before it have left (intrinsic; BVH's "Yrotation Zrotation Xrotation"). The same angles
about fixed axes are the reversed order.
Six orders have three different axes (Tait-Bryan), six repeat the first (proper Euler, ``"zxz"``).
"""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from reina.rotations.exponential import about_axis
from reina.rotations.quaternions import IDENTITY, as_quaternions, multiply

if TYPE_CHECKING:
    from reina.rotations.arrays import ArrayLike, FloatArray

ORDERS: tuple[str, ...] = tuple(
    "".join(axes) for axes in product("xyz", repeat=3) if axes[0] != axes[1] and axes[1] != axes[2]
)
"""The twelve orders that reach every rotation."""

_LOCKED_RAD = 1e-7


def from_euler(angles_rad: ArrayLike, order: str) -> FloatArray:
    """Quaternions ``(..., 4)`` of angles ``(..., n)``, one for each of the order's one to three letters."""
    angles = np.asarray(angles_rad, dtype=np.float64)
    axes = _axes(order)
    if angles.shape[-1] != len(axes):
        raise ValueError(f"order {order!r} has {len(axes)} angles, not {angles.shape[-1]}")
    q = IDENTITY
    for i, axis in enumerate(axes):
        q = multiply(q, about_axis(axis, angles[..., i])) if i else about_axis(axis, angles[..., 0])
    return q


def to_euler(q: ArrayLike, order: str) -> FloatArray:
    """Angles ``(..., 3)``, radians, of unit quaternions in one of `ORDERS`.

    The first and third angle lie in -pi..pi, the second in -pi/2..pi/2 (Tait-Bryan) or 0..pi (proper
    Euler). In gimbal lock, where first and third turn about one axis, the third is 0 and the first holds
    the whole turn. Method: Bernardes and Viollet 2022, "Quaternion to Euler angles conversion".

    Raises:
        ValueError: The order is none of `ORDERS`.
    """
    if order not in ORDERS:
        raise ValueError(f"Euler order {order!r} is not known; the orders are {', '.join(ORDERS)}")
    quaternions = as_quaternions(q)
    # The paper's axes are those of turns about fixed axes, which is our order reversed.
    k, j, i = _axes(order)
    proper = i == k
    if proper:
        k = 3 - i - j
    parity = float((i - j) * (j - k) * (k - i) // 2)
    w = quaternions[..., 3]
    qi, qj, qk = quaternions[..., i], quaternions[..., j], quaternions[..., k] * parity
    if proper:
        a, b, c, d = w, qi, qj, qk
    else:
        a, b, c, d = w - qj, qi + qk, qj + w, qk - qi
    middle = 2.0 * np.arctan2(np.hypot(c, d), np.hypot(a, b))
    half_sum = np.arctan2(b, a)
    half_difference = np.arctan2(d, c)
    at_zero = middle < _LOCKED_RAD
    at_pi = np.pi - middle < _LOCKED_RAD
    # In our order the fixed-axis first angle is the third: it is set to 0 in lock.
    third = np.where(at_zero | at_pi, 0.0, half_sum - half_difference)
    first = half_sum + half_difference
    first = np.where(at_zero, 2.0 * half_sum, np.where(at_pi, 2.0 * half_difference, first))
    if not proper:
        first = first * parity
        middle = middle - 0.5 * np.pi
    return np.stack([_wrap(first), middle, _wrap(third)], axis=-1)


def _axes(order: str) -> tuple[int, ...]:
    if not 1 <= len(order) <= 3 or any(letter not in "xyz" for letter in order):
        raise ValueError(f"Euler order {order!r} is not known; write one to three of the letters x, y, z")
    return tuple("xyz".index(letter) for letter in order)


def _wrap(angles: FloatArray) -> FloatArray:
    return angles - 2.0 * np.pi * np.round(angles / (2.0 * np.pi))
