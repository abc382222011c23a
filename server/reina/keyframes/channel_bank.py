"""Many channels evaluated at once.

All of a show's segments lie in common rows, and a block is a few operations on them.

What costs time in NumPy is the number of calls, not of numbers. So a block looks up the segment of every
channel at every time, sorts the samples by the pace function of their segments, and calls each function once
for all of its samples.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reina.keyframes.arrays import FloatArray, IntArray
from reina.keyframes.channel import Channel, Stretch
from reina.keyframes.easings import EASE_IN, EaseIn, Reflection
from reina.keyframes.outside import REPEATING, fold
from reina.keyframes.spaces import OKLAB, ORIENTATION
from reina.keyframes.spline_keyframe import arriving_weight, leaving_weight, spline_pace


@dataclass(frozen=True)
class Samples:
    """Where in its segments each channel is, at each of Q times.

    Attributes:
        segment: ``(C, Q)`` row of the segment among all.
        times: ``(C, Q)`` in the channel's own unit, folded where it repeats.
        jumps: ``(C, Q)`` jumps gone by since some time in the past.
    """

    segment: IntArray
    times: FloatArray
    jumps: IntArray

    def columns(self, columns: slice) -> "Samples":
        """Some of the times only."""
        return Samples(self.segment[:, columns], self.times[:, columns], self.jumps[:, columns])


class ChannelBank:
    """C channels, their segments in common rows."""

    def __init__(self, channels: Sequence[Channel]) -> None:
        self.channels = tuple(channels)
        counts = [channel.begins.size for channel in channels]
        self._first = np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
        self._searched = [channel.times for channel in channels]
        self._begins = _stacked([channel.begins for channel in channels])
        self._durations = _stacked([channel.durations for channel in channels])
        self._directions = _stacked([channel.directions for channel in channels])
        self._jumps = _stacked([channel.jumps.astype(np.float64) for channel in channels]).astype(np.int64)
        self._starts = _padded([channel.starts for channel in channels])
        self._deltas = _padded([channel.deltas for channel in channels])
        self._leaving = _padded([channel.leaving for channel in channels])
        self._arriving = _padded([channel.arriving for channel in channels])
        self._options = _padded([channel.options for channel in channels])
        self._paces: list[EaseIn] = [EASE_IN["linear"]]
        self._pace = np.concatenate([np.zeros(0, np.uint16), *map(self._pace_of, channels)]).astype(np.uint16)
        self._stretches: dict[int, Stretch] = {
            int(first) + segment: stretch
            for first, channel in zip(self._first, channels, strict=False)
            for segment, stretch in channel.stretches.items()
        }
        self._own_formula = np.zeros(self._begins.size, dtype=np.bool_)
        self._own_formula[list(self._stretches)] = True
        self._repeating = [
            (row, channel)
            for row, channel in enumerate(channels)
            if REPEATING & {channel.before, channel.after}
        ]
        self._colors = np.array(
            [i for i, channel in enumerate(channels) if channel.space is OKLAB], dtype=np.int64
        )
        self.orientations = np.array(
            [i for i, channel in enumerate(channels) if channel.space is ORIENTATION], dtype=np.int64
        )
        """Rows of the channels that are orientations, ascending."""
        origins = [channel.origins for channel in channels if channel.space is ORIENTATION]
        self._origins = np.concatenate([np.zeros((0, 4)), *origins])
        sizes = np.cumsum([0, *(origin.shape[0] for origin in origins)])[:-1]
        self._origin_shift = (sizes - self._first[self.orientations]).astype(np.int64)

    def _pace_of(self, channel: Channel) -> IntArray:
        for pace in channel.paces:
            if pace not in self._paces:
                self._paces.append(pace)
        return np.array([self._paces.index(pace) for pace in channel.paces])[channel.pace]

    def locate(self, times: FloatArray) -> "Samples":
        """Find the segments at ``times`` ``(C, Q)``, each channel's in its own unit."""
        rows, queries = times.shape
        local = np.empty((rows, queries), dtype=np.int64)
        folded = times
        laps: list[tuple[int, IntArray, IntArray]] = []
        for row, channel in self._repeating:
            if folded is times:
                folded = times.copy()
            ends = (float(channel.times[0]), float(channel.times[-1]))
            folded[row], lap, way = fold(times[row], *ends, channel.before, channel.after)
            laps.append((row, lap, way))
        for row, keys in enumerate(self._searched):
            local[row] = keys.searchsorted(folded[row], "right")
        segment = local + self._first[:-1, None]
        jumps = self._jumps.take(segment)
        for row, lap, way in laps:
            channel = self.channels[row]
            loops = np.where(lap > 0, channel.after == "loop", channel.before == "loop")
            whole = int(channel.jumps[-1])
            gone_by: IntArray = jumps[row]
            there_and_back = lap * whole + np.where(way > 0, gone_by, whole - gone_by)
            jumps[row] = np.where(loops, lap * channel.jumps_a_lap + gone_by, there_and_back)
        return Samples(segment, folded, jumps)

    def evaluate(self, samples: Samples) -> tuple[FloatArray, FloatArray]:
        """The values at located times.

        Returns:
            Values ``(C, F, W)``, W being the longest channel's width (what an orientation's row holds means
            nothing),
            and the orientations' quaternions ``(O, F, 4)``, in the order of `orientations`.
        """
        rows, frames = samples.segment.shape
        segment = samples.segment.reshape(-1)
        t = samples.times.reshape(-1)
        pace = self._pace.take(segment)
        u = (t - self._begins.take(segment)) / self._durations.take(segment)
        reflection = Reflection.of(u, self._directions.take(segment))
        eased = reflection.at.copy()
        spline_samples = np.zeros(0, dtype=np.int64)
        order = pace.argsort(kind="stable")
        bounds = np.cumsum(np.bincount(pace, minlength=len(self._paces))).tolist()
        for code in range(1, len(self._paces)):
            members = order[bounds[code - 1] : bounds[code]]
            if members.size == 0:
                continue
            function = self._paces[code]
            if function is spline_pace:
                spline_samples = members
            eased[members] = function(eased[members], self._options.take(segment[members], axis=0))
        way = reflection.read(eased)
        points = self._starts.take(segment, axis=0)
        points += self._deltas.take(segment, axis=0) * way[:, None]
        if spline_samples.size:
            where, fraction = segment[spline_samples], u[spline_samples, None]
            points[spline_samples] += self._leaving.take(where, axis=0) * leaving_weight(fraction)
            points[spline_samples] += self._arriving.take(where, axis=0) * arriving_weight(fraction)
        if self._stretches:
            self._evaluate_stretches(points, segment, t)
        values = points.reshape(rows, frames, -1)
        quaternions = self._orientation_values(values, samples.segment)
        if self._colors.size:
            values[self._colors, :, :3] = OKLAB.to_values(values[self._colors, :, :3], values)
        return values, quaternions

    def _evaluate_stretches(self, points: FloatArray, segment: IntArray, t: FloatArray) -> None:
        own = np.flatnonzero(self._own_formula.take(segment))
        for row in np.unique(segment[own]).tolist():
            members = own[segment[own] == row]
            values = self._stretches[row](t[members, None])
            points[members, : values.shape[1]] = values

    def _orientation_values(self, values: FloatArray, segment: IntArray) -> FloatArray:
        if self.orientations.size == 0:
            return np.zeros((0, values.shape[1], 4))
        origin = self._origins[segment[self.orientations] + self._origin_shift[:, None]]
        return ORIENTATION.to_values(values[self.orientations, :, :3], origin)


def _stacked(rows: list[FloatArray]) -> FloatArray:
    return np.concatenate([np.zeros(0), *rows])


def _padded(blocks: list[FloatArray]) -> FloatArray:
    """Blocks ``(n, w)`` one below the other, as wide as the widest, 0 where they are narrower."""
    width = max((block.shape[1] for block in blocks), default=0)
    padded = np.zeros((sum(block.shape[0] for block in blocks), width))
    row = 0
    for block in blocks:
        padded[row : row + block.shape[0], : block.shape[1]] = block
        row += block.shape[0]
    return padded
