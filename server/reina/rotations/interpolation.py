"""Interpolation of orientations: slerp, and splines through a sequence of them."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np

from reina.rotations.exponential import exp, exp_matrix, log, log_matrix
from reina.rotations.quaternions import as_quaternions, conjugate, continuous, dot, multiply

if TYPE_CHECKING:
    from reina.rotations.arrays import ArrayLike, FloatArray, IntArray


def slerp(a: ArrayLike, b: ArrayLike, fraction: ArrayLike, *, shortest: bool = True) -> FloatArray:
    """Spherical linear interpolation ``(..., 4)`` (Shoemake 1985): constant speed along the shortest path.

    Equal to a exp(t log(a⁻¹ b)). The angle comes from 2 atan2(|a-b|, |a+b|), so that near ends need no
    formula of their own. Between a and -a (``shortest`` false) no path is the shortest: the result is either.

    Args:
        a: Orientations at fraction 0, ``(..., 4)``.
        b: Orientations at fraction 1, ``(..., 4)``.
        fraction: ``(...)``, broadcast against the quaternions' leading axes; may lie outside 0..1.
        shortest: Take the nearer of b and -b.
    """
    first, second = as_quaternions(a), as_quaternions(b)
    t = np.asarray(fraction, dtype=np.float64)
    if shortest:
        second = second * np.where(dot(first, second) < 0.0, -1.0, 1.0)[..., None]
    minus = np.sqrt(np.sum((first - second) ** 2, axis=-1))
    plus = np.sqrt(np.sum((first + second) ** 2, axis=-1))
    half_angle = 2.0 * np.arctan2(minus, plus)
    whole = np.sinc(half_angle / np.pi)
    weight_a = (1.0 - t) * np.sinc((1.0 - t) * half_angle / np.pi) / whole
    weight_b = t * np.sinc(t * half_angle / np.pi) / whole
    q = weight_a[..., None] * first + weight_b[..., None] * second
    length = np.sqrt(np.sum(q * q, axis=-1, keepdims=True))
    return np.where(length == 0.0, first, q / np.where(length == 0.0, 1.0, length))


def slerp_matrix(a: ArrayLike, b: ArrayLike, fraction: ArrayLike) -> FloatArray:
    """R1 exp(t log(R1ᵀ R2)) on matrices ``(..., 3, 3)``, the same curve as `slerp`."""
    first = np.asarray(a, dtype=np.float64)
    second = np.asarray(b, dtype=np.float64)
    difference = log_matrix(np.swapaxes(first, -1, -2) @ second)
    return first @ exp_matrix(np.asarray(fraction, dtype=np.float64)[..., None] * difference)


def squad_controls(q: ArrayLike) -> FloatArray:
    """Shoemake's inner control points ``(N, ..., 4)`` for `squad` through ``q`` ``(N, ..., 4)``, N >= 2.

    s_i = q_i exp(-(log(q_i⁻¹ q_{i+1}) + log(q_i⁻¹ q_{i-1})) / 4); at the ends s = q. ``q`` should be sign
    continuous (`continuous`).
    """
    keys = as_quaternions(q)
    controls = keys.copy()
    if keys.shape[0] > 2:
        inverse = conjugate(keys[1:-1])
        bend = log(multiply(inverse, keys[2:])) + log(multiply(inverse, keys[:-2]))
        controls[1:-1] = multiply(keys[1:-1], exp(-0.25 * bend))
    return controls


def squad(times: ArrayLike, q: ArrayLike, at: ArrayLike) -> FloatArray:
    """A smooth curve ``(F, ..., 4)`` through ``q`` ``(N, ..., 4)`` at increasing ``times`` ``(N,)``.

    Shoemake's squad; its velocity is continuous where the times are evenly spaced. Outside the times the
    first and the last orientation hold. For uneven times use `spline`.
    """
    knots, keys, index, fraction = _segment(times, q, at)
    if knots.size == 1:
        return np.broadcast_to(keys[0], (index.size, *keys.shape[1:])).copy()
    controls = squad_controls(keys)
    outer = slerp(keys[index], keys[index + 1], fraction, shortest=False)
    inner = slerp(controls[index], controls[index + 1], fraction, shortest=False)
    return slerp(outer, inner, 2.0 * fraction * (1.0 - fraction), shortest=False)


def spline(times: ArrayLike, q: ArrayLike, at: ArrayLike) -> FloatArray:
    """A C1 curve ``(F, ..., 4)`` through orientations at uneven ``times``: cumulative cubic Bézier segments.

    Each segment is the de Casteljau construction on the sphere's great arcs with inner points q exp(±v
    Δt/3); the angular velocity v at a key is the mean of the two neighbouring chords' (weighted as in a
    Catmull-Rom spline over uneven knots), none at the ends, and is shared by the segments on both sides.
    Outside the times the ends hold.
    """
    knots, keys, index, fraction = _segment(times, q, at)
    if knots.size == 1:
        return np.broadcast_to(keys[0], (index.size, *keys.shape[1:])).copy()
    tail = (1,) * (keys.ndim - 2)
    steps = np.diff(knots).reshape(-1, *tail, 1)
    chords = log(multiply(conjugate(keys[:-1]), keys[1:])) / steps  # rad/s, in the earlier key's frame
    velocity = np.zeros((*keys.shape[:-1], 3))
    if knots.size > 2:
        # A turn about its own axis is the same vector in both keys' frames, so both chords are in the
        # middle key's.
        velocity[1:-1] = (chords[:-1] * steps[1:] + chords[1:] * steps[:-1]) / (steps[:-1] + steps[1:])
    leaving = multiply(keys[:-1], exp(velocity[:-1] * steps / 3.0))
    arriving = multiply(keys[1:], exp(-velocity[1:] * steps / 3.0))
    points = [keys[index], leaving[index], arriving[index], keys[index + 1]]
    while len(points) > 1:
        points = [slerp(p, n, fraction) for p, n in itertools.pairwise(points)]
    return points[0]


def _segment(
    times: ArrayLike, q: ArrayLike, at: ArrayLike
) -> tuple[FloatArray, FloatArray, IntArray, FloatArray]:
    """Knots, sign-continuous keys, and each query's segment and fraction (shaped to broadcast over keys)."""
    knots = np.asarray(times, dtype=np.float64)
    keys = continuous(q)
    if knots.ndim != 1 or knots.size == 0 or keys.shape[0] != knots.size:
        raise ValueError(
            f"{knots.shape} times do not go with orientations of shape {keys.shape}; give one time each"
        )
    if np.any(np.diff(knots) <= 0.0):
        raise ValueError("the times of a spline's orientations must increase")
    query = np.clip(np.asarray(at, dtype=np.float64), knots[0], knots[-1])
    index = np.clip(np.searchsorted(knots, query, side="right") - 1, 0, max(knots.size - 2, 0))
    width = np.diff(knots)[index] if knots.size > 1 else np.ones(query.shape)
    fraction = (query - knots[index]) / width
    return knots, keys, index, fraction.reshape(fraction.shape + (1,) * (keys.ndim - 2))
