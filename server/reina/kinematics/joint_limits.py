"""Keeping joints within their limits."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.rotations import conjugate, from_euler, multiply, to_euler

if TYPE_CHECKING:
    from reina.rotations.arrays import ArrayLike, FloatArray
    from reina.skeleton import Limits


def limit_angles(rotations: ArrayLike, rest: ArrayLike, limits: Limits) -> FloatArray:
    """Euler angles of rest⁻¹·q in the limits' order ``(..., 3)``, radians.

    A rotation has two sets of angles; of them the one that breaks the limits less is taken, so that a hinge
    bent beyond 90° about the middle axis is not read as turned over about the other two.
    """
    first = to_euler(multiply(conjugate(rest), rotations), limits.order)
    middle = np.pi - first[..., 1] if _is_tait_bryan(limits.order) else -first[..., 1]
    second = np.stack([first[..., 0] + np.pi, middle, first[..., 2] + np.pi], axis=-1)
    second -= 2.0 * np.pi * np.round(second / (2.0 * np.pi))
    low, high = _bounds(limits)
    excess = [
        np.sum(np.maximum(np.maximum(low - angles, angles - high), 0.0), axis=-1)
        for angles in (first, second)
    ]
    return np.where((excess[1] < excess[0])[..., None], second, first)


def clamp_to_limits(rotations: ArrayLike, rest: ArrayLike, limits: Limits) -> FloatArray:
    """Rotations ``(..., 4)`` with each Euler angle brought into its range."""
    angles = limit_angles(rotations, rest, limits)
    low, high = _bounds(limits)
    return multiply(rest, from_euler(np.minimum(np.maximum(angles, low), high), limits.order))


def excess_over_limits(rotations: ArrayLike, rest: ArrayLike, limits: Limits) -> FloatArray:
    """By how much the worst Euler angle is out of its range, ``(...)``, radians; 0 within."""
    angles = limit_angles(rotations, rest, limits)
    low, high = _bounds(limits)
    return np.max(np.maximum(np.maximum(low - angles, angles - high), 0.0), axis=-1)


def _bounds(limits: Limits) -> tuple[FloatArray, FloatArray]:
    order = ["xyz".index(letter) for letter in limits.order]
    return np.array(limits.minimum)[order], np.array(limits.maximum)[order]


def _is_tait_bryan(order: str) -> bool:
    return order[0] != order[2]
