"""Makes channels of keyframes: each segment is classified once, and its numbers are laid out in rows."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any, cast

import numpy as np

from reina.curves.arrays import FloatArray, IntArray
from reina.curves.channel import Channel, Stretch
from reina.curves.eased_keyframe import EasedKeyframe, option_rows
from reina.curves.easings import DIRECTION_CODES, EASE_IN, EaseIn
from reina.curves.extrapolation import Extrapolation
from reina.curves.keyframe import Keyframe
from reina.curves.options import options_of
from reina.curves.spaces import OrientationSpace, Space
from reina.curves.spline_keyframe import SplineKeyframe, quaternion_easing, spline_easing
from reina.curves.tangents import key_slopes, rotation_vector_rates

_SAME = 1e-9


class ChannelBuilder:
    """The keys of one channel on their way to rows of numbers."""

    def __init__(
        self,
        keyframes: Sequence[Keyframe[Any]],
        values: FloatArray,
        space: Space,
        *,
        in_tangents: FloatArray | None = None,
        out_tangents: FloatArray | None = None,
        before: Extrapolation = "hold",
        after: Extrapolation = "hold",
    ) -> None:
        """Classify the segments of K keyframes, one at least.

        Args:
            keyframes: Their times increase. Of their values only `values` is looked at.
            values: ``(K, L)``.
            space: What to interpolate in.
            in_tangents: ``(K, L)`` given slopes, 0 where none is given; for orientations changes of the
                quaternion.
            out_tangents: ``(K, L)``.
            before: What happens before the first key.
            after: What happens after the last.
        """
        self.keyframes = keyframes
        self.values = values
        self.space = space
        self.in_tangents = np.zeros_like(values) if in_tangents is None else in_tangents
        self.out_tangents = np.zeros_like(values) if out_tangents is None else out_tangents
        self.before: Extrapolation = before
        self.after: Extrapolation = after
        self.count = len(keyframes)
        self.times = np.array([keyframe.time for keyframe in keyframes], dtype=np.float64)
        self.durations = np.concatenate([[1.0], np.diff(self.times), [1.0]])
        self.origins = np.concatenate([values[:1], values])
        self.starts = space.to_points(self.origins, self.origins)
        self.ends = space.to_points(np.concatenate([values, values[-1:]]), self.origins)
        self.deltas = self.ends - self.starts
        self.leaving = np.zeros_like(self.starts)
        self.arriving = np.zeros_like(self.starts)
        self.easings: list[EaseIn] = [EASE_IN["linear"]]
        self.easings_with_options: set[EaseIn] = set()
        self.easing = np.zeros(self.count + 1, dtype=np.int16)
        self.directions = np.zeros(self.count + 1, dtype=np.int8)
        self.option_rows: list[tuple[IntArray, FloatArray]] = []
        self.stretches: dict[int, Stretch] = {}
        self.quaternion_splines: dict[int, FloatArray] = {}
        self.limits = values[1:].copy()
        self.moving = np.ones(self.count + 1, dtype=np.bool_)
        self.splines: dict[str, list[IntArray]] = {}
        self._classify()
        self._find_slopes()

    def channel(self) -> Channel:
        """The finished channel."""
        jumped = np.any(np.abs(self.limits - self.values[1:]) > _SAME, axis=1)
        jumps = np.concatenate([[0, 0], np.cumsum(jumped)]).astype(np.int64)
        wraps = self.count > 1 and bool(np.any(np.abs(self.limits[-1] - self.values[0]) > _SAME))
        options = np.zeros((self.count + 1, max((row.shape[1] for _, row in self.option_rows), default=0)))
        for segments, rows in self.option_rows:
            options[segments, : rows.shape[1]] = rows
        begins = np.concatenate([self.times[:1], self.times])
        # Where nothing is a spline all slopes are one number.
        none = np.broadcast_to(0.0, self.starts.shape)
        return Channel(
            space=self.space,
            before=self.before,
            after=self.after,
            times=begins[1:],
            begins=begins,
            durations=self.durations,
            starts=self.starts,
            deltas=self._moved_deltas(),
            leaving=self.leaving if self.splines else none,
            arriving=self.arriving if self.splines else none,
            origins=self.origins,
            easings=tuple(self.easings),
            easings_with_options=frozenset(self.easings_with_options),
            easing=self.easing,
            directions=self.directions,
            options=options,
            stretches=self.stretches,
            quaternion_splines=self.quaternion_splines,
            jumps=jumps,
            jumps_a_lap=int(jumps[-2]) + int(wraps) if self.count > 1 else 0,
        )

    def _classify(self) -> None:
        """Lay out the segments by the classes of the keyframes that they end with."""
        ends = [type(keyframe) for keyframe in self.keyframes[1:]]
        kinds = list(dict.fromkeys(ends))
        places = {kind: place for place, kind in enumerate(kinds)}
        place = np.array([places[kind] for kind in ends], dtype=np.intp)
        easing, directions = np.zeros(len(kinds), dtype=np.int16), np.zeros(len(kinds), dtype=np.int8)
        others: list[type[Keyframe[Any]]] = []
        for kind in kinds:
            if not (issubclass(kind, EasedKeyframe) and _formula(kind) is _formula(EasedKeyframe)):
                others.append(kind)
                continue
            easing[places[kind]] = self._easing_index(kind.ease_in)
            directions[places[kind]] = DIRECTION_CODES[kind.direction]
            if options_of(kind):
                segments = np.flatnonzero(place == places[kind]) + 1
                chosen = [
                    cast("EasedKeyframe[Any]", self.keyframes[segment]) for segment in segments.tolist()
                ]
                self.option_rows.append((segments, option_rows(chosen)))
                self.easings_with_options.add(kind.ease_in)
        self.easing[1:-1], self.directions[1:-1] = easing[place], directions[place]
        for kind in others:
            self._classify_uneased(kind, np.flatnonzero(place == places[kind]) + 1)

    def _classify_uneased(self, kind: type[Keyframe[Any]], segments: IntArray) -> None:
        """Lay out the segments that end with keyframes of one class that has a formula of its own."""
        formula = _formula(kind)
        if issubclass(kind, SplineKeyframe) and formula is _formula(SplineKeyframe):
            if kind.tangents == "given" and isinstance(self.space, OrientationSpace):
                self.easing[segments] = self._easing_index(quaternion_easing)
                for segment in segments.tolist():
                    self.quaternion_splines[segment] = self._quaternion_spline(segment)
            else:
                self.easing[segments] = self._easing_index(spline_easing)
                self.splines.setdefault(kind.tangents, []).append(segments)
        elif formula is _formula(Keyframe):
            self.moving[segments] = False
            self.limits[segments - 1] = self.values[segments - 1]
        else:
            for segment in segments.tolist():
                self._add_own_formula(segment)

    def _easing_index(self, ease_in: EaseIn) -> int:
        if ease_in not in self.easings:
            self.easings.append(ease_in)
        return self.easings.index(ease_in)

    def _add_own_formula(self, segment: int) -> None:
        """A class that overrides `eval`: called with both keys' values, and slopes, as points."""
        keyframe = self.keyframes[segment]
        plain = not isinstance(self.space, OrientationSpace)
        before_it = replace(
            self.keyframes[segment - 1],
            value=self.starts[segment],
            out_tangent=self.out_tangents[segment - 1] if plain else None,
        )
        this = replace(
            keyframe, value=self.ends[segment], in_tangent=self.in_tangents[segment] if plain else None
        )

        def stretch(t: FloatArray) -> FloatArray:
            points = np.asarray(this.eval(before_it, t), dtype=np.float64)
            return np.broadcast_to(points, (t.shape[0], self.space.width))

        self.stretches[segment] = stretch
        end = stretch(np.array([[keyframe.time]]))
        self.limits[segment - 1] = self.space.to_values(end, self.origins[segment : segment + 1])[0]

    def _quaternion_spline(self, segment: int) -> FloatArray:
        """GlTF's cubic spline of a rotation: of the quaternion's components, to be scaled to unit length."""
        before = segment - 1
        duration = self.durations[segment]
        # Of the two quaternions of the same end the nearer one, with its slope: the short way round.
        nearer = 1.0 if np.dot(self.values[before], self.values[segment]) >= 0.0 else -1.0
        return np.stack(
            [
                self.values[before],
                self.out_tangents[before] * duration,
                nearer * self.values[segment],
                nearer * self.in_tangents[segment] * duration,
            ]
        )

    def _find_slopes(self) -> None:
        inner = slice(1, self.count)
        chords = self.deltas[inner] / self.durations[inner, None]
        for tangents, groups in self.splines.items():
            segments = np.concatenate(groups)
            if tangents == "given":
                leaving, arriving = self.out_tangents[segments - 1], self.in_tangents[segments]
            else:
                slopes = key_slopes(
                    chords,
                    self.durations[inner],
                    self.moving[inner],
                    clamped=tangents == "clamped",
                    ends=(self.before, self.after),
                    closed=self._is_closed(),
                )
                leaving, arriving = slopes[segments - 1], slopes[segments]
                if isinstance(self.space, OrientationSpace):
                    arriving = rotation_vector_rates(self.deltas[segments], arriving)
            self.leaving[segments] = leaving * self.durations[segments, None]
            self.arriving[segments] = arriving * self.durations[segments, None]

    def _is_closed(self) -> bool:
        same = bool(np.all(np.abs(self.values[0] - self.values[-1]) < _SAME))
        return "loop" in (self.before, self.after) and same

    def _moved_deltas(self) -> FloatArray:
        """The deltas, 0 where nothing moves, and outside of the keys what a unit of time adds."""
        deltas = np.where(self.moving[:, None], self.deltas, 0.0)
        last = self.count - 1
        if self.before == "extrapolate" and last > 0:
            deltas[0] = deltas[1] / self.durations[1]
            if self._has_given_slope(1):
                deltas[0] = self.out_tangents[0]
        if self.after == "extrapolate" and last > 0:
            deltas[-1] = deltas[last] / self.durations[last]
            if self._has_given_slope(last):
                deltas[-1] = self.in_tangents[last]
        return deltas

    def _has_given_slope(self, segment: int) -> bool:
        keyframe = self.keyframes[segment]
        given = isinstance(keyframe, SplineKeyframe) and keyframe.tangents == "given"
        return given and not isinstance(self.space, OrientationSpace)


def _formula(kind: type[Keyframe[Any]]) -> Callable[..., Any]:
    """The `eval` that a class has or inherits."""
    return kind.eval
