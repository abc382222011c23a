"""A show made ready: values of all parameters at many times, a pure function of the times."""

from collections.abc import Iterable

import numpy as np

from reina.curves.arrays import BoolArray, FloatArray, IntArray
from reina.curves.channel import Channel
from reina.curves.channel_bank import ChannelBank
from reina.curves.parameter_registry import ParameterRegistry
from reina.curves.spaces import ORIENTATION
from reina.show.event_plan import EventPlan
from reina.show.time_map import TIME_UNITS, TimeMap
from reina.show.track import Track, UnknownTrack
from reina.show.track_plan import TrackPlan
from reina.show.triggers import Triggers


class ShowPlan:
    """All parameters of a registry over time, as a show says, or at their defaults.

    Attributes:
        registry: The parameters, in the order of the values.
        time_map: How the music's time runs.
        triggers: What happens in the music.
        fps: The grid on which cuts are looked for.
        tracks: The tracks in effect, by their parameters' paths.
    """

    def __init__(
        self,
        tracks: tuple[TrackPlan, ...],
        registry: ParameterRegistry,
        time_map: TimeMap,
        *,
        triggers: Triggers | None = None,
        fps: float = 60.0,
    ) -> None:
        self.registry = registry
        self.time_map = time_map
        self.triggers = triggers or Triggers()
        self.fps = fps
        self.tracks = {plan.track.parameter: plan for plan in tracks}
        self._defaults = registry.defaults()
        self._low, self._high = registry.bounds()
        self._used_units = sorted({TIME_UNITS.index(plan.track.time) for plan in tracks})
        self._lay_out_channels(tracks)
        self._answers = self._plan_answers(tracks)

    def _lay_out_channels(self, tracks: tuple[TrackPlan, ...]) -> None:
        """Say which channel goes into which columns of the values."""
        layout = self.registry.layout()
        lines = [line for plan in tracks for line in _lines(plan, layout[plan.parameter.path][0])]
        lines.sort(key=lambda line: ChannelBank.rank(line[1]))
        units = [TIME_UNITS.index(plan.track.time) for _, _, plan in lines]
        self._bank = ChannelBank([channel for _, channel, _ in lines], units)
        self._blending = np.array([plan.parameter.blend for _, _, plan in lines], dtype=np.bool_)
        turned = [column for column, channel, _ in lines if channel.space is ORIENTATION]
        self._turned: IntArray = (np.array(turned, dtype=np.int64)[:, None] + np.arange(4)).reshape(-1)
        plain = [
            (column + i, i * len(lines) + row)
            for row, (column, channel, _) in enumerate(lines)
            if channel.space is not ORIENTATION
            for i in range(channel.space.length)
        ]
        self._columns, self._sources = np.array(plain, dtype=np.int64).reshape(-1, 2).T

    def _plan_answers(self, tracks: tuple[TrackPlan, ...]) -> list[tuple[slice, int, bool, EventPlan]]:
        """Columns, unit, whether it blends, and the answer, of each track that answers events."""
        layout = self.registry.layout()
        answers: list[tuple[slice, int, bool, EventPlan]] = []
        for plan in tracks:
            track = plan.track
            if track.events is None:
                continue
            offset, length = layout[track.parameter]
            answer = EventPlan(
                track.events,
                plan.parameter,
                unit=track.time,
                color_space=track.color_space,
                triggers=self.triggers,
                time_map=self.time_map,
            )
            unit = TIME_UNITS.index(track.time)
            answers.append((slice(offset, offset + length), unit, plan.parameter.blend, answer))
        return answers

    @classmethod
    def make(
        cls,
        tracks: Iterable[Track | UnknownTrack],
        registry: ParameterRegistry,
        time_map: TimeMap,
        *,
        triggers: Triggers | None = None,
        fps: float = 60.0,
        earlier: "ShowPlan | None" = None,
    ) -> "ShowPlan":
        """Plan a show's tracks; see `Show.plan`."""
        plans: list[TrackPlan] = []
        for track in tracks_in_effect(tracks):
            parameter = registry.get(track.parameter)
            if parameter is None:
                continue
            known = None if earlier is None else earlier.tracks.get(track.parameter)
            if known is None or known.track is not track or known.parameter != parameter:
                known = TrackPlan.make(track, parameter)
            plans.append(known)
        if triggers is None and earlier is not None:
            triggers = earlier.triggers
        return cls(tuple(plans), registry, time_map, triggers=triggers, fps=fps)

    def evaluate(self, times_s: FloatArray) -> tuple[FloatArray, BoolArray]:
        """The parameters at song times, and where they jumped.

        Args:
            times_s: ``(F,)`` seconds, in any order.

        Returns:
            Values ``(F, P)``, in the registry's order; and ``(F,)`` whether a parameter that blends has
            jumped between the frame of the grid before each time (a grid of `fps` frames a second) and that
            time.
        """
        times = np.asarray(times_s, dtype=np.float64)
        values = np.repeat(self._defaults[:, None], times.size, axis=1)
        cuts = np.zeros(times.shape, dtype=np.bool_)
        if times.size == 0 or not self.tracks:
            return values.T, cuts
        earlier = self._frame_before(times)
        in_a_row = bool(np.array_equal(earlier[1:], times[:-1]))
        by_unit = self._in_units(np.concatenate([earlier[:1] if in_a_row else earlier, times]))
        now, before = slice(by_unit.shape[1] - times.size, None), slice(0, times.size)
        if self._bank.channels:
            samples = self._bank.locate(by_unit)
            jumped = samples.jumps[:, now] != samples.jumps[:, before]
            cuts |= np.any(jumped & self._blending[:, None], axis=0)
            found, quaternions = self._bank.evaluate(samples.columns(now))
            values[self._columns] = found.reshape(-1, times.size).take(self._sources, axis=0)
            values[self._turned] = quaternions.transpose(0, 2, 1).reshape(-1, times.size)
        for columns, unit, blends, answer in self._answers:
            values[columns] = answer.apply(values[columns].T, by_unit[unit, now]).T
            if blends:
                jumps = answer.jumps(by_unit[unit])
                cuts |= jumps[now] != jumps[before]
        np.maximum(values, self._low[:, None], out=values)
        np.minimum(values, self._high[:, None], out=values)
        return values.T, cuts

    def _in_units(self, times_s: FloatArray) -> FloatArray:
        """Seconds ``(Q,)`` in every unit that a track uses, a row a unit: ``(3, Q)``."""
        rows = np.zeros((len(TIME_UNITS), times_s.size))
        for unit in self._used_units:
            rows[unit] = self.time_map.from_seconds(times_s, TIME_UNITS[unit])
        return rows

    def _frame_before(self, times: FloatArray) -> FloatArray:
        """The grid's frame before each time: exactly (k - 1) / fps for k / fps, so a jump is met once."""
        frame = np.rint(times * self.fps)
        on_grid = np.abs(times * self.fps - frame) < 1e-6
        return np.where(on_grid, (frame - 1.0) / self.fps, times - 1.0 / self.fps)


def tracks_in_effect(tracks: Iterable[Track | UnknownTrack]) -> list[Track]:
    """The tracks that are not muted; where some are solo, those of them that are not muted."""
    known = [track for track in tracks if isinstance(track, Track)]
    any_solo = any(track.solo for track in known)
    return [track for track in known if not track.muted and (track.solo or not any_solo)]


def _lines(plan: TrackPlan, column: int) -> list[tuple[int, Channel, TrackPlan]]:
    """A track's channels, each with its first column in the values."""
    lines: list[tuple[int, Channel, TrackPlan]] = []
    for channel in plan.channels:
        lines.append((column, channel, plan))
        column += channel.space.length
    return lines
