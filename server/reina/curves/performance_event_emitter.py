"""Gives one parameter's value at the performance's time."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any, Generic, cast

import numpy as np
from numpy.typing import NDArray

from reina.curves.arrays import FloatArray
from reina.curves.channel_bank import ChannelBank
from reina.curves.channel_builder import ChannelBuilder
from reina.curves.extrapolation import Extrapolation, fold
from reina.curves.keyframe import Keyframe, T
from reina.curves.spaces import ORIENTATION, PlainSpace, Space


class PerformanceEventEmitter(Generic[T]):
    """Keyframes of one value, evaluated at any time.

    The values are numbers, arrays of numbers, or objects of any class that can be added, subtracted and
    multiplied by a float; with `space` they are arrays that are interpolated in it (`OKLAB`, `ORIENTATION`).
    """

    def __init__(
        self,
        keyframes: Sequence[Keyframe[T]],
        *,
        now: Callable[[], float] | None = None,
        before: Extrapolation = "hold",
        after: Extrapolation = "hold",
        space: Space | None = None,
    ) -> None:
        """Sort the keyframes and make them ready.

        Args:
            keyframes: One at least, in any order, no two at one time.
            now: The performance's time, for `value`.
            before: What happens before the first keyframe.
            after: What happens after the last.
            space: What to interpolate in; None for plain arithmetic.

        Raises:
            ValueError: There is no keyframe, two stand at one time, or objects are to be extrapolated.
        """
        ordered = sorted(keyframes, key=lambda keyframe: keyframe.time)
        if not ordered:
            raise ValueError("an emitter has one keyframe at least")
        if any(a.time == b.time for a, b in pairwise(ordered)):
            raise ValueError("two keyframes stand at one time; give each its own")
        self.keyframes: tuple[Keyframe[T], ...] = tuple(ordered)
        values = _as_numbers(self.keyframes)
        if values is None and "extrapolate" in (before, after):
            raise ValueError(
                "only numbers and arrays can be extrapolated; hold, loop or ping_pong other objects"
            )
        self._now = now
        self._outside: tuple[Extrapolation, Extrapolation] = (before, after)
        self._bank: ChannelBank | None = None
        self._shape: tuple[int, ...] = ()
        if values is not None:
            self._shape = values.shape[1:]
            rows = values.reshape(values.shape[0], -1)
            builder = ChannelBuilder(
                self.keyframes,
                rows,
                space or PlainSpace(rows.shape[1]),
                in_tangents=_tangent_rows([keyframe.in_tangent for keyframe in ordered], rows),
                out_tangents=_tangent_rows([keyframe.out_tangent for keyframe in ordered], rows),
                before=before,
                after=after,
            )
            self._bank = ChannelBank([builder.channel()])

    def value(self) -> T:
        """The value at the performance's time.

        Raises:
            ValueError: The emitter was made without a `now`.
        """
        if self._now is None:
            raise ValueError("this emitter has no clock; give it now=, or ask value_at(time)")
        return self.value_at(self._now())

    def value_at(self, time: float) -> T:
        """The value at a time in the keyframes' unit: a float for numbers, else an array or an object."""
        found: Any = self.values_at(np.array([time]))[0]
        return cast("T", float(found)) if self._bank is not None and self._shape == () else cast("T", found)

    def values_at(self, times: FloatArray) -> NDArray[Any]:
        """The values at ``(F,)`` times: ``(F,)`` for numbers and objects, ``(F, ...)`` for arrays."""
        asked = np.asarray(times, dtype=np.float64)
        if self._bank is None:
            return self._objects_at(asked)
        found, quaternions = self._bank.evaluate(self._bank.locate(asked[None, :]))
        rows = quaternions[0] if self._bank.channels[0].space is ORIENTATION else found[:, 0].T
        return rows.reshape(asked.size, *self._shape)

    def _objects_at(self, times: FloatArray) -> NDArray[Any]:
        """Objects of any class: each segment's `eval` on arrays of objects, element by element."""
        keys: list[Keyframe[NDArray[Any]]] = [_boxed(keyframe) for keyframe in self.keyframes]
        key_times = np.array([keyframe.time for keyframe in self.keyframes])
        folded = fold(times, float(key_times[0]), float(key_times[-1]), *self._outside)[0]
        segment = key_times.searchsorted(folded, "right")
        found = np.empty(times.size, dtype=object)
        for index in sorted({int(i) for i in segment}):
            members = segment == index
            if 0 < index < len(keys):
                found[members] = keys[index].eval(keys[index - 1], folded[members, None])[:, 0]
            else:
                found[members] = keys[min(index, len(keys) - 1)].value
        return found


def _as_numbers(keyframes: Sequence[Keyframe[Any]]) -> FloatArray | None:
    """The values as one array ``(K, ...)``, or None where they are no numbers."""
    arrays = [np.asarray(keyframe.value) for keyframe in keyframes]
    if any(array.dtype.kind not in "biuf" for array in arrays):
        return None
    return np.stack(arrays).astype(np.float64)


def _tangent_rows(tangents: Sequence[Any], rows: FloatArray) -> FloatArray:
    zeros = np.zeros_like(rows)
    for row, tangent in zip(zeros, tangents, strict=True):
        if tangent is not None:
            row[:] = np.asarray(tangent, dtype=np.float64).reshape(-1)
    return zeros


def _boxed(keyframe: Keyframe[Any]) -> Keyframe[NDArray[Any]]:
    """The keyframe with its value boxed in an array, so that NumPy calls the object's own operators."""
    box = np.empty(1, dtype=object)
    box[0] = keyframe.value
    return replace(keyframe, value=box)
