"""The keyframe: a time, a value, and how to come there from the keyframe before."""

from dataclasses import dataclass
from typing import Any, ClassVar, Generic, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Keyframe(Generic[T]):
    """A value at a time. This class itself is the interpolation ``step``.

    Another interpolation is a subclass that overrides `eval` and nothing else. Numbers of its own, where it
    has any, are dataclass fields made with `option`; they then stand in a show's JSON and in its schema
    under their names.

    T is anything that can be added, subtracted and multiplied by a float: numbers, arrays, a class of your
    own. Values that are no straight line apart come to `eval` in a space where they are one: colours as
    OKLab, orientations as rotation vectors from the key before. So one formula serves them all.

    A show holds very many of them, so they have slots; a subclass need have none.

    Attributes:
        documentation: One sentence for the person who chooses it; a subclass says its own.
        time: When, in the unit of its track (seconds, beats or bars).
        value: What.
        key: Its stable name within the track, ``"k3"``.
        in_tangent: The slope with which a spline comes to it, value per unit of time; None is 0.
        out_tangent: The slope with which a spline that ends at the next key leaves it; None is 0.
    """

    documentation: ClassVar[str] = "Holds the key before until its own time."

    time: float
    value: T
    key: str = ""
    in_tangent: T | None = None
    out_tangent: T | None = None

    def eval(self, previous: "Keyframe[T]", t: NDArray[np.float64]) -> NDArray[Any]:
        """The values between `previous` and this key.

        Args:
            previous: The keyframe before.
            t: Times ``(F, 1)``, ``previous.time <= t <= self.time``; a column, so that it broadcasts against
                a value of any length. ``(F,)`` does for single numbers.

        Returns:
            ``(F, L)``, L being the length of a value.
        """
        value = np.asarray(cast("Any", previous.value))
        return np.broadcast_to(value, np.broadcast_shapes(t.shape, value.shape))

    def fraction(self, previous: "Keyframe[T]", t: NDArray[np.float64]) -> NDArray[np.float64]:
        """How much of the time from `previous` is over: 0 at its time, 1 at this key's; the shape of `t`."""
        return (t - previous.time) / (self.time - previous.time)
