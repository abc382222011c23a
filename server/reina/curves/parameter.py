"""A parameter: something about the picture that a show may change over time."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from pydantic import TypeAdapter, ValidationError

from reina.curves.arrays import FloatArray
from reina.curves.faults import fault_words
from reina.curves.value_types import STRICT, TRANSFORM_PARTS, VALUE_TYPES, Bounds, TypeName, Value

_PATH = re.compile(r"[a-z0-9_]+(/[a-z0-9_]+)*")


@dataclass(frozen=True)
class Parameter:
    """One value that every frame carries.

    Attributes:
        path: Slash path, ``lights/key/intensity``.
        type: One of `VALUE_TYPES`.
        default: Its value where no show says another, as a show writes it.
        unit: ``"m"``, ``"rad"``, ``"m/s"``; empty for plain numbers.
        minimum: The least value of any of its floats, or None.
        maximum: The greatest, or None.
        choices: What a choice chooses from; its float is the index into them.
        blend: Whether a page may blend it between two frames. Never true of booleans and choices.
        documentation: What it does, one sentence, for the person who sets it.
        open_choices: Whether a session may have choices of its own. A show that names one that is not there
            keeps that track, without effect.
    """

    path: str
    type: TypeName
    default: Value
    unit: str = ""
    minimum: float | None = None
    maximum: float | None = None
    choices: tuple[str, ...] = ()
    blend: bool = True
    documentation: str = ""
    open_choices: bool = False

    def __post_init__(self) -> None:
        if _PATH.fullmatch(self.path) is None:
            raise ValueError(f"{self.path!r} is no parameter path; write lights/key/intensity")
        if self.type not in VALUE_TYPES:
            raise ValueError(f"{self.path}: type {self.type!r} is none of {', '.join(VALUE_TYPES)}")
        if self.blend and not VALUE_TYPES[self.type].interpolates:
            raise ValueError(f"{self.path}: a {self.type} has nothing between two values; set blend=False")
        if (self.type == "choice") != bool(self.choices):
            raise ValueError(f"{self.path}: a choice, and nothing else, needs choices")
        object.__setattr__(self, "default", self.parse(self.default))

    @property
    def length(self) -> int:
        """How many floats it is in a frame: one, or 3 (color, vector), 4 (orientation), 10 (transform)."""
        return VALUE_TYPES[self.type].length

    @property
    def interpolates(self) -> bool:
        """Whether there are values between two of its values; else its keys can only step."""
        return VALUE_TYPES[self.type].interpolates

    @property
    def bounds(self) -> Bounds:
        """What its values are held to."""
        return Bounds(self.minimum, self.maximum, self.choices)

    @property
    def annotation(self) -> Any:
        """The type that pydantic checks a JSON value against."""
        return VALUE_TYPES[self.type].annotation(self.bounds)

    def parse(self, value: object) -> Value:
        """Check a value as JSON gives it.

        Raises:
            ValueError: It is of another type or out of range; the message says what would be right.
        """
        try:
            return _adapter(self.type, self.bounds).validate_python(value)
        except ValidationError as error:
            fault = error.errors(include_url=False)[0]
            part = next((f"{name}: " for name in fault["loc"] if name in TRANSFORM_PARTS), "")
            raise ValueError(part + fault_words(fault, self.unit)) from None

    def floats(self, value: Value) -> FloatArray:
        """A parsed value as the floats of a frame, ``(length,)``: colours linear, choices by index."""
        return VALUE_TYPES[self.type].floats(value, self.choices)

    def rows_of_floats(self, values: Sequence[Value]) -> FloatArray:
        """Parsed values, one at least, as `floats` has them: ``(K, length)``."""
        if self.type in ("number", "vector", "orientation"):
            return np.array(values, dtype=np.float64).reshape(-1, self.length)
        if self.type == "color" and not any(isinstance(value, str) for value in values):
            return np.array(values, dtype=np.float64)
        return np.stack([self.floats(value) for value in values])

    def value(self, floats: FloatArray) -> Value:
        """The value that floats of a frame ``(length,)`` stand for."""
        return VALUE_TYPES[self.type].value(floats, self.choices)


@lru_cache(maxsize=1024)
def _adapter(kind: TypeName, bounds: Bounds) -> TypeAdapter[Any]:
    return TypeAdapter(VALUE_TYPES[kind].annotation(bounds), config=None if kind == "transform" else STRICT)
