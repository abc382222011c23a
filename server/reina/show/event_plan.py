"""A track's answer to events made ready: the same at any time, whatever was asked before."""

from typing import Any

import numpy as np

from reina.curves.arrays import FloatArray, IntArray
from reina.curves.parameter import Parameter
from reina.curves.spaces import ColorSpace, Space, spaces_of
from reina.show.event_response import EventResponse
from reina.show.time_map import TimeMap, TimeUnit
from reina.show.triggers import Triggers

_INSTANT = 1e-9
_MAX_AT_ONCE = 100_000
"""Events times times that are worked out in one go."""


class EventPlan:
    """The events that one track answers, and what they do to its parameter's value.

    Attributes:
        times: ``(E,)`` in the track's unit, increasing.
        cycles: Whether values take turns, so that every event is a jump.
    """

    def __init__(
        self,
        response: EventResponse,
        parameter: Parameter,
        *,
        unit: TimeUnit,
        color_space: ColorSpace,
        triggers: Triggers,
        time_map: TimeMap,
    ) -> None:
        self._response = response
        self._spaces = spaces_of(parameter, color_space)
        self._interpolates = parameter.interpolates
        self.times, self._strengths = response.events(triggers, time_map, unit)
        self.cycles = bool(response.cycle)
        values: tuple[Any, ...] = response.cycle or (response.amount,)
        self._values = np.stack([parameter.floats(value) for value in values])

    def jumps(self, times: FloatArray) -> IntArray:
        """How many jumps have gone by at ``(Q,)`` times; swells are none, however steep."""
        if not self.cycles:
            return np.zeros(times.shape, dtype=np.int64)
        return self.times.searchsorted(times, "right")

    def level(self, times: FloatArray) -> FloatArray:
        """The swell at ``(F,)`` times, 0..1: the greatest of those that have begun and are not gone."""
        response = self._response
        whole = response.attack + response.hold
        length = whole + response.decay
        begun = self.times.searchsorted(times, "right")
        gone = self.times.searchsorted(times - length, "right")
        most = int(np.max(begun - gone, initial=0))
        greatest = np.zeros(times.shape)
        # A long swell may hang over as many events as there are: not all of them at all times at once.
        at_once = max(1, _MAX_AT_ONCE // max(1, times.size))
        for first in range(0, most, at_once):
            event = begun[None, :] - 1 - np.arange(first, min(first + at_once, most))[:, None]
            sounds = event >= gone[None, :]
            event = np.maximum(event, 0)
            age = times[None, :] - self.times[event]
            rising = age / response.attack if response.attack > _INSTANT else np.ones(age.shape)
            left = (length - age) / response.decay if response.decay > _INSTANT else np.ones(age.shape)
            level = np.clip(rising, 0.0, 1.0) * np.clip(left, 0.0, 1.0) ** 2
            swell = np.max(np.where(sounds, level * self._strengths[event], 0.0), axis=0)
            greatest = np.maximum(greatest, swell)
        return greatest

    def apply(self, values: FloatArray, times: FloatArray) -> FloatArray:
        """The parameter's values ``(F, L)`` with the answer to events put on them, at ``(F,)`` times."""
        if self.times.size == 0:
            return values
        if self.cycles:
            turn = self.times.searchsorted(times, "right") - 1
            return np.where((turn >= 0)[:, None], self._values[turn % self._values.shape[0]], values)
        level = self.level(times)[:, None]
        amount = self._values
        if not self._interpolates:
            return np.where(level >= 0.5, amount, values)
        if self._response.blend == "add":
            return values + level * amount
        if self._response.blend == "multiply":
            return values * (1.0 + level * (amount - 1.0))
        if self._response.blend == "max":
            return np.maximum(values, level * amount)
        parts: list[FloatArray] = []
        first = 0
        for space in self._spaces:
            part = slice(first, first + space.length)
            parts.append(_towards(space, values[:, part], amount[:, part], level))
            first += space.length
        return np.concatenate(parts, axis=1)


def _towards(space: Space, values: FloatArray, goal: FloatArray, level: FloatArray) -> FloatArray:
    """From values ``(F, L)`` to one goal ``(1, L)`` by ``(F, 1)``; exactly the values where that is 0."""
    start = space.to_points(values, values)
    end = space.to_points(np.broadcast_to(goal, values.shape), values)
    return np.where(level > 0.0, space.to_values(start + level * (end - start), values), values)
