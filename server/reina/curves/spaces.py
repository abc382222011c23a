"""The spaces in which values are interpolated, so that plain arithmetic serves all types.

A space maps the two ends of a segment to points between which a straight line is the right way, and maps
points back. Numbers and vectors are their own space, colours go through OKLab, and an orientation is the
rotation vector from the orientation at the segment's beginning, where a straight line is the shortest turn at
a constant speed (slerp).
"""

from typing import Literal, Protocol, get_args

import numpy as np

from reina.curves.arrays import FloatArray
from reina.curves.color import linear_from_oklab, oklab_from_linear
from reina.curves.parameter import Parameter
from reina.rotations import conjugate, exp, log, multiply

ColorSpace = Literal["oklab", "linear"]
COLOR_SPACES: tuple[ColorSpace, ...] = get_args(ColorSpace)


class Space(Protocol):
    """A space for values of ``length`` floats, with points of ``width`` floats.

    Attributes:
        length: Floats of a value: L.
        width: Floats of a point: W.
    """

    length: int
    width: int

    def to_points(self, values: FloatArray, origins: FloatArray, /) -> FloatArray:
        """Values ``(S, L)`` as points ``(S, W)``, seen from their segments' first values ``(S, L)``."""
        ...

    def to_values(self, points: FloatArray, origins: FloatArray, /) -> FloatArray:
        """Points ``(S, W)`` as values ``(S, L)``; the inverse of `to_points`."""
        ...


class PlainSpace:
    """Values that are points themselves: numbers, vectors, linear colours, indices of choices."""

    def __init__(self, length: int) -> None:
        self.length = self.width = length

    def to_points(self, values: FloatArray, _: FloatArray) -> FloatArray:
        """The values themselves."""
        return values

    def to_values(self, points: FloatArray, _: FloatArray) -> FloatArray:
        """The points themselves."""
        return points


class OklabSpace:
    """Linear sRGB colours, mixed in OKLab."""

    length = width = 3

    def to_points(self, values: FloatArray, _: FloatArray) -> FloatArray:
        """Linear sRGB as OKLab."""
        return oklab_from_linear(values)

    def to_values(self, points: FloatArray, _: FloatArray) -> FloatArray:
        """OKLab as linear sRGB, clipped to 0..1."""
        return np.clip(linear_from_oklab(points), 0.0, 1.0)


class OrientationSpace:
    """Unit quaternions x y z w, as rotation vectors from the orientation at the segment's beginning."""

    length = 4
    width = 3

    def to_points(self, values: FloatArray, origins: FloatArray) -> FloatArray:
        """log(origin⁻¹ value), radians: the short way round."""
        return log(multiply(conjugate(origins), values))

    def to_values(self, points: FloatArray, origins: FloatArray) -> FloatArray:
        """Origin · exp(point), with w >= 0."""
        turned = multiply(origins, exp(points))
        turned *= np.where(turned[..., 3:] < 0.0, -1.0, 1.0)
        return turned


OKLAB = OklabSpace()
ORIENTATION = OrientationSpace()


def spaces_of(parameter: Parameter, color_space: ColorSpace) -> tuple[Space, ...]:
    """The spaces of a parameter's floats, one after another; a transform has three."""
    if parameter.type == "color" and color_space == "oklab":
        return (OKLAB,)
    if parameter.type == "orientation":
        return (ORIENTATION,)
    if parameter.type == "transform":
        return (PlainSpace(3), ORIENTATION, PlainSpace(3))
    return (PlainSpace(parameter.length),)
