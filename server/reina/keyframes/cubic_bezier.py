"""The timing curve of CSS and of most editors: a cubic Bézier as a function of time."""

import numpy as np

from reina.keyframes.arrays import FloatArray

_STEPS = 60
_CLOSE_ENOUGH = 1e-15


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
    """The curve's parameter at abscissa x.

    Newton's method within a bracket that is halved where a step would leave it. With both x in
    0..1 the abscissa grows with the parameter, so the bracket always holds the one root.
    """
    c = 3.0 * x1
    b = 3.0 * x2 - 6.0 * x1
    a = 1.0 - c - b
    low, high = np.zeros_like(x), np.ones_like(x)
    s = x.copy()
    for _ in range(_STEPS):
        error = ((a * s + b) * s + c) * s - x
        if float(np.max(np.abs(error), initial=0.0)) <= _CLOSE_ENOUGH:
            break
        high = np.where(error > 0.0, s, high)
        low = np.where(error < 0.0, s, low)
        slope = (3.0 * a * s + 2.0 * b) * s + c
        step = s - error / np.where(slope > 1e-12, slope, np.inf)
        s = np.where((step > low) & (step < high), step, 0.5 * (low + high))
    return s
