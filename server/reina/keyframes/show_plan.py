"""A show made ready: values of all parameters at many times, a pure function of the times."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.keyframes.arrays import BoolArray, FloatArray, IntArray
from reina.keyframes.channel import Channel
from reina.keyframes.channel_bank import ChannelBank
from reina.keyframes.channel_builder import ChannelBuilder
from reina.keyframes.parameter import Parameter
from reina.keyframes.parameter_registry import ParameterRegistry
from reina.keyframes.spaces import ORIENTATION, spaces_of
from reina.keyframes.time_map import TIME_UNITS, TimeMap
from reina.keyframes.track import Track

if TYPE_CHECKING:
    from reina.keyframes.show import Show


@dataclass(frozen=True, eq=False)
class TrackPlan:
    """A track made ready: one channel, or three for a transform.

    Attributes:
        track: What it was made of.
        parameter: The parameter it drives.
        channels: One after another they hold the parameter's floats.
    """

    track: Track
    parameter: Parameter
    channels: tuple[Channel, ...]

    @classmethod
    def make(cls, track: Track, parameter: Parameter) -> "TrackPlan":
        """Make a track ready."""
        values = np.stack([parameter.floats(keyframe.value) for keyframe in track.keyframes])
        in_tangents, out_tangents = _tangents(track, parameter)
        channels: list[Channel] = []
        first = 0
        for space in spaces_of(parameter, track.color_space):
            part = slice(first, first + space.length)
            builder = ChannelBuilder(
                track.keyframes,
                values[:, part],
                space,
                in_tangents=in_tangents[:, part],
                out_tangents=out_tangents[:, part],
                before=track.before,
                after=track.after,
            )
            channels.append(builder.channel())
            first += space.length
        return cls(track, parameter, tuple(channels))


def _tangents(track: Track, parameter: Parameter) -> tuple[FloatArray, FloatArray]:
    shape = (len(track.keyframes), parameter.length)
    arriving, leaving = np.zeros(shape), np.zeros(shape)
    for index, keyframe in enumerate(track.keyframes):
        if keyframe.in_tangent is not None:
            arriving[index] = keyframe.in_tangent
        if keyframe.out_tangent is not None:
            leaving[index] = keyframe.out_tangent
    return arriving, leaving


class ShowPlan:
    """All parameters of a registry over time, as a show says, or at their defaults.

    Attributes:
        registry: The parameters, in the order of the values.
        time_map: How the music's time runs.
        fps: The grid on which cuts are looked for.
        tracks: The tracks in effect, by their parameters' paths.
    """

    def __init__(
        self,
        tracks: tuple[TrackPlan, ...],
        registry: ParameterRegistry,
        time_map: TimeMap,
        *,
        fps: float = 60.0,
    ) -> None:
        self.registry = registry
        self.time_map = time_map
        self.fps = fps
        self.tracks = {plan.track.parameter: plan for plan in tracks}
        self._defaults = registry.defaults()
        self._low, self._high = registry.bounds()
        layout = registry.layout()
        lines: list[tuple[int, Channel, Track, Parameter]] = []  # a channel's first column in the values
        for plan in tracks:
            column = layout[plan.parameter.path][0]
            for channel in plan.channels:
                lines.append((column, channel, plan.track, plan.parameter))
                column += channel.space.length
        lines.sort(key=lambda line: ChannelBank.rank(line[1]))
        self._bank = ChannelBank([channel for _, channel, _, _ in lines])
        self._units = np.array([TIME_UNITS.index(track.time) for _, _, track, _ in lines], dtype=np.int64)
        self._used_units = sorted({TIME_UNITS.index(track.time) for _, _, track, _ in lines})
        self._blending = np.array([parameter.blend for _, _, _, parameter in lines], dtype=np.bool_)
        turned = [column for column, channel, _, _ in lines if channel.space is ORIENTATION]
        self._turned: IntArray = (np.array(turned, dtype=np.int64)[:, None] + np.arange(4)).reshape(-1)
        plain = [
            (column + i, i * len(lines) + row)
            for row, (column, channel, _, _) in enumerate(lines)
            if channel.space is not ORIENTATION
            for i in range(channel.space.length)
        ]
        self._columns, self._sources = np.array(plain, dtype=np.int64).reshape(-1, 2).T

    @classmethod
    def make(
        cls,
        show: "Show",
        registry: ParameterRegistry,
        time_map: TimeMap,
        *,
        fps: float = 60.0,
        earlier: "ShowPlan | None" = None,
    ) -> "ShowPlan":
        """Plan a show; see `Show.plan`."""
        plans: list[TrackPlan] = []
        for track in show.tracks:
            parameter = registry.get(track.parameter)
            if not isinstance(track, Track) or track.muted or parameter is None:
                continue
            known = None if earlier is None else earlier.tracks.get(track.parameter)
            reusable = known is not None and known.track is track and known.parameter == parameter
            plans.append(known if reusable and known is not None else TrackPlan.make(track, parameter))
        return cls(tuple(plans), registry, time_map, fps=fps)

    def evaluate(self, times_s: FloatArray) -> tuple[FloatArray, BoolArray]:
        """The parameters at song times, and where they jumped.

        Args:
            times_s: ``(F,)`` seconds, in any order.

        Returns:
            Values ``(F, P)``, in the registry's order; and ``(F,)`` whether a parameter that blends has
            jumped between
            the frame of the grid before each time (a grid of `fps` frames a second) and that time.
        """
        times = np.asarray(times_s, dtype=np.float64)
        values = np.repeat(self._defaults[:, None], times.size, axis=1)
        if not self._bank.channels or times.size == 0:
            return values.T, np.zeros(times.shape, dtype=np.bool_)
        earlier = self._frame_before(times)
        in_a_row = bool(np.array_equal(earlier[1:], times[:-1]))
        asked = np.concatenate([earlier[:1] if in_a_row else earlier, times])
        samples = self._bank.locate(self._own_times(asked))
        now = samples.columns(slice(asked.size - times.size, None))
        before = samples.columns(slice(0, times.size))
        cuts = np.any((now.jumps != before.jumps) & self._blending[:, None], axis=0)
        found, quaternions = self._bank.evaluate(now)
        values[self._columns] = found.reshape(-1, times.size).take(self._sources, axis=0)
        values[self._turned] = quaternions.transpose(0, 2, 1).reshape(-1, times.size)
        np.maximum(values, self._low[:, None], out=values)
        np.minimum(values, self._high[:, None], out=values)
        return values.T, cuts

    def _own_times(self, times_s: FloatArray) -> FloatArray:
        """Seconds ``(Q,)`` in each channel's unit, ``(C, Q)``."""
        if self._used_units == [0]:
            return np.broadcast_to(times_s, (self._units.size, times_s.size))
        rows = np.zeros((len(TIME_UNITS), times_s.size))
        for unit in self._used_units:
            rows[unit] = self.time_map.from_seconds(times_s, TIME_UNITS[unit])
        return rows[self._units]

    def _frame_before(self, times: FloatArray) -> FloatArray:
        """The grid's frame before each time: exactly (k - 1) / fps for k / fps, so a jump is met once."""
        frame = np.rint(times * self.fps)
        on_grid = np.abs(times * self.fps - frame) < 1e-6
        return np.where(on_grid, (frame - 1.0) / self.fps, times - 1.0 / self.fps)
