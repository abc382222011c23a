"""The easing curves, from the fraction of the time to the fraction of the way, each as its ease-in.

Ease-out is the same curve turned about its middle, ease-in-out half of each. Definitions are Robert Penner's
(Programming Macromedia Flash MX, 2002, chapter 7), which Blender uses too. As in Blender, the exponential is
scaled so that it begins at exactly 0 instead of 1/1024; the elastic curve takes the same envelope.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from reina.curves.arrays import FloatArray

Direction = Literal["in", "out", "in_out"]
EaseIn = Callable[[FloatArray, FloatArray], FloatArray]
"""Fractions ``(M,)`` and the options of each ``(M, Q)`` -> fractions of the way ``(M,)``."""

_EXPO_START = 2.0**-10


def _envelope(u: FloatArray) -> FloatArray:
    return (np.exp2(10.0 * (u - 1.0)) - _EXPO_START) / (1.0 - _EXPO_START)


def _bounce_out(u: FloatArray) -> FloatArray:
    # Four parabolas; each row: until where, its lowest point's place, its height there.
    arch = np.searchsorted(_BOUNCE_ENDS, u, side="right")
    away = u - _BOUNCE_CENTRES[arch]
    return 7.5625 * away * away + _BOUNCE_HEIGHTS[arch]


_BOUNCE_ENDS: FloatArray = np.array([1.0, 2.0, 2.5]) / 2.75
_BOUNCE_CENTRES: FloatArray = np.array([0.0, 1.5, 2.25, 2.625]) / 2.75
_BOUNCE_HEIGHTS: FloatArray = np.array([0.0, 0.75, 0.9375, 0.984375])


def _back(u: FloatArray, options: FloatArray) -> FloatArray:
    overshoot = options[:, 0]
    return u * u * ((overshoot + 1.0) * u - overshoot)


def _elastic(u: FloatArray, options: FloatArray) -> FloatArray:
    amplitude, period = np.maximum(options[:, 0], 1.0), options[:, 1]
    # The swing's phase is chosen so that it stands at exactly 1 at the end.
    shift = period / (2.0 * np.pi) * np.arcsin(1.0 / amplitude)
    return -amplitude * _envelope(u) * np.sin((u - 1.0 - shift) * (2.0 * np.pi) / period)


def _linear(u: FloatArray, _: FloatArray) -> FloatArray:
    return u


def _sine(u: FloatArray, _: FloatArray) -> FloatArray:
    return 1.0 - np.cos(u * (np.pi / 2.0))


def _quad(u: FloatArray, _: FloatArray) -> FloatArray:
    return u * u


def _cubic(u: FloatArray, _: FloatArray) -> FloatArray:
    return u * u * u


def _quart(u: FloatArray, _: FloatArray) -> FloatArray:
    return (u * u) * (u * u)


def _quint(u: FloatArray, _: FloatArray) -> FloatArray:
    return (u * u) * (u * u) * u


def _expo(u: FloatArray, _: FloatArray) -> FloatArray:
    return _envelope(u)


def _circ(u: FloatArray, _: FloatArray) -> FloatArray:
    return 1.0 - np.sqrt(np.maximum(1.0 - u * u, 0.0))


def _bounce(u: FloatArray, _: FloatArray) -> FloatArray:
    return 1.0 - _bounce_out(1.0 - u)


EASE_IN: dict[str, EaseIn] = {
    "linear": _linear,
    "sine": _sine,
    "quad": _quad,
    "cubic": _cubic,
    "quart": _quart,
    "quint": _quint,
    "expo": _expo,
    "circ": _circ,
    "back": _back,
    "bounce": _bounce,
    "elastic": _elastic,
}
"""Each has a name of its own module, so that planned shows can be sent between processes (pickle)."""


@dataclass(frozen=True)
class Reflection:
    """How ease-out and ease-in-out are made of ease-in: where to look the curve up, and how to read it.

    Attributes:
        at: (M,) fractions at which to take the ease-in.
        mirrored: (M,) whether to read it from its other end.
        scale: (M,) 1, or 1/2 where each half of the segment holds a whole curve.
    """

    at: FloatArray
    mirrored: np.ndarray[tuple[int], np.dtype[np.bool_]]
    scale: FloatArray

    @classmethod
    def of(cls, u: FloatArray, code: FloatArray) -> "Reflection":
        """Reflect fractions ``(M,)`` by the direction codes ``(M,)`` of `DIRECTION_CODES`."""
        scale = np.where(code == _IN_OUT, 0.5, 1.0)
        mirrored = (code == _OUT) | ((code == _IN_OUT) & (u >= 0.5))
        return cls(np.where(mirrored, 1.0 - u, u) / scale, mirrored, scale)

    def read(self, eased: FloatArray) -> FloatArray:
        """The fractions of the way ``(M,)``, from the ease-in's values at `at`."""
        part = eased * self.scale
        return np.where(self.mirrored, 1.0 - part, part)


_IN, _OUT, _IN_OUT = 0.0, 1.0, 2.0
DIRECTION_CODES: dict[Direction, float] = {"in": _IN, "out": _OUT, "in_out": _IN_OUT}


def directed(ease_in: EaseIn, direction: Direction, u: FloatArray, options: FloatArray) -> FloatArray:
    """Fractions of the way ``(M,)`` of an ease-in taken in a direction, at fractions ``u`` ``(M,)``."""
    reflection = Reflection.of(u, np.full(u.shape, DIRECTION_CODES[direction]))
    return reflection.read(ease_in(reflection.at, options))
