"""The types a parameter can have: how JSON writes a value, and the floats it becomes.

Everything about a type stands in one row of `VALUE_TYPES`. How JSON writes a value is a type that pydantic
checks: a show's keyframes, their JSON Schema and `Parameter.parse` follow from it.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Literal, cast

import numpy as np
from pydantic import AfterValidator, BaseModel, ConfigDict, Discriminator, Field, Strict, Tag, WithJsonSchema

from reina.curves.arrays import FloatArray
from reina.curves.color import check_hex, linear_from_hex
from reina.curves.shown import shown

TypeName = Literal["number", "boolean", "choice", "color", "vector", "orientation", "transform"]
Value = bool | float | str | tuple[float, ...] | Mapping[str, tuple[float, ...]]
"""A parameter's value as a show writes it; what is a list in JSON is a tuple here."""

Choices = tuple[str, ...]

LARGEST = 1e12
"""No number of a show is larger: products of those that are would soon be infinite."""
STRICT = ConfigDict(strict=True, extra="forbid", allow_inf_nan=False)
"""How JSON is read: true is no number, "3" neither."""


@dataclass(frozen=True)
class Bounds:
    """What the values of a parameter are held to.

    Attributes:
        minimum: The least value of any of its floats, or None.
        maximum: The greatest, or None.
        choices: What a choice chooses from.
    """

    minimum: float | None = None
    maximum: float | None = None
    choices: Choices = ()


@dataclass(frozen=True)
class ValueType:
    """One type of parameter.

    Attributes:
        length: How many floats a value is in a frame.
        annotation: Bounds -> the type that pydantic checks a JSON value against.
        floats: Value and choices -> (length,) float64.
        value: (length,) float64 and choices -> value; the inverse of `floats`.
        interpolates: Whether values between two values exist; else only step.
    """

    length: int
    annotation: Callable[[Bounds], Any]
    floats: Callable[[Any, Choices], FloatArray]
    value: Callable[[FloatArray, Choices], Value]
    interpolates: bool = True


def number(minimum: float | None = None, maximum: float | None = None) -> Any:
    """The type of a finite number within bounds; without any, within `LARGEST`."""
    low = -LARGEST if minimum is None else max(minimum, -LARGEST)
    high = LARGEST if maximum is None else min(maximum, LARGEST)
    schema: dict[str, Any] = {"type": "number"}
    schema |= {"minimum": minimum} if minimum is not None and minimum > -LARGEST else {}
    schema |= {"maximum": maximum} if maximum is not None and maximum < LARGEST else {}
    return Annotated[float, Field(ge=low, le=high), WithJsonSchema(schema)]


def numbers(length: int, minimum: float | None = None, maximum: float | None = None) -> Any:
    """The type of a list of so many numbers, each within bounds."""
    items = number(minimum, maximum)
    return Annotated[tuple[items, ...], Strict(strict=False), Field(min_length=length, max_length=length)]


def one_of(words: tuple[str, ...]) -> Any:
    """The type of one of several words."""
    literal: Any = Literal
    return literal[words]


Number = Annotated[float, Field(ge=-LARGEST, le=LARGEST), WithJsonSchema({"type": "number"})]
"""A finite number, as `number` without bounds."""
Pair = Annotated[tuple[Number, ...], Strict(strict=False), Field(min_length=2, max_length=2)]
Vector = Annotated[tuple[Number, ...], Strict(strict=False), Field(min_length=3, max_length=3)]
Quaternion = Annotated[tuple[Number, ...], Strict(strict=False), Field(min_length=4, max_length=4)]


def _color_text(text: str) -> str:
    check_hex(text)
    return text


def _color_form(value: object) -> str:
    return "<text>" if isinstance(value, str) else "<linear>"


def _unit(quaternion: tuple[float, ...]) -> tuple[float, ...]:
    length = math.hypot(*quaternion)
    if abs(length - 1.0) > 1e-3:
        raise ValueError(
            f"{shown(list(quaternion))} is {length:.4g} long; "
            "an orientation is a unit quaternion [x, y, z, w]"
        )
    return quaternion


Color = Annotated[
    Annotated[
        str,
        AfterValidator(_color_text),
        WithJsonSchema({"type": "string", "pattern": "^#[0-9a-fA-F]{6}$"}),
        Tag("<text>"),
    ]
    | Annotated[numbers(3, 0.0, 1.0), Tag("<linear>")],
    Discriminator(_color_form),
]
Orientation = Annotated[Quaternion, AfterValidator(_unit)]


class TransformParts(BaseModel):
    """Where something is, how it is turned, and how large."""

    model_config = STRICT

    position: Vector
    orientation: Orientation
    scale: Vector


def _as_mapping(parts: TransformParts) -> dict[str, tuple[float, ...]]:
    return {name: getattr(parts, name) for name in TransformParts.model_fields}


Transform = Annotated[TransformParts, AfterValidator(_as_mapping)]
TRANSFORM_PARTS: dict[str, TypeName] = {"position": "vector", "orientation": "orientation", "scale": "vector"}


def _color_floats(value: str | tuple[float, ...], _: Choices) -> FloatArray:
    return linear_from_hex(value) if isinstance(value, str) else np.array(value, dtype=np.float64)


def _orientation_floats(value: tuple[float, ...], _: Choices) -> FloatArray:
    quaternion = np.array(value, dtype=np.float64)
    return quaternion / math.hypot(*value)


def _transform_floats(value: Mapping[str, tuple[float, ...]], choices: Choices) -> FloatArray:
    parts = [VALUE_TYPES[name].floats(value[part], choices) for part, name in TRANSFORM_PARTS.items()]
    return np.concatenate(parts)


def _transform_value(floats: FloatArray, _: Choices) -> Mapping[str, tuple[float, ...]]:
    position, orientation, scale = np.split(floats, (3, 7))
    return {"position": _numbers(position), "orientation": _numbers(orientation), "scale": _numbers(scale)}


def _numbers(floats: FloatArray) -> tuple[float, ...]:
    return tuple(cast("list[float]", floats.tolist()))


VALUE_TYPES: dict[TypeName, ValueType] = {
    "number": ValueType(
        length=1,
        annotation=lambda bounds: number(bounds.minimum, bounds.maximum),
        floats=lambda value, _: np.array([value], dtype=np.float64),
        value=lambda floats, _: float(floats[0]),
    ),
    "boolean": ValueType(
        length=1,
        annotation=lambda _: bool,
        floats=lambda value, _: np.array([1.0 if value else 0.0]),
        value=lambda floats, _: bool(floats[0] >= 0.5),
        interpolates=False,
    ),
    "choice": ValueType(
        length=1,
        annotation=lambda bounds: one_of(bounds.choices),
        floats=lambda value, choices: np.array([float(choices.index(value))]),
        value=lambda floats, choices: choices[round(float(floats[0]))],
        interpolates=False,
    ),
    "color": ValueType(
        length=3,
        annotation=lambda _: Color,
        floats=_color_floats,
        value=lambda floats, _: _numbers(floats),
    ),
    "vector": ValueType(
        length=3,
        annotation=lambda bounds: numbers(3, bounds.minimum, bounds.maximum),
        floats=lambda value, _: np.array(value, dtype=np.float64),
        value=lambda floats, _: _numbers(floats),
    ),
    "orientation": ValueType(
        length=4,
        annotation=lambda _: Orientation,
        floats=_orientation_floats,
        value=lambda floats, _: _numbers(floats),
    ),
    "transform": ValueType(
        length=10,
        annotation=lambda _: Transform,
        floats=_transform_floats,
        value=_transform_value,
    ),
}
