"""Interpolations that go straight from key to key and differ only in their easing."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Generic, cast

import numpy as np
from numpy.typing import NDArray

from reina.curves.arrays import FloatArray
from reina.curves.cubic_bezier import cubic_bezier
from reina.curves.easings import EASE_IN, Direction, directed
from reina.curves.keyframe import Keyframe, T
from reina.curves.options import option, options_of


@dataclass(frozen=True, slots=True)
class EasedKeyframe(Keyframe[T], Generic[T]):
    """previous + (this - previous) · ease(fraction). This class itself is ``linear``.

    A subclass with another easing sets `ease_in` and `direction`; then a block evaluates all its segments in
    one call.
    """

    documentation: ClassVar[str] = "Goes straight, without easing."
    ease_in: ClassVar[Callable[[FloatArray, FloatArray], FloatArray]] = EASE_IN["linear"]
    direction: ClassVar[Direction] = "in"

    def eval(self, previous: Keyframe[T], t: NDArray[np.float64]) -> NDArray[Any]:
        """The values between `previous` and this key, as in `Keyframe.eval`."""
        fraction = self.fraction(previous, t)
        options = option_rows([self]).repeat(fraction.size, axis=0)
        eased = directed(type(self).ease_in, self.direction, fraction.ravel(), options).reshape(
            fraction.shape
        )
        start, end = cast("Any", previous.value), cast("Any", self.value)
        return start + (end - start) * eased


def option_rows(keyframes: Sequence[EasedKeyframe[Any]]) -> FloatArray:
    """The options' numbers of keyframes of one class, one at least, ``(M, Q)``, as `ease_in` takes them."""
    columns = [
        np.array([getattr(keyframe, declared.name) for keyframe in keyframes], dtype=np.float64)
        for declared in options_of(type(keyframes[0]))
    ]
    return np.concatenate(
        [np.zeros((len(keyframes), 0)), *(one.reshape(len(one), -1) for one in columns)], axis=1
    )


@dataclass(frozen=True, slots=True)
class CubicBezierKeyframe(EasedKeyframe[T], Generic[T]):
    """``cubic_bezier``."""

    documentation: ClassVar[str] = "Goes straight, eased by a Bézier curve with two handles, as in CSS."
    ease_in: ClassVar[Callable[[FloatArray, FloatArray], FloatArray]] = cubic_bezier
    handles: tuple[float, float, float, float] = option(
        (0.25, 0.1, 0.25, 1.0),
        "x1, y1, x2, y2 of the two handles; both x lie in 0..1",
        minimum=(0.0, -100.0, 0.0, -100.0),
        maximum=(1.0, 100.0, 1.0, 100.0),
    )


@dataclass(frozen=True, slots=True)
class BackKeyframe(EasedKeyframe[T], Generic[T]):
    """``back_in``."""

    documentation: ClassVar[str] = "Draws back before it goes."
    ease_in: ClassVar[Callable[[FloatArray, FloatArray], FloatArray]] = EASE_IN["back"]
    overshoot: float = option(
        1.70158, "how far it goes beyond; 1.70158 is a tenth of the way", minimum=0.0, maximum=100.0
    )


@dataclass(frozen=True, slots=True)
class ElasticKeyframe(EasedKeyframe[T], Generic[T]):
    """``elastic_in``."""

    documentation: ClassVar[str] = "Swings like a spring before it goes."
    ease_in: ClassVar[Callable[[FloatArray, FloatArray], FloatArray]] = EASE_IN["elastic"]
    amplitude: float = option(1.0, "height of the swing, 1 being the way itself", minimum=1.0, maximum=100.0)
    period: float = option(
        0.3, "length of a swing, as a fraction of the segment", minimum=0.01, maximum=100.0
    )


@dataclass(frozen=True, slots=True)
class BackInOutKeyframe(BackKeyframe[T], Generic[T]):
    """``back_in_out``: each half of the way is a whole curve, and so its default reaches further."""

    documentation: ClassVar[str] = "Draws back before it goes, and goes beyond before it comes."
    direction: ClassVar[Direction] = "in_out"
    overshoot: float = option(1.70158 * 1.525, "how far it goes beyond", minimum=0.0, maximum=100.0)


@dataclass(frozen=True, slots=True)
class ElasticInOutKeyframe(ElasticKeyframe[T], Generic[T]):
    """``elastic_in_out``: each half of the way is a whole curve, and so its default swings slower."""

    documentation: ClassVar[str] = "Swings like a spring before it goes and after it comes."
    direction: ClassVar[Direction] = "in_out"
    period: float = option(
        0.45, "length of a swing, as a fraction of half the segment", minimum=0.01, maximum=100.0
    )


def _variant(
    name: str, base: type[EasedKeyframe[Any]], attributes: dict[str, object], documentation: str
) -> type[EasedKeyframe[Any]]:
    class_name = "".join(word.capitalize() for word in name.split("_")) + "Keyframe"
    members = {
        **attributes,
        "__slots__": (),
        "__doc__": f"``{name}``.",
        "__module__": __name__,
        "documentation": documentation,
    }
    made = cast("type[EasedKeyframe[Any]]", type(class_name, (base,), members))
    # Found by its name, so that shows can be sent from one process to another (pickle).
    globals()[class_name] = made
    return made


_CURVES = {
    "sine": "a quarter of a sine wave",
    "quad": "the square of time",
    "cubic": "the cube of time",
    "quart": "the fourth power of time",
    "quint": "the fifth power of time",
    "expo": "a curve that doubles ten times",
    "circ": "a quarter of a circle",
    "bounce": "a ball's bounces",
}
_ENDS: dict[Direction, str] = {"in": "its beginning", "out": "its end", "in_out": "both ends"}


def eased_interpolations() -> dict[str, type[EasedKeyframe[Any]]]:
    """Every eased interpolation by its name."""
    table: dict[str, type[EasedKeyframe[Any]]] = {
        "linear": EasedKeyframe,
        "cubic_bezier": CubicBezierKeyframe,
    }
    for family, curve in _CURVES.items():
        for direction, end in _ENDS.items():
            name = f"{family}_{direction}"
            attributes: dict[str, object] = {"ease_in": staticmethod(EASE_IN[family]), "direction": direction}
            table[name] = _variant(name, EasedKeyframe, attributes, f"Follows {curve}, gentle at {end}.")
    out: dict[str, object] = {"direction": "out"}
    table |= {
        "back_in": BackKeyframe,
        "back_out": _variant("back_out", BackKeyframe, out, "Goes beyond before it comes."),
        "back_in_out": BackInOutKeyframe,
        "elastic_in": ElasticKeyframe,
        "elastic_out": _variant("elastic_out", ElasticKeyframe, out, "Swings like a spring after it comes."),
        "elastic_in_out": ElasticInOutKeyframe,
    }
    return table
