"""Many channels evaluated at once.

What costs time in NumPy is the number of calls, not of numbers. So a block looks up the segment of every
channel at every time, sorts the samples by the easing functions of their segments, and calls each function
once for all of its samples.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reina.curves.arrays import FloatArray, IntArray
from reina.curves.channel import Channel
from reina.curves.easings import EaseIn, Reflection
from reina.curves.extrapolation import REPEATING, fold
from reina.curves.key_order import KeyOrder
from reina.curves.segment_table import SegmentTable
from reina.curves.spaces import OKLAB, ORIENTATION
from reina.curves.spline_keyframe import (
    arriving_weight,
    blend_weight,
    leaving_weight,
    quaternion_easing,
    spline_easing,
)


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
    """C channels: first all that are plain, then the colours in OKLab, then the orientations."""

    def __init__(self, channels: Sequence[Channel], units: Sequence[int] | None = None) -> None:
        """Lay the channels' segments out in common rows.

        Args:
            channels: In the order of their `rank`.
            units: Which row of times each of them goes by; all by the first when None.

        Raises:
            ValueError: The channels are not in the order of their `rank`.
        """
        ranks = [self.rank(channel) for channel in channels]
        if ranks != sorted(ranks):
            raise ValueError("the channels of a bank are in the order of their rank")
        self.channels = tuple(channels)
        self._table = SegmentTable(channels)
        self._units: IntArray = np.array(units or [0] * len(channels), dtype=np.int64)
        self._orders = [
            (unit, rows, KeyOrder([channels[row].times for row in rows.tolist()]))
            for unit in np.unique(self._units).tolist()
            for rows in [np.flatnonzero(self._units == unit)]
        ]
        self._colors = slice(ranks.count(0), ranks.count(0) + ranks.count(1))
        self._orientations = slice(self._colors.stop, len(channels))
        self._repeating = [
            (row, channel)
            for row, channel in enumerate(channels)
            if REPEATING & {channel.before, channel.after}
        ]

    @staticmethod
    def rank(channel: Channel) -> int:
        """Where in a bank a channel belongs: 0 plain, 1 colour in OKLab, 2 orientation."""
        return 1 if channel.space is OKLAB else 2 if channel.space is ORIENTATION else 0

    @property
    def width(self) -> int:
        """W: how many floats a channel's row of values has at most."""
        return self._table.width

    def locate(self, times: FloatArray) -> Samples:
        """Find the segments at ``times`` ``(U, Q)``, one row a unit."""
        local = np.empty((len(self.channels), times.shape[1]), dtype=np.int64)
        for unit, rows, order in self._orders:
            local[rows] = order.passed(times[unit])
        folded = times.take(self._units, axis=0)
        laps: list[tuple[int, IntArray, IntArray]] = []
        for row, channel in self._repeating:
            ends = (float(channel.times[0]), float(channel.times[-1]))
            folded[row], lap, way = fold(folded[row], *ends, channel.before, channel.after)
            local[row] = channel.times.searchsorted(folded[row], "right")
            laps.append((row, lap, way))
        segment = local + self._table.first[:, None]
        jumps = self._table.jumps.take(segment)
        for row, lap, way in laps:
            jumps[row] = _jumps_with_laps(self.channels[row], jumps[row], lap, way)
        return Samples(segment, folded, jumps)

    def evaluate(self, samples: Samples) -> tuple[FloatArray, FloatArray]:
        """The values at located times.

        Returns:
            Values ``(W, C, F)``, padded to the widest channel; those of orientations are rotation vectors.
            And the orientations' quaternions ``(O, F, 4)``.
        """
        table = self._table
        segment, t = samples.segment.reshape(-1), samples.times.reshape(-1)
        # Neighbouring samples mostly lie in one segment: each run of them reads its row once.
        changes = np.empty(segment.size, dtype=np.bool_)
        changes[:1] = True
        np.not_equal(segment[1:], segment[:-1], out=changes[1:])
        starts = np.flatnonzero(changes)
        run = np.zeros(segment.size, dtype=np.int64)
        run[starts[1:]] = 1
        run = run.cumsum()
        rows = table.rows.take(segment.take(starts), axis=0)
        columns = np.ascontiguousarray(rows.T)
        u = (t - columns[table.begins].take(run)) / columns[table.durations].take(run)
        reflection = Reflection.of(u, columns[table.directions].take(run))
        eased = reflection.at
        groups = self._by_easing(columns[table.easing], run)
        options, no_options = rows[:, table.options], np.zeros((eased.size, rows[:, table.options].shape[1]))
        for function, members in groups.items():
            chosen = no_options[: members.size]
            if function in table.easings_with_options:
                chosen = options.take(run.take(members), axis=0)
            eased[members] = function(eased.take(members), chosen)
        points = columns[table.deltas].take(run, axis=1)
        points *= reflection.read(eased)
        points += columns[table.starts].take(run, axis=1)
        if spline_easing in groups:
            members = groups[spline_easing]
            where, fraction = run[members], u[members]
            slopes = columns[table.leaving].take(where, axis=1) * leaving_weight(fraction)
            points[:, members] += slopes + columns[table.arriving].take(where, axis=1) * arriving_weight(
                fraction
            )
        if table.stretches:
            self._evaluate_stretches(points, segment, t)
        values = points.reshape(-1, *samples.segment.shape)
        colors = values[:3, self._colors]
        if colors.size:
            lab = colors.reshape(3, -1).T
            colors[...] = OKLAB.to_values(lab, lab).T.reshape(colors.shape)
        if self._orientations.start == len(self.channels):
            return values, np.zeros((0, samples.segment.shape[1], 4))
        turning = slice(self._orientations.start * samples.segment.shape[1], None)
        origins = rows[:, table.origins].take(run[turning], axis=0)
        quaternions = ORIENTATION.to_values(np.ascontiguousarray(points[:3, turning].T), origins)
        if quaternion_easing in groups:
            members = groups[quaternion_easing]
            quaternions[members - turning.start] = self._splines_of_quaternions(segment[members], u[members])
        return values, quaternions.reshape(-1, samples.segment.shape[1], 4)

    def _by_easing(self, easing_of_runs: FloatArray, run: IntArray) -> dict[EaseIn, IntArray]:
        """The samples of each easing function that is met, but for the linear one."""
        count = len(self._table.easings)
        easing = easing_of_runs.astype(np.uint8 if count < 256 else np.uint16).take(run)
        order = easing.argsort(kind="stable")
        ends = [*easing.take(order).searchsorted(np.arange(count, dtype=easing.dtype)).tolist(), easing.size]
        return {
            function: order[ends[code] : ends[code + 1]]
            for code, function in enumerate(self._table.easings)
            if code and ends[code] < ends[code + 1]
        }

    def _evaluate_stretches(self, points: FloatArray, segment: IntArray, t: FloatArray) -> None:
        own = np.flatnonzero(self._table.has_stretch.take(segment))
        for row in sorted(set(segment[own].tolist())):
            members = own[segment[own] == row]
            found = self._table.stretches[row](t[members, None])
            points[: found.shape[1], members] = found.T

    def _splines_of_quaternions(self, segment: IntArray, u: FloatArray) -> FloatArray:
        keys = self._table.quaternions[self._table.quaternion_row.take(segment)]
        fraction = u[:, None]
        q = keys[:, 0] + (keys[:, 2] - keys[:, 0]) * blend_weight(fraction)
        q += keys[:, 1] * leaving_weight(fraction) + keys[:, 3] * arriving_weight(fraction)
        sign = np.where(q[:, 3] < 0.0, -1.0, 1.0)
        return q * (sign / np.sqrt(np.einsum("ni,ni->n", q, q)))[:, None]


def _jumps_with_laps(channel: Channel, jumps: IntArray, laps: IntArray, ways: IntArray) -> IntArray:
    """Jumps gone by ``(Q,)``, those of whole laps included."""
    loops = np.where(laps > 0, channel.after == "loop", channel.before == "loop")
    whole = int(channel.jumps[-1])
    there_and_back = laps * whole + np.where(ways > 0, jumps, whole - jumps)
    return np.where(loops, laps * channel.jumps_a_lap + jumps, there_and_back)
