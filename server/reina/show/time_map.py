"""Seconds, beats and bars: the units in which a track's keys may stand."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from reina.curves.arrays import FloatArray

TimeUnit = Literal["seconds", "beats", "bars"]
TIME_UNITS: tuple[TimeUnit, ...] = get_args(TimeUnit)


@dataclass(frozen=True)
class TimeMap:
    """How the music's time runs, as functions on arrays; strictly increasing, each the other's inverse.

    Attributes:
        beats: Seconds -> beats (quarter notes).
        seconds: Beats -> seconds.
        bar_lines_beats: ``(B,)`` beats at which bars begin, increasing. Bars beyond the last line are as long
            as the last. A time in bars is the number of bars that have gone by: 0 is the first bar line, 1.5
            the middle of the second bar. With a pickup the first bar line is the pickup's beginning.
    """

    beats: Callable[[FloatArray], FloatArray]
    seconds: Callable[[FloatArray], FloatArray]
    bar_lines_beats: FloatArray

    def __post_init__(self) -> None:
        lines = np.asarray(self.bar_lines_beats, dtype=np.float64)
        if lines.ndim != 1 or not np.all(np.isfinite(lines)) or np.any(np.diff(lines) <= 0.0):
            raise ValueError("bar lines are increasing beats in one row")
        if lines.size < 2:
            first = float(lines[0]) if lines.size else 0.0
            lines = np.array([first, first + 4.0])
        object.__setattr__(self, "bar_lines_beats", lines)

    @classmethod
    def steady(cls, beats_per_minute: float = 120.0, beats_per_bar: float = 4.0) -> "TimeMap":
        """One tempo and one metre throughout."""
        length_s = 60.0 / beats_per_minute
        return cls(
            beats=lambda seconds: seconds / length_s,
            seconds=lambda beats: beats * length_s,
            bar_lines_beats=np.array([0.0, beats_per_bar]),
        )

    def from_seconds(self, times_s: FloatArray, unit: TimeUnit) -> FloatArray:
        """Seconds as seconds, beats or bars, the same shape."""
        if unit == "seconds":
            return times_s
        beats = self.beats(times_s)
        return beats if unit == "beats" else self._bars(beats)

    def to_seconds(self, times: FloatArray, unit: TimeUnit) -> FloatArray:
        """Seconds, beats or bars as seconds, the same shape."""
        if unit == "seconds":
            return times
        return self.seconds(times if unit == "beats" else self._beats_of_bars(times))

    def _bars(self, beats: FloatArray) -> FloatArray:
        lines = self.bar_lines_beats
        bar = np.clip(np.searchsorted(lines, beats, side="right") - 1, 0, lines.size - 2)
        return bar + (beats - lines[bar]) / (lines[bar + 1] - lines[bar])

    def _beats_of_bars(self, bars: FloatArray) -> FloatArray:
        lines = self.bar_lines_beats
        bar = np.clip(np.floor(bars).astype(np.int64), 0, lines.size - 2)
        return lines[bar] + (bars - bar) * (lines[bar + 1] - lines[bar])
