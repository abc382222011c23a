"""Reads tracks and keyframes from JSON, and says exactly what is wrong with them."""

import re
from collections.abc import Iterable, Mapping
from typing import Any, cast

from reina.curves.extrapolation import EXTRAPOLATIONS
from reina.curves.interpolation import interpolations, interpolations_for
from reina.curves.keyframe import Keyframe
from reina.curves.options import options_of
from reina.curves.parameter import Parameter
from reina.curves.spaces import COLOR_SPACES
from reina.curves.value_types import parse_number, parse_numbers
from reina.show.event_reader import read_events
from reina.show.location import Json, Location
from reina.show.time_map import TIME_UNITS, TimeUnit
from reina.show.track import Track

TRACK_FIELDS = ("parameter", "time", "before", "after", "color_space", "muted", "solo", "events", "keyframes")
KEYFRAME_FIELDS = ("key", "time", "value", "interpolation", "in_tangent", "out_tangent")
LONGEST_TRACK = 100_000
_KEY = re.compile(r"[A-Za-z0-9_-]{1,64}")


def read_track(
    document: Json, parameter: Parameter, default_time: TimeUnit, *, may_be_empty: bool = False
) -> Track:
    """Read a track of a parameter.

    Args:
        document: The track.
        parameter: What it moves.
        default_time: The unit of its times where it names none.
        may_be_empty: Whether it may have neither keyframes nor an answer to events, since it will yet.

    Raises:
        ShowError: A field or a keyframe is not as it should be.
    """
    location = Location(parameter.path)
    location.fields(document, TRACK_FIELDS, what="a track")
    events = read_events(document["events"], parameter) if "events" in document else None
    entries = location.items(
        document.get("keyframes", () if may_be_empty or events is not None else None), "keyframes"
    )
    if not entries and events is None and not may_be_empty:
        raise location.error("a track has one keyframe at least, or answers events", "keyframes")
    if len(entries) > LONGEST_TRACK:
        raise location.error(
            f"{len(entries)} keyframes are more than a track may have, {LONGEST_TRACK}", "keyframes"
        )
    taken: set[str] = set()
    for entry in entries:
        key: object = cast("Json", entry).get("key") if isinstance(entry, Mapping) else None
        if isinstance(key, str):
            taken.add(key)
    free = (f"k{number}" for number in range(1, 2 * len(entries) + 1) if f"k{number}" not in taken)
    return Track(
        parameter=parameter.path,
        keyframes=tuple(read_keyframe(entry, parameter, free) for entry in entries),
        time=location.choice(document, "time", TIME_UNITS, default_time),
        before=location.choice(document, "before", EXTRAPOLATIONS, "hold"),
        after=location.choice(document, "after", EXTRAPOLATIONS, "hold"),
        color_space=location.choice(document, "color_space", COLOR_SPACES, "oklab"),
        muted=location.flag(document, "muted"),
        solo=location.flag(document, "solo"),
        events=events,
    )


def read_keyframe(document: object, parameter: Parameter, free_keys: Iterable[str]) -> Keyframe[Any]:
    """Read a keyframe of a parameter; one that names no key takes the next of the free ones.

    Raises:
        ShowError: A field is not as it should be.
    """
    if not isinstance(document, Mapping):
        raise Location(parameter.path).error(
            f"a keyframe is a JSON object, not {type(document).__name__}", "keyframes"
        )
    fields = cast("Json", document)
    given_key = Location(parameter.path).text(fields, "key")
    key = given_key or next(iter(free_keys), "")
    location = Location(parameter.path, key)
    if _KEY.fullmatch(key) is None:
        raise location.error("a key has 1 to 64 letters, digits, - and _", "key")
    names = interpolations_for(interpolates=parameter.interpolates)
    name = location.choice(fields, "interpolation", names, "linear" if parameter.interpolates else "step")
    interpolation = interpolations()[name]
    options = options_of(interpolation)
    location.fields(
        fields, (*KEYFRAME_FIELDS, *(declared.name for declared in options)), what=f"a {name} keyframe"
    )
    values: dict[str, Any] = {"time": location.number(fields, "time"), "key": key}
    if "value" not in fields:
        raise location.error(f"it is missing; a {parameter.type} is needed", "value")
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
        raise location.error(str(error), field) from None
    return interpolation(**values)


def _read_tangent(value: object, parameter: Parameter) -> float | tuple[float, ...]:
    if not parameter.interpolates:
        raise ValueError(f"a {parameter.type} only steps, so it has no slopes; leave them out")
    return parse_number(value) if parameter.type == "number" else parse_numbers(value, parameter.length)
