"""Curves of time that were worked out at even steps, and are read in between."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from reina.rotations.arrays import ArrayLike, FloatArray


class SampledCurves:
    """Values at even steps of time, joined by cubic pieces (Catmull-Rom); outside, the end's value holds.

    Args:
        samples: ``(G, C)``, G ≥ 1.
        rate_hz: How many samples a second; the first is at time 0.
    """

    def __init__(self, samples: ArrayLike, rate_hz: float) -> None:
        values = np.asarray(samples, dtype=np.float64)
        self._rate = rate_hz
        self._last = len(values) - 1
        # One more before and two after, so that every time lies between two samples that have neighbours.
        self._values: FloatArray = np.concatenate([values[:1], values, values[-1:], values[-1:]])

    def evaluate(self, times_s: FloatArray) -> FloatArray:
        """Values ``(F, C)`` at times ``(F,)``, seconds."""
        place = np.minimum(np.maximum(times_s * self._rate, 0.0), float(self._last))
        before = place.astype(np.intp)
        u = (place - before)[:, None]
        p0, p1, p2, p3 = (self._values[before + step] for step in range(4))
        return p1 + 0.5 * u * (
            p2 - p0 + u * (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3 + u * (3.0 * (p1 - p2) + p3 - p0))
        )
