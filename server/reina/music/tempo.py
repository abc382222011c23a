"""Beats and seconds: the tempo map."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Self, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reina.music.arrays import FloatArray, read_only

DEFAULT_SECONDS_PER_BEAT = 0.5
SAME_TEMPO = 1e-9
"""Lengths of a beat that differ by a smaller share are the same: what is found from places is rounded."""


@dataclass(frozen=True)
class Tempo:
    """A tempo from a beat on.

    Attributes:
        onset_beats: Where it begins, quarter notes from the score's beginning.
        onset_s: The same place in seconds.
        beats_per_minute: Quarter notes in a minute.
    """

    onset_beats: float
    onset_s: float
    beats_per_minute: float


class TempoMap:
    """The piecewise linear, strictly increasing map between beats (quarter notes) and seconds.

    Beat 0 is second 0, but in a map `through` other places. Before beat 0 the first tempo holds, after the
    last change the last one. A ramp is many small steps: each is one segment here, and the seconds of its
    ends are kept, so that no error adds up along it.
    """

    def __init__(self, onset_beats: ArrayLike = (0.0,), seconds_per_beat: ArrayLike = (0.5,)) -> None:
        """Make a map from changes in any order; of several at one beat the last holds.

        Args:
            onset_beats: (K,) where each tempo begins, 0 or later; 120 beats a minute hold before the first.
            seconds_per_beat: (K,) length of a beat from there on, greater than 0.

        Raises:
            ValueError: If a beat is negative, a length not greater than 0, or either is not finite.
        """
        beats = np.atleast_1d(np.asarray(onset_beats, dtype=np.float64))
        lengths = np.atleast_1d(np.asarray(seconds_per_beat, dtype=np.float64))
        if beats.shape != lengths.shape or beats.ndim != 1:
            raise ValueError(f"as many beats as tempos are needed, not {beats.shape} and {lengths.shape}")
        if not (np.all(np.isfinite(beats)) and np.all(beats >= 0)):
            raise ValueError("a tempo must begin at a finite beat, 0 or later")
        if not (np.all(np.isfinite(lengths)) and np.all(lengths > 0)):
            raise ValueError("a beat must last a finite time greater than 0 seconds")
        beats = np.concatenate(([0.0], beats))
        lengths = np.concatenate(([DEFAULT_SECONDS_PER_BEAT], lengths))
        order = np.argsort(beats, kind="stable")
        beats, lengths = beats[order], lengths[order]
        last_at_its_beat = np.append(beats[1:] != beats[:-1], True)
        beats, lengths = beats[last_at_its_beat], lengths[last_at_its_beat]
        changes = np.concatenate(([True], lengths[1:] != lengths[:-1]))
        beats, lengths = beats[changes], lengths[changes]
        passed = np.diff(beats) * lengths[:-1]
        self._keep(beats, lengths, np.concatenate(([0.0], np.cumsum(passed))))

    def _keep(self, beats: FloatArray, lengths: FloatArray, seconds: FloatArray) -> None:
        self._beats: FloatArray = read_only(beats)
        self._lengths: FloatArray = read_only(lengths)
        self._seconds: FloatArray = read_only(seconds)

    @classmethod
    def through(cls, beats: ArrayLike, seconds: ArrayLike) -> Self:
        """Make a map through places; before the first and after the last the tempo beside it holds.

        Args:
            beats: (K,) at least two, ascending, the first of them 0.
            seconds: (K,) where they fall, ascending; the first may be any.

        Raises:
            ValueError: If there are fewer than two, or beats or seconds do not ascend.
        """
        at_beats = np.asarray(beats, dtype=np.float64)
        at_seconds = np.asarray(seconds, dtype=np.float64)
        if at_beats.shape != at_seconds.shape or at_beats.ndim != 1 or len(at_beats) < 2:
            raise ValueError(f"two places or more are needed, not {at_beats.shape} and {at_seconds.shape}")
        if at_beats[0] != 0:
            raise ValueError(f"the first place is beat 0, not beat {at_beats[0]}")
        steps, lasts = np.diff(at_beats), np.diff(at_seconds)
        if not (np.all(steps > 0) and np.all(lasts > 0) and np.isfinite(lasts.sum() + steps.sum())):
            raise ValueError("beats and seconds must ascend")
        lengths = lasts / steps
        changes = np.concatenate(([True], np.abs(np.diff(lengths)) > SAME_TEMPO * lengths[1:]))
        made = cls.__new__(cls)
        made._keep(at_beats[:-1][changes], lengths[changes], at_seconds[:-1][changes])
        return made

    @property
    def onset_beats(self) -> FloatArray:
        """(K,) float64: the beats at which the tempo changes, the first being 0."""
        return self._beats

    @property
    def onset_s(self) -> FloatArray:
        """(K,) float64: the same places in seconds."""
        return self._seconds

    @property
    def seconds_per_beat(self) -> FloatArray:
        """(K,) float64: the length of a quarter note from each change on."""
        return self._lengths

    @property
    def tempos(self) -> tuple[Tempo, ...]:
        """The tempos in their order, no two neighbours the same."""
        columns = zip(self._beats.tolist(), self._seconds.tolist(), self._lengths.tolist(), strict=True)
        return tuple(Tempo(beat, second, 60.0 / length) for beat, second, length in columns)

    @overload
    def seconds(self, beats: float) -> float: ...
    @overload
    def seconds(self, beats: NDArray[Any] | Sequence[float]) -> FloatArray: ...
    def seconds(self, beats: NDArray[Any] | Sequence[float] | float) -> FloatArray | float:
        """Return the seconds at which `beats` fall; a float for a number, else an array of the same shape."""
        at = np.asarray(beats, dtype=np.float64)
        segment = np.maximum(np.searchsorted(self._beats, at, side="right") - 1, 0)
        result = self._seconds[segment] + (at - self._beats[segment]) * self._lengths[segment]
        return result if at.ndim else float(result)

    @overload
    def beats(self, seconds: float) -> float: ...
    @overload
    def beats(self, seconds: NDArray[Any] | Sequence[float]) -> FloatArray: ...
    def beats(self, seconds: NDArray[Any] | Sequence[float] | float) -> FloatArray | float:
        """Return the beats that fall at `seconds`; a float for a number, else an array of the same shape."""
        at = np.asarray(seconds, dtype=np.float64)
        segment = np.maximum(np.searchsorted(self._seconds, at, side="right") - 1, 0)
        result = self._beats[segment] + (at - self._seconds[segment]) / self._lengths[segment]
        return result if at.ndim else float(result)
