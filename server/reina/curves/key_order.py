"""The keys of many channels in one order of time, so that all channels find their segments at once."""

from collections.abc import Sequence

import numpy as np

from reina.curves.arrays import FloatArray, IntArray


class KeyOrder:
    """How many keys of each of C channels have gone by at a time.

    A block of frames is short beside a show, and few keys lie in it. So of all keys in order of time those
    before the block are counted by a table, and only those within it are looked at one by one.

    Args:
        times: Of each channel the keys' times, increasing.
    """

    def __init__(self, times: Sequence[FloatArray]) -> None:
        count = len(times)
        every: FloatArray = np.concatenate([*times, np.zeros(0)])
        order = every.argsort()
        self._times: FloatArray = every[order]
        self._channels = np.repeat(np.arange(count, dtype=np.int32), [one.size for one in times])[order]
        self._step = max(count, 1)
        stretch = np.arange(every.size) // self._step
        stretches = every.size // self._step + 1
        counts = np.bincount(self._channels + count * stretch, minlength=stretches * count)
        # Before each stretch of as many keys as there are channels, which each channel's have gone by.
        self._before = np.zeros((stretches + 1, count), dtype=np.int32)
        np.cumsum(counts.reshape(stretches, count), axis=0, out=self._before[1:])

    def passed(self, times: FloatArray) -> IntArray:
        """How many keys of each channel are not later than each of Q times: ``(C, Q)``."""
        if times.size == 0:
            return np.zeros((self._before.shape[1], 0), dtype=np.int64)
        if not np.all(times[1:] >= times[:-1]):
            order = times.argsort(kind="stable")
            unsorted = np.empty_like(order)
            unsorted[order] = np.arange(order.size)
            return self.passed(times[order]).take(unsorted, axis=1)
        count = self._before.shape[1]
        begin, end = self._times.searchsorted(times[[0, -1]], "right").tolist()
        stretch = begin // self._step
        first = self._channels[stretch * self._step : begin]
        at = times.searchsorted(self._times[begin:end])
        steps = np.bincount(
            self._channels[begin:end] * np.int64(times.size) + at, minlength=count * times.size
        )
        passed = steps.reshape(count, times.size)
        passed[:, 0] += self._before[stretch] + np.bincount(first, minlength=count)
        return passed.cumsum(axis=1)
