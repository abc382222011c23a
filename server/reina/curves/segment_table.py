"""The segments of many channels in common rows."""

import itertools
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
        easings_with_options: Those of them that have options other than 0.
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
        self.jumps: IntArray = np.concatenate([np.zeros(0, np.int64), *(one.jumps for one in channels)])
        self.easings: list[EaseIn] = [EASE_IN["linear"]]
        self.stretches: dict[int, Stretch] = {}
        self.has_stretch = np.zeros(sum(sizes), dtype=np.bool_)
        splines = any(channel.quaternion_splines for channel in channels)
        self.quaternion_row = np.full(sum(sizes) if splines else 0, -1, dtype=np.int64)
        quaternions: list[FloatArray] = []
        for first, channel in zip(self.first.tolist(), channels, strict=True):
            for segment, stretch in channel.stretches.items():
                self.stretches[first + segment] = stretch
                self.has_stretch[first + segment] = True
            for segment, spline in channel.quaternion_splines.items():
                self.quaternion_row[first + segment] = len(quaternions)
                quaternions.append(spline)
        self.quaternions = np.array(quaternions).reshape(-1, 4, 4)
        first = 0
        # Neighbours whose rows are as wide are laid out in one go.
        for _, alike in itertools.groupby(channels, key=_widths):
            group = list(alike)
            end = first + sum(channel.begins.size for channel in group)
            self._lay_out(self.rows[first:end], group)
            first = end
        with_options = self.rows[:, self.options].any(axis=1)
        self.easings_with_options = {
            self.easings[int(code)] for code in np.unique(self.rows[with_options, self.easing])
        }

    def _lay_out(self, rows: FloatArray, channels: Sequence[Channel]) -> None:
        """Fill the rows of channels of one width."""
        width, turning = channels[0].space.width, channels[0].space.length == 4
        columns: list[tuple[slice, list[FloatArray]]] = [
            (slice(self.begins, self.begins + 1), [one.begins[:, None] for one in channels]),
            (slice(self.durations, self.durations + 1), [one.durations[:, None] for one in channels]),
            (slice(self.directions, self.directions + 1), [one.directions[:, None] for one in channels]),
            (slice(self.easing, self.easing + 1), [self._easing_codes(one)[:, None] for one in channels]),
            (self.starts, [one.starts for one in channels]),
            (self.deltas, [one.deltas for one in channels]),
            (self.leaving, [one.leaving for one in channels]),
            (self.arriving, [one.arriving for one in channels]),
            (self.options, [one.options for one in channels]),
        ]
        if turning:
            columns.append((self.origins, [one.origins for one in channels]))
        for place, parts in columns:
            if place.stop > place.start:
                into = rows[:, place]
                np.concatenate(parts, out=into[:, : parts[0].shape[1]])

    def _easing_codes(self, channel: Channel) -> IntArray:
        """Each segment's index into `easings`."""
        return np.array([self._easing_index(easing) for easing in channel.easings])[channel.easing]

    def _easing_index(self, easing: EaseIn) -> int:
        if easing not in self.easings:
            self.easings.append(easing)
        return self.easings.index(easing)


def _widths(channel: Channel) -> tuple[int, int, int]:
    return channel.space.width, channel.space.length, channel.options.shape[1]


def _side_by_side(widths: Iterator[int]) -> Iterator[slice]:
    end = 0
    for width in widths:
        yield slice(end, end + width)
        end += width
