"""Slopes at the keys of automatic and clamped splines, found from the neighbouring keys.

At a key between two moving segments the slope is one number for both sides, which makes the curve smooth
(C1). Where the value rests on one side (before a step, or at an end that holds) the slope is 0, so that it
comes to rest and sets off gently.
"""

import numpy as np

from reina.curves.arrays import BoolArray, FloatArray
from reina.rotations import cross


def automatic_slopes(chords: FloatArray, durations: FloatArray) -> FloatArray:
    """Slopes at inner keys: those of the parabola through the key and its two neighbours.

    Args:
        chords: Slopes of the straight lines, ``(S, W)``.
        durations: ``(S,)``, positive.

    Returns:
        ``(S - 1, W)``.
    """
    before, after = durations[:-1, None], durations[1:, None]
    return (after * chords[:-1] + before * chords[1:]) / (before + after)


def clamped_slopes(chords: FloatArray, durations: FloatArray) -> FloatArray:
    """Slopes at inner keys that keep the curve between its keys, component by component; arguments as above.

    The weighted harmonic mean of F. N. Fritsch and J. Butland, "A method for constructing local monotone
    piecewise cubic interpolants", SIAM J. Sci. Stat. Comput. 5 (1984); 0 where the direction turns.
    """
    first, second = chords[:-1], chords[1:]
    before, after = durations[:-1, None], durations[1:, None]
    onward = first * second > 0.0
    weight_first, weight_second = before + 2.0 * after, 2.0 * before + after
    safe_first, safe_second = np.where(onward, first, 1.0), np.where(onward, second, 1.0)
    mean = (weight_first + weight_second) / (weight_first / safe_first + weight_second / safe_second)
    return np.where(onward, mean, 0.0)


def key_slopes(
    chords: FloatArray,
    durations: FloatArray,
    moving: BoolArray,
    *,
    clamped: bool,
    ends: tuple[str, str],
    closed: bool,
) -> FloatArray:
    """Slopes at all keys of a track, ``(S + 1, W)``.

    Args:
        chords: Slopes of the straight lines between keys, ``(S, W)``.
        durations: ``(S,)``.
        moving: ``(S,)`` whether a segment moves to its end; false for steps.
        clamped: Whether to keep within the keys.
        ends: What happens before the first key and after the last; ``extrapolate`` takes the end's own line.
        closed: Whether the track is a loop whose end meets its beginning.
    """
    count, width = chords.shape
    slopes = np.zeros((count + 1, width))
    inner = clamped_slopes if clamped else automatic_slopes
    if count > 1:
        slopes[1:-1] = np.where((moving[:-1] & moving[1:])[:, None], inner(chords, durations), 0.0)
    if closed and moving[0] and moving[-1]:
        around = inner(chords[[-1, 0]], durations[[-1, 0]])
        slopes[0] = slopes[-1] = around[0]
        return slopes
    if ends[0] == "extrapolate" and moving[0]:
        slopes[0] = chords[0]
    if ends[1] == "extrapolate" and moving[-1]:
        slopes[-1] = chords[-1]
    return slopes


def rotation_vector_rates(rotation_vectors: FloatArray, angular_velocities: FloatArray) -> FloatArray:
    """How fast a rotation vector changes when the body turns at an angular velocity in its frame, ``(S, 3)``.

    The inverse of the right Jacobian of SO(3) (J. Solà, J. Deray, D. Atchuthan, "A micro Lie theory", 2018,
    equation 144).
    """
    angle = np.sqrt(np.sum(rotation_vectors * rotation_vectors, axis=-1, keepdims=True))
    half = 0.5 * angle
    small = angle < 1e-4
    safe = np.where(small, 1.0, half)
    # 1/θ² - (1 + cos θ)/(2 θ sin θ) = (1 - (θ/2) cot(θ/2)) / θ²; its limit at 0 is 1/12.
    factor = np.where(small, 1.0 / 12.0, (1.0 - safe / np.tan(safe)) / (4.0 * safe * safe))
    once = cross(rotation_vectors, angular_velocities)
    return angular_velocities + 0.5 * once + factor * cross(rotation_vectors, once)
