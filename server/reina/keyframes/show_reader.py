"""Reads tracks and keyframes from JSON, and says exactly what is wrong with them."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar, cast

from reina.keyframes.errors import ShowError
from reina.keyframes.interpolation import interpolations, interpolations_for
from reina.keyframes.keyframe import Keyframe
from reina.keyframes.options import options_of
from reina.keyframes.outside import OUTSIDE
from reina.keyframes.parameter import Parameter
from reina.keyframes.spaces import COLOR_SPACES
from reina.keyframes.time_map import TIME_UNITS, TimeUnit
from reina.keyframes.track import Track
from reina.keyframes.value_types import parse_number, parse_numbers

TRACK_FIELDS = ("parameter", "time", "before", "after", "color_space", "muted", "keyframes")
KEYFRAME_FIELDS = ("key", "time", "value", "interpolation", "in_tangent", "out_tangent")
LONGEST_TRACK = 100_000
_KEY = re.compile(r"[A-Za-z0-9_-]{1,64}")

Json = Mapping[str, Any]
Choice = TypeVar("Choice", bound=str)


@dataclass(frozen=True)
class Place:
    """Where in a show something is read; makes the errors.

    Attributes:
        track: Path of the track's parameter, or None.
        key: Key of the keyframe, or None.
    """

    track: str | None = None
    key: str | None = None

    def error(self, detail: str, field: str | None = None) -> ShowError:
        """An error at this place."""
        return ShowError(detail, track=self.track, key=self.key, field=field)

    def fields(self, value: object, known: Iterable[str], *, what: str) -> Json:
        """A JSON object that has only known fields."""
        if not isinstance(value, Mapping):
            raise self.error(f"{what} is a JSON object, not {type(value).__name__}")
        document = cast("Json", value)
        names = tuple(known)
        for name in document:
            if name not in names:
                raise self.error(f"{what} has no such field; its fields are {', '.join(names)}", str(name))
        return document

    def items(self, value: object, field: str) -> Sequence[object]:
        """A JSON list."""
        if isinstance(value, str | bytes) or not isinstance(value, Sequence):
            raise self.error("a list is needed here", field)
        return cast("Sequence[object]", value)

    def choice(self, document: Json, field: str, choices: Sequence[Choice], default: object = None) -> Choice:
        """One of several words."""
        value: object = document.get(field, default)
        for known in choices:
            if value == known:
                return known
        raise self.error(f"{value!r} is none of {', '.join(choices)}", field)

    def text(self, document: Json, field: str, default: str = "") -> str:
        """A string."""
        value: object = document.get(field, default)
        if not isinstance(value, str):
            raise self.error("a text in quotes is needed here", field)
        return value

    def flag(self, document: Json, field: str) -> bool:
        """True or false; false where it is not given."""
        value: object = document.get(field, False)
        if not isinstance(value, bool):
            raise self.error(f"{value!r} is neither true nor false", field)
        return value

    def number(self, document: Json, field: str) -> float:
        """A finite number that must be given."""
        if field not in document:
            raise self.error("it is missing; a finite number is needed", field)
        try:
            return parse_number(document[field])
        except ValueError as error:
            raise self.error(str(error), field) from None


def read_track(document: Json, parameter: Parameter, default_time: TimeUnit) -> Track:
    """Read a track of a parameter.

    Raises:
        ShowError: A field or a keyframe is not as it should be.
    """
    place = Place(parameter.path)
    place.fields(document, TRACK_FIELDS, what="a track")
    entries = place.items(document.get("keyframes"), "keyframes")
    if not entries:
        raise place.error("a track has one keyframe at least; leave out a track that has none", "keyframes")
    if len(entries) > LONGEST_TRACK:
        raise place.error(
            f"{len(entries)} keyframes are more than a track may have, {LONGEST_TRACK}", "keyframes"
        )
    named = [
        key for entry in entries if isinstance(entry, Mapping) and (key := cast("Json", entry).get("key"))
    ]
    free = (
        f"k{number}" for number in range(1, len(entries) + len(named) + 1) if f"k{number}" not in set(named)
    )
    return Track(
        parameter=parameter.path,
        keyframes=tuple(read_keyframe(entry, parameter, free) for entry in entries),
        time=place.choice(document, "time", TIME_UNITS, default_time),
        before=place.choice(document, "before", OUTSIDE, "hold"),
        after=place.choice(document, "after", OUTSIDE, "hold"),
        color_space=place.choice(document, "color_space", COLOR_SPACES, "oklab"),
        muted=place.flag(document, "muted"),
    )


def read_keyframe(document: object, parameter: Parameter, free_keys: Iterable[str]) -> Keyframe[Any]:
    """Read a keyframe of a parameter; one that names no key takes the next of the free ones.

    Raises:
        ShowError: A field is not as it should be.
    """
    if not isinstance(document, Mapping):
        raise Place(parameter.path).error(
            f"a keyframe is a JSON object, not {type(document).__name__}", "keyframes"
        )
    fields = cast("Json", document)
    given_key = Place(parameter.path).text(fields, "key")
    key = given_key or next(iter(free_keys))
    place = Place(parameter.path, key)
    if _KEY.fullmatch(key) is None:
        raise place.error("a key has 1 to 64 letters, digits, - and _", "key")
    names = interpolations_for(interpolates=parameter.interpolates)
    name = place.choice(fields, "interpolation", names, "linear" if parameter.interpolates else "step")
    interpolation = interpolations()[name]
    options = options_of(interpolation)
    place.fields(
        fields, (*KEYFRAME_FIELDS, *(declared.name for declared in options)), what=f"a {name} keyframe"
    )
    values: dict[str, Any] = {"time": place.number(fields, "time"), "key": key}
    if "value" not in fields:
        raise place.error(f"it is missing; a {parameter.type} is needed", "value")
    field = "value"
    try:
        values[field] = parameter.parse(fields[field])
        for field in ("in_tangent", "out_tangent"):
            if fields.get(field) is not None:
                values[field] = _read_tangent(fields[field], parameter)
        for declared in options:
            field = declared.name
            if field in fields:
                values[field] = declared.parse(fields[field])
    except ValueError as error:
        raise place.error(str(error), field) from None
    return interpolation(**values)


def _read_tangent(value: object, parameter: Parameter) -> float | tuple[float, ...]:
    if not parameter.interpolates:
        raise ValueError(f"a {parameter.type} only steps, so it has no slopes; leave them out")
    return parse_number(value) if parameter.type == "number" else parse_numbers(value, parameter.length)
