"""The JSON Schema of shows, built from the same tables that read them."""

import json
from collections.abc import Iterable, Mapping
from typing import Any

from reina.curves.extrapolation import EXTRAPOLATIONS
from reina.curves.interpolation import BUILT_IN, interpolations_for
from reina.curves.keyframe import Keyframe
from reina.curves.options import Option, options_of
from reina.curves.parameter import Parameter
from reina.curves.spaces import COLOR_SPACES
from reina.show.event_reader import EVENT_FIELDS, FILTER_FIELDS
from reina.show.event_response import BLENDS
from reina.show.location import Json
from reina.show.show import SHOW_FIELDS, VERSION
from reina.show.show_reader import TRACK_FIELDS
from reina.show.time_map import TIME_UNITS
from reina.show.triggers import OCCASIONS

DIALECT = "https://json-schema.org/draft/2020-12/schema"

_NUMBER = {"type": "number"}
_LENGTH = {"type": "number", "minimum": 0}
_PAIR = {"type": "array", "items": _NUMBER, "minItems": 2, "maxItems": 2}

_FILTER = {
    "part": {"type": "integer", "minimum": 0},
    "pitch": {**_PAIR, "description": "Lowest and highest MIDI number."},
    "velocity": {**_PAIR, "description": "Least and greatest, 0..1."},
    "valves": {
        "type": "array",
        "items": {"type": "integer", "minimum": 1},
        "description": "Exactly these are down; none for open notes.",
    },
}
_EVENTS: dict[str, Any] = {
    "on": {"enum": list(OCCASIONS)},
    "where": {"type": "object", "properties": _FILTER, "additionalProperties": False},
    "every": {"type": "integer", "minimum": 1, "default": 1},
    "attack": {**_LENGTH, "default": 0, "description": "In the track's unit, as hold and decay."},
    "hold": {**_LENGTH, "default": 0},
    "decay": {**_LENGTH, "default": 0},
    "amount": {"description": "The swell's value at its height; either this or cycle."},
    "by_velocity": {"type": "boolean", "default": False},
    "blend": {"enum": list(BLENDS), "default": "replace"},
    "cycle": {"type": "array", "minItems": 1, "description": "Values that take turns, one an event."},
}


def show_schema(
    parameters: Iterable[Parameter], interpolations: Mapping[str, type[Keyframe[Any]]] = BUILT_IN
) -> dict[str, Any]:
    """JSON Schema (2020-12) of a show over parameters.

    A track of any other parameter is valid too: it is kept without effect. That every keyframe has a time
    and a key of its own, a schema cannot say; the reader does.
    """
    known = tuple(parameters)
    marker = {"time": _NUMBER, "name": {"type": "string", "minLength": 1}}
    properties: dict[str, Any] = {
        "$schema": {"type": "string"},
        "version": {"const": VERSION},
        "title": {"type": "string"},
        "description": {"type": "string"},
        "time": {"$ref": "#/$defs/time_unit"},
        "markers": {"type": "array", "items": _object(marker, required=tuple(marker))},
        "tracks": {"type": "array", "items": {"$ref": "#/$defs/track"}},
    }
    return {
        "$schema": DIALECT,
        "title": "A show for Reina",
        "description": "Keyframes on the parameters of stage, lights, camera and note blocks.",
        **_object(_ordered(properties, SHOW_FIELDS), required=("version", "tracks")),
        "$defs": {
            "track": {
                "type": "object",
                "properties": {"parameter": {"type": "string"}},
                "required": ["parameter"],
                "allOf": [_if_parameter(parameter) for parameter in known],
            },
            "events": {
                **_object(_ordered(_EVENTS, EVENT_FIELDS), required=("on",)),
                "oneOf": [{"required": ["amount"]}, {"required": ["cycle"]}],
            },
            "interpolation": {"enum": list(interpolations)},
            "key": {"type": "string", "pattern": "^[A-Za-z0-9_-]{1,64}$"},
            "outside": {"enum": list(EXTRAPOLATIONS), "default": "hold"},
            "time_unit": {
                "enum": list(TIME_UNITS),
                "default": "seconds",
                "description": "Bars are counted by how many have gone by.",
            },
            **{o.name: _option(o) for kind in interpolations.values() for o in options_of(kind)},
            **{_definition(parameter): _track(parameter, interpolations) for parameter in known},
        },
    }


def show_schema_text(parameters: Iterable[Parameter]) -> str:
    """`show_schema` of the built-in interpolations as the text that is published."""
    return json.dumps(show_schema(parameters), indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def _definition(parameter: Parameter) -> str:
    return f"track_{parameter.path}"


def _if_parameter(parameter: Parameter) -> dict[str, Any]:
    return {
        "if": {"properties": {"parameter": {"const": parameter.path}}},
        "then": {"$ref": "#/$defs/" + _definition(parameter).replace("/", "~1")},
    }


def _track(parameter: Parameter, interpolations: Mapping[str, type[Keyframe[Any]]]) -> dict[str, Any]:
    usable = interpolations_for(interpolates=parameter.interpolates)
    kinds = {name: kind for name, kind in interpolations.items() if name in usable}
    properties: dict[str, Any] = {
        "parameter": {"const": parameter.path},
        "time": {"$ref": "#/$defs/time_unit"},
        "before": {"$ref": "#/$defs/outside"},
        "after": {"$ref": "#/$defs/outside"},
        "color_space": {"enum": list(COLOR_SPACES)},
        "muted": {"type": "boolean", "description": "Whether the show leaves the track out."},
        "solo": {"type": "boolean", "description": "Whether it leaves out all tracks that are not solo."},
        "events": {"$ref": "#/$defs/events"},
        "keyframes": {"type": "array", "items": _keyframe(parameter, kinds)},
    }
    schema = _object(_ordered(properties, TRACK_FIELDS), required=("parameter",))
    schema["anyOf"] = [
        {"properties": {"keyframes": {"minItems": 1}}, "required": ["keyframes"]},
        {"required": ["events"]},
    ]
    return {"description": parameter.documentation, **schema}


def _keyframe(parameter: Parameter, kinds: Mapping[str, type[Keyframe[Any]]]) -> dict[str, Any]:
    value = parameter.json_schema()
    properties: dict[str, Any] = {
        "key": {"$ref": "#/$defs/key"},
        "time": _NUMBER,
        "value": value,
        "interpolation": {"$ref": "#/$defs/interpolation"} if parameter.interpolates else {"const": "step"},
    }
    if parameter.interpolates:
        slope = _NUMBER if parameter.type == "number" else _numbers(parameter.length)
        properties |= {"in_tangent": slope, "out_tangent": slope}
    for kind in kinds.values():
        properties |= {option.name: {"$ref": f"#/$defs/{option.name}"} for option in options_of(kind)}
    return _object(properties, required=("time", "value"))


def _option(option: Option) -> dict[str, Any]:
    if option.length is None:
        return {"type": "number", "minimum": option.minimum[0], "description": option.documentation}
    return {**_numbers(option.length), "description": option.documentation}


def _numbers(length: int) -> dict[str, Any]:
    return {"type": "array", "items": _NUMBER, "minItems": length, "maxItems": length}


def _object(properties: Json, *, required: tuple[str, ...]) -> dict[str, Any]:
    return {
        "type": "object",
        "properties": dict(properties),
        "required": list(required),
        "additionalProperties": False,
    }


def _ordered(properties: Json, names: Iterable[str]) -> dict[str, Any]:
    """The properties in the order in which the reader knows their names; it must know exactly these."""
    if set(properties) != set(names):
        raise ValueError(f"the schema describes {sorted(properties)}, the reader knows {sorted(names)}")
    return {name: properties[name] for name in names}


_ordered(_FILTER, FILTER_FIELDS)
