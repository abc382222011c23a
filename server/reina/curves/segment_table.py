"""The segments of many channels in common rows."""

from collections.abc import Iterator, Sequence

import numpy as np

from reina.curves.arrays import FloatArray, IntArray
from reina.curves.channel import Channel, Stretch
from reina.curves.easings import EASE_IN, EaseIn
from reina.curves.spline_keyframe import spline_easing


class SegmentTable:
    """One row a segment, the channels' one below the other; what `Channel` says of it lies side by side.

    A row is read as a whole, so that a segment costs one visit to memory that is far away. It has no columns
    for what no channel has: slopes where nothing is a spline, origins where nothing turns.

    Attributes:
        rows: ``(S, R)``.
        begins: Column of the rows, and so `durations`, `directions` and `easing` (an index into `easings`).
        starts: Columns of the rows, and so `deltas`, `leaving`, `arriving`, `options` and `origins`.
        jumps: ``(S,)``.
        first: ``(C,)`` each channel's first row.
        easings: The easing functions in use; the first is linear.
        easings_with_options: Those of them that take options.
        stretches: Formulas of their own, by row.
        has_stretch: ``(S,)`` whether a row is among them.
        quaternion_row: ``(S,)`` row in `quaternions`, or -1; ``(0,)`` where there are none.
        quaternions: ``(n, 4, 4)`` splines of quaternions, see `Channel.quaternion_splines`.
    """

    begins, durations, directions, easing = range(4)

    def __init__(self, channels: Sequence[Channel]) -> None:
        sizes = [channel.begins.size for channel in channels]
        self.first: IntArray = np.cumsum([0, *sizes])[:-1].astype(np.int64)
        self.width = max((channel.space.width for channel in channels), default=0)
        option_count = max((channel.options.shape[1] for channel in channels), default=0)
        slopes = self.width if any(spline_easing in channel.easings for channel in channels) else 0
        origins = 4 if any(channel.space.length == 4 for channel in channels) else 0
        widths = iter([4, self.width, self.width, slopes, slopes, option_count, origins])
        places = _side_by_side(widths)
        next(places)
        self.starts, self.deltas, self.leaving, self.arriving, self.options, self.origins = places
        self.rows = np.zeros((sum(sizes), self.origins.stop))
        self.jumps = np.zeros(sum(sizes), dtype=np.int64)
        self.easings: list[EaseIn] = [EASE_IN["linear"]]
        self.easings_with_options = {
            easing for channel in channels for easing in channel.easings_with_options
        }
        self.stretches: dict[int, Stretch] = {}
        self.has_stretch = np.zeros(sum(sizes), dtype=np.bool_)
        splines = any(channel.quaternion_splines for channel in channels)
        self.quaternion_row = np.full(sum(sizes) if splines else 0, -1, dtype=np.int64)
        quaternions: list[FloatArray] = []
        for first, channel in zip(self.first.tolist(), channels, strict=True):
            self._lay_out(first, channel, quaternions)
        self.quaternions = np.array(quaternions).reshape(-1, 4, 4)

    def _lay_out(self, first: int, channel: Channel, quaternions: list[FloatArray]) -> None:
        here = slice(first, first + channel.begins.size)
        rows = self.rows[here]
        rows[:, self.begins] = channel.begins
        rows[:, self.durations] = channel.durations
        rows[:, self.directions] = channel.directions
        rows[:, self.easing] = np.array([self._easing_index(easing) for easing in channel.easings])[
            channel.easing
        ]
        width = channel.space.width
        rows[:, self.starts][:, :width] = channel.starts
        rows[:, self.deltas][:, :width] = channel.deltas
        if self.leaving.stop > self.leaving.start:
            rows[:, self.leaving][:, :width] = channel.leaving
            rows[:, self.arriving][:, :width] = channel.arriving
        rows[:, self.options][:, : channel.options.shape[1]] = channel.options
        if channel.space.length == 4:
            rows[:, self.origins] = channel.origins
        self.jumps[here] = channel.jumps
        for segment, stretch in channel.stretches.items():
            self.stretches[first + segment] = stretch
            self.has_stretch[first + segment] = True
        for segment, spline in channel.quaternion_splines.items():
            self.quaternion_row[first + segment] = len(quaternions)
            quaternions.append(spline)

    def _easing_index(self, easing: EaseIn) -> int:
        if easing not in self.easings:
            self.easings.append(easing)
        return self.easings.index(easing)


def _side_by_side(widths: Iterator[int]) -> Iterator[slice]:
    end = 0
    for width in widths:
        yield slice(end, end + width)
        end += width
