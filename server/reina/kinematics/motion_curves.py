"""Motion planned on the time axis: values that move from rest to rest, and are evaluated for any times."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from reina.rotations.arrays import ArrayLike, FloatArray, IntArray

Curve: TypeAlias = "tuple[FloatArray, float]"
"""Movements ``(start_s, end_s, value)``, ``(M, 3)``, and the value before the first."""


BEFORE_ALL_S = float(np.finfo(np.float64).min)
"""Times from there on are finite, and a movement at no speed has still come nowhere."""


def minimum_jerk(fraction: ArrayLike) -> FloatArray:
    """10u³ - 15u⁴ + 6u⁵ for u clipped to 0..1: a movement from rest to rest (Flash and Hogan 1985)."""
    u = np.minimum(np.maximum(np.asarray(fraction, dtype=np.float64), 0.0), 1.0)
    return np.minimum(u * u * u * (10.0 + u * (6.0 * u - 15.0)), 1.0)


class MotionCurves:
    """C curves of time, each a sequence of movements from one value to the next, held in between.

    A curve is a list of movements ``(start_s, end_s, value)``: from ``start_s`` to ``end_s`` it goes, with
    minimum jerk, from the value before to ``value``, which then holds. Movements do not overlap.

    Args:
        curves: By name: the movements ``(M, 3)``, in order of time, and the value before the first.

    Raises:
        ValueError: A movement ends before it starts or starts before the one before it ends.
    """

    def __init__(self, curves: Mapping[str, tuple[ArrayLike, float]]) -> None:
        self.names: tuple[str, ...] = tuple(curves)
        starts: list[FloatArray] = []
        rates: list[FloatArray] = []
        values: list[FloatArray] = []
        offsets: list[int] = []
        for name, (movements, initial) in curves.items():
            table = np.asarray(movements, dtype=np.float64).reshape(-1, 3)
            start, end, value = table[:, 0], table[:, 1], table[:, 2]
            if np.any(end < start) or np.any(start[1:] < end[:-1] - 1e-9):
                raise ValueError(f"the movements of {name!r} overlap or end before they start")
            offsets.append(sum(len(part) for part in starts))
            # A movement before all time puts the first value in place, so that every time lies in some
            # movement.
            starts.append(np.concatenate([[BEFORE_ALL_S], start]))
            rates.append(np.concatenate([[0.0], 1.0 / np.maximum(end - start, 1e-9)]))
            values.append(np.concatenate([[initial], value]))
        self._offsets: IntArray = np.array(offsets, dtype=np.intp)[:, None]
        self._starts: FloatArray = np.concatenate(starts)
        self._rate: FloatArray = np.concatenate(rates)
        self._value: FloatArray = np.concatenate(values)

    def evaluate(self, times_s: FloatArray) -> FloatArray:
        """The curves' values ``(C, F)`` at times ``(F,)``."""
        place = np.empty((len(self.names), times_s.size), dtype=np.intp)
        begins = self._offsets[:, 0].tolist()
        for row, (begin, end) in enumerate(pairwise([*begins, len(self._starts)])):
            place[row] = self._starts[begin:end].searchsorted(times_s, side="right")
        place += self._offsets - 1
        u = (times_s - self._starts[place]) * self._rate[place]
        u = np.minimum(np.maximum(u, 0.0), 1.0)
        done = np.minimum(u * u * u * (10.0 + u * (6.0 * u - 15.0)), 1.0)
        value = self._value[place]
        change = value - self._value[np.maximum(place - 1, self._offsets)]
        return value - change * (1.0 - done)

    def index(self, names: Sequence[str]) -> IntArray:
        """Rows of `evaluate` for curve names; ValueError where one is not there."""
        return np.array([self.names.index(name) for name in names], dtype=np.intp)
