"""The timing curve of CSS and of most editors: a cubic Bézier as a function of time."""

import numpy as np

from reina.curves.arrays import FloatArray

_HALLEY_STEPS = 5
_HALVINGS = 53
_CLOSE_ENOUGH = 1e-13


def cubic_bezier(u: FloatArray, handles: FloatArray) -> FloatArray:
    """Height of the curve with handles (x1, y1), (x2, y2) where it has run ``u`` of its time.

    As CSS Easing Functions defines ``cubic-bezier()``; the handles' x lie in 0..1, so that the curve is a
    function of time, and their y anywhere. Outside 0..1 the ends hold.

    Args:
        u: Fractions of the time, ``(M,)``.
        handles: x1, y1, x2, y2 of each, ``(M, 4)``.

    Returns:
        ``(M,)``.
    """
    x1, y1, x2, y2 = handles[:, 0], handles[:, 1], handles[:, 2], handles[:, 3]
    time = np.clip(u, 0.0, 1.0)
    s = _parameter_at(time, x1, x2)
    height = _bezier(s, y1, y2)
    return np.where(time <= 0.0, 0.0, np.where(time >= 1.0, 1.0, height))


def _bezier(s: FloatArray, first: FloatArray, second: FloatArray) -> FloatArray:
    """3 (1-s)² s first + 3 (1-s) s² second + s³."""
    rest = 1.0 - s
    return ((3.0 * rest * first + 3.0 * s * second) * rest + s * s) * s


def _parameter_at(x: FloatArray, x1: FloatArray, x2: FloatArray) -> FloatArray:
    """The curve's parameter at abscissa x, the one root in 0..1 of a cubic that grows there.

    Halley's method, which is done after three steps for nearly every curve; what is left by then has a slope
    near 0 in its way, and is halved.
    """
    c = 3.0 * x1
    b = 3.0 * x2 - 6.0 * x1
    a = 1.0 - c - b
    s, thrice_a = x, 3.0 * a
    for _ in range(_HALLEY_STEPS):
        error = ((a * s + b) * s + c) * s - x
        far = np.abs(error) > _CLOSE_ENOUGH
        if not far.any():
            return s
        bend = thrice_a * s + b  # half of the second derivative
        slope = (bend + b) * s + c
        divisor = slope * slope - error * bend
        step = error * slope / np.where(divisor == 0.0, np.inf, divisor)
        # What is close enough stays, so that no bit of it depends on what else is asked for.
        s = np.where(far, np.minimum(np.maximum(s - step, 0.0), 1.0), s)
    left = np.flatnonzero(np.abs(((a * s + b) * s + c) * s - x) > _CLOSE_ENOUGH)
    if left.size:
        s[left] = _halved(x[left], a[left], b[left], c[left])
    return s


def _halved(x: FloatArray, a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
    """The root by halving, to the last bit."""
    low, high = np.zeros_like(x), np.ones_like(x)
    for _ in range(_HALVINGS):
        s = 0.5 * (low + high)
        beyond = ((a * s + b) * s + c) * s > x
        high = np.where(beyond, s, high)
        low = np.where(beyond, low, s)
    return 0.5 * (low + high)
