"""The types a parameter can have: how JSON writes a value, and the floats it becomes.

Everything about a type stands in one row of `VALUE_TYPES`.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal, cast

import numpy as np

from reina.curves.arrays import FloatArray
from reina.curves.color import linear_from_hex
from reina.curves.shown import shown

TypeName = Literal["number", "boolean", "choice", "color", "vector", "orientation", "transform"]
Value = bool | float | str | tuple[float, ...] | Mapping[str, tuple[float, ...]]
"""A parameter's value as a show writes it; what is a list in JSON is a tuple here."""

Choices = tuple[str, ...]


@dataclass(frozen=True)
class ValueType:
    """One type of parameter.

    Attributes:
        length: How many floats a value is in a frame.
        parse: JSON value and the parameter's choices -> value; raises ValueError saying what would be right.
        floats: Value and choices -> (length,) float64.
        value: (length,) float64 and choices -> value; the inverse of `floats`.
        json_schema: Choices -> the JSON Schema of a value.
        interpolates: Whether values between two values exist; else only step.
    """

    length: int
    parse: Callable[[object, Choices], Value]
    floats: Callable[[Any, Choices], FloatArray]
    value: Callable[[FloatArray, Choices], Value]
    json_schema: Callable[[Choices], dict[str, Any]]
    interpolates: bool = True


LARGEST = 1e12
"""No number of a show is larger: products of those that are would soon be infinite."""


def parse_number(value: object) -> float:
    """A finite number from JSON.

    Raises:
        ValueError: It is none, or larger than `LARGEST`.
    """
    if not isinstance(value, bool) and isinstance(value, int | float):
        if abs(value) <= LARGEST:
            return float(value)
        if not isinstance(value, float) or math.isfinite(value):
            raise ValueError(f"{shown(value)} is too large; numbers lie within ±{LARGEST:g}")
    raise ValueError(f"{shown(value)} is no number; write a finite number, as 0.5")


def parse_numbers(value: object, length: int) -> tuple[float, ...]:
    """``length`` finite numbers from a JSON list.

    Raises:
        ValueError: It is none, or holds more or fewer.
    """
    items = value_items(value)
    if items is None:
        raise ValueError(f"{shown(value)} is no list; write {length} numbers in brackets")
    if len(items) != length:
        raise ValueError(f"{len(items)} numbers are given where {length} are needed")
    return tuple(parse_number(item) for item in items)


def value_items(value: object) -> Sequence[object] | None:
    """The items of a JSON list, or None where the value is none."""
    if isinstance(value, str | bytes) or not isinstance(value, Sequence):
        return None
    return cast("Sequence[object]", value)


def _fields(value: object) -> Mapping[str, object]:
    return cast("Mapping[str, object]", value) if isinstance(value, Mapping) else {}


def _parse_boolean(value: object, _: Choices) -> bool:
    if not isinstance(value, bool):
        raise ValueError(f"{shown(value)} is neither true nor false")  # noqa: TRY004
    return value


def _parse_choice(value: object, choices: Choices) -> str:
    if not isinstance(value, str) or value not in choices:
        raise ValueError(f"{shown(value)} is no choice here; the choices are {', '.join(choices)}")
    return value


def _parse_color(value: object, _: Choices) -> str | tuple[float, ...]:
    if isinstance(value, str):
        linear_from_hex(value)
        return value
    try:
        numbers = parse_numbers(value, 3)
    except ValueError as error:
        raise ValueError(f"{error}; a colour is #RRGGBB or three linear components in 0..1") from None
    if not all(0.0 <= number <= 1.0 for number in numbers):
        raise ValueError(f"{shown(list(numbers))} is no colour; its three linear components lie in 0..1")
    return numbers


def _parse_orientation(value: object, _: Choices) -> tuple[float, ...]:
    numbers = parse_numbers(value, 4)
    length = math.hypot(*numbers)
    if abs(length - 1.0) > 1e-3:
        raise ValueError(
            f"{shown(list(numbers))} is {length:.4g} long; an orientation is a unit quaternion [x, y, z, w]"
        )
    return numbers


TRANSFORM_PARTS: dict[str, TypeName] = {"position": "vector", "orientation": "orientation", "scale": "vector"}


def _parse_transform(value: object, choices: Choices) -> Mapping[str, tuple[float, ...]]:
    fields = _fields(value)
    if set(fields) != set(TRANSFORM_PARTS):
        raise ValueError(f"{shown(value)} is no transform; it is an object of {', '.join(TRANSFORM_PARTS)}")
    return {
        part: cast("tuple[float, ...]", VALUE_TYPES[name].parse(fields[part], choices))
        for part, name in TRANSFORM_PARTS.items()
    }


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


def _numbers_schema(length: int) -> dict[str, Any]:
    return {"type": "array", "items": {"type": "number"}, "minItems": length, "maxItems": length}


VALUE_TYPES: dict[TypeName, ValueType] = {
    "number": ValueType(
        length=1,
        parse=lambda value, _: parse_number(value),
        floats=lambda value, _: np.array([value], dtype=np.float64),
        value=lambda floats, _: float(floats[0]),
        json_schema=lambda _: {"type": "number"},
    ),
    "boolean": ValueType(
        length=1,
        parse=_parse_boolean,
        floats=lambda value, _: np.array([1.0 if value else 0.0]),
        value=lambda floats, _: bool(floats[0] >= 0.5),
        json_schema=lambda _: {"type": "boolean"},
        interpolates=False,
    ),
    "choice": ValueType(
        length=1,
        parse=_parse_choice,
        floats=lambda value, choices: np.array([float(choices.index(value))]),
        value=lambda floats, choices: choices[round(float(floats[0]))],
        json_schema=lambda choices: {"type": "string", "enum": list(choices)},
        interpolates=False,
    ),
    "color": ValueType(
        length=3,
        parse=_parse_color,
        floats=_color_floats,
        value=lambda floats, _: _numbers(floats),
        json_schema=lambda _: {
            "oneOf": [
                {"type": "string", "pattern": "^#[0-9a-fA-F]{6}$"},
                {**_numbers_schema(3), "items": {"type": "number", "minimum": 0, "maximum": 1}},
            ]
        },
    ),
    "vector": ValueType(
        length=3,
        parse=lambda value, _: parse_numbers(value, 3),
        floats=lambda value, _: np.array(value, dtype=np.float64),
        value=lambda floats, _: _numbers(floats),
        json_schema=lambda _: _numbers_schema(3),
    ),
    "orientation": ValueType(
        length=4,
        parse=_parse_orientation,
        floats=_orientation_floats,
        value=lambda floats, _: _numbers(floats),
        json_schema=lambda _: _numbers_schema(4),
    ),
    "transform": ValueType(
        length=10,
        parse=_parse_transform,
        floats=_transform_floats,
        value=_transform_value,
        json_schema=lambda choices: {
            "type": "object",
            "properties": {
                part: VALUE_TYPES[name].json_schema(choices) for part, name in TRANSFORM_PARTS.items()
            },
            "required": list(TRANSFORM_PARTS),
            "additionalProperties": False,
        },
    ),
}
