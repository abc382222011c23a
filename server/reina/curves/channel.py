"""A channel: one track's keys, or a part of them, made ready to be evaluated at many times at once."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reina.curves.arrays import FloatArray, IntArray
from reina.curves.easings import EaseIn
from reina.curves.extrapolation import Extrapolation
from reina.curves.spaces import Space

Stretch = Callable[[FloatArray], FloatArray]
"""Times ``(F, 1)`` within one segment -> points ``(F, W)``."""


@dataclass(frozen=True, eq=False)
class Channel:
    """K keys as K + 1 segments: before the first key, between each two, after the last.

    A point at time t is start + delta · easing((t - begin) / duration), for splines with the slopes' parts
    added; segments with a formula of their own stand in `stretches`. What does not move has delta 0.

    Attributes:
        space: What the points mean.
        before: What happens before the first key.
        after: What happens after the last.
        times: ``(K,)``, increasing.
        begins: ``(K + 1,)``.
        durations: ``(K + 1,)``; 1 outside of the keys.
        starts: ``(K + 1, W)``.
        deltas: ``(K + 1, W)``.
        leaving: ``(K + 1, W)`` slope at the beginning times the duration; 0 but for splines.
        arriving: ``(K + 1, W)`` slope at the end times the duration.
        origins: ``(K + 1, L)`` value at each segment's beginning, for `space`.
        easings: The ease-in functions in use; the first is linear.
        easings_with_options: Those of them that take options.
        easing: ``(K + 1,)`` index into `easings`.
        directions: ``(K + 1,)`` codes of `DIRECTION_CODES`.
        options: ``(K + 1, Q)`` the ease-ins' options.
        stretches: Segments with a formula of their own.
        quaternion_splines: Orientation segments that are splines of the quaternion's components: ``(4, 4)``
            start, slope there times the duration, end, slope there times the duration.
        jumps: ``(K + 1,)`` how many keys up to the segment's beginning are come to by a jump.
        jumps_a_lap: How many jumps a whole loop has, the one from its end to its beginning included.
    """

    space: Space
    before: Extrapolation
    after: Extrapolation
    times: FloatArray
    begins: FloatArray
    durations: FloatArray
    starts: FloatArray
    deltas: FloatArray
    leaving: FloatArray
    arriving: FloatArray
    origins: FloatArray
    easings: tuple[EaseIn, ...]
    easings_with_options: frozenset[EaseIn]
    easing: NDArray[np.int16]
    directions: NDArray[np.int8]
    options: FloatArray
    stretches: Mapping[int, Stretch]
    quaternion_splines: Mapping[int, FloatArray]
    jumps: IntArray
    jumps_a_lap: int
