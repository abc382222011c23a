"""Cubic splines: the slope at each key is given, or found from the neighbouring keys."""

from typing import Any, ClassVar, Generic, Literal, cast

import numpy as np
from numpy.typing import NDArray

from reina.curves.keyframe import Keyframe, T

Tangents = Literal["given", "automatic", "clamped"]


class SplineKeyframe(Keyframe[T], Generic[T]):
    """``cubic_spline``: from the key before's `out_tangent` to this key's `in_tangent`, as in glTF 2.0 (C.4).

    With `tangents` other than ``given`` a track fills both in before it evaluates; see
    `reina.curves.tangents`.
    """

    __slots__ = ()
    documentation: ClassVar[str] = "A cubic spline whose slopes at the keys are given, as in glTF."
    tangents: ClassVar[Tangents] = "given"

    def eval(self, previous: Keyframe[T], t: NDArray[np.float64]) -> NDArray[Any]:
        """The values between `previous` and this key, as in `Keyframe.eval`."""
        u = self.fraction(previous, t)
        start, end = cast("Any", previous.value), cast("Any", self.value)
        duration = self.time - previous.time
        values = start + (end - start) * blend_weight(u)
        if previous.out_tangent is not None:
            values = values + (duration * cast("Any", previous.out_tangent)) * leaving_weight(u)
        if self.in_tangent is not None:
            values = values + (duration * cast("Any", self.in_tangent)) * arriving_weight(u)
        return values


class AutomaticKeyframe(SplineKeyframe[T], Generic[T]):
    """``automatic``: the slopes are found from the neighbouring keys."""

    __slots__ = ()
    documentation: ClassVar[str] = "A smooth curve through the keys; it may swing a little beyond them."
    tangents: ClassVar[Tangents] = "automatic"


class ClampedKeyframe(SplineKeyframe[T], Generic[T]):
    """``clamped``: the slopes are found from the neighbouring keys, and are held down."""

    __slots__ = ()
    documentation: ClassVar[str] = "A smooth curve through the keys that never goes beyond them."
    tangents: ClassVar[Tangents] = "clamped"


def blend_weight(u: NDArray[np.float64]) -> NDArray[np.float64]:
    """3u² - 2u³: how much of the way lies behind where both tangents are 0."""
    return u * u * (3.0 - 2.0 * u)


def leaving_weight(u: NDArray[np.float64]) -> NDArray[np.float64]:
    """u³ - 2u² + u: the part of the tangent at the segment's beginning."""
    return u * (1.0 - u) * (1.0 - u)


def arriving_weight(u: NDArray[np.float64]) -> NDArray[np.float64]:
    """u³ - u²: the part of the tangent at its end."""
    return u * u * (u - 1.0)


def quaternion_easing(u: NDArray[np.float64], _: NDArray[np.float64]) -> NDArray[np.float64]:
    """Marks splines of quaternions, which have no easing along a straight line."""
    return u


def spline_easing(u: NDArray[np.float64], _: NDArray[np.float64]) -> NDArray[np.float64]:
    """`blend_weight` as an ease-in without options."""
    return blend_weight(u)
