"""Numbers that an interpolation takes beside time and value."""

import math
from dataclasses import Field, dataclass, field, fields
from functools import cache
from typing import Annotated, Any, cast

from pydantic import AfterValidator
from pydantic import Field as Described

from reina.curves.keyframe import Keyframe
from reina.curves.value_types import number, numbers

_METADATA = "reina.option"


@dataclass(frozen=True)
class Option:
    """One option of an interpolation.

    Attributes:
        name: The field of the class and of the JSON keyframe.
        default: A number, or a tuple of numbers.
        minimum: The least value, one for each number, or one for all.
        maximum: The greatest.
        documentation: One sentence.
    """

    name: str
    default: float | tuple[float, ...]
    minimum: tuple[float, ...]
    maximum: tuple[float, ...]
    documentation: str

    @property
    def length(self) -> int | None:
        """How many numbers it is; None for a single number that stands without brackets."""
        return len(self.default) if isinstance(self.default, tuple) else None

    @property
    def annotation(self) -> Any:
        """The type that pydantic checks a JSON value against."""
        described = Described(description=self.documentation)
        if self.length is None:
            return Annotated[
                number(self.minimum[0], self.maximum[0]), Described(description=self.documentation)
            ]
        described = Described(description=self.documentation)
        return Annotated[numbers(self.length), AfterValidator(self._within), described]

    def _within(self, value: tuple[float, ...]) -> tuple[float, ...]:
        for given, low, high in zip(value, self.minimum, self.maximum, strict=True):
            if not low <= given <= high:
                raise ValueError(f"{given:g} is out of range; it lies between {low:g} and {high:g}")
        return value

    def describe(self) -> dict[str, Any]:
        """The option as `GET /parameters` says it; infinite bounds are null."""
        return {
            "name": self.name,
            "default": list(self.default) if isinstance(self.default, tuple) else self.default,
            "minimum": [low if math.isfinite(low) else None for low in self.minimum],
            "maximum": [high if math.isfinite(high) else None for high in self.maximum],
            "documentation": self.documentation,
        }


def option(
    default: float | tuple[float, ...],
    documentation: str,
    *,
    minimum: float | tuple[float, ...] = -math.inf,
    maximum: float | tuple[float, ...] = math.inf,
) -> Any:
    """A dataclass field that is an option of an interpolation; bounds are for each number or for all."""
    count = len(default) if isinstance(default, tuple) else 1
    low = minimum if isinstance(minimum, tuple) else (minimum,) * count
    high = maximum if isinstance(maximum, tuple) else (maximum,) * count
    return field(default=default, metadata={_METADATA: (low, high, documentation)})


@cache
def options_of(interpolation: type[Keyframe[Any]]) -> tuple[Option, ...]:
    """The options that a keyframe class declares, in their order."""
    declared: list[Field[Any]] = [f for f in fields(interpolation) if _METADATA in f.metadata]
    return tuple(Option(f.name, cast("Any", f.default), *f.metadata[_METADATA]) for f in declared)
