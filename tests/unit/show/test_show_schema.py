"""The published schema: up to date, and at one with the reader."""

import json
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, cast

import pytest

from reina.curves import ParameterRegistry
from reina.instruments import INSTRUMENTS
from reina.performance import any_player_pattern, schema_parameters, show_parameters
from reina.show import Show, ShowError
from reina.show.show_schema import show_schema, show_schema_text

ROOT = Path(__file__).parents[3]
PUBLISHED = ROOT / "docs" / "show.schema.json"
REGISTRY = ParameterRegistry(show_parameters(INSTRUMENTS.values(), 2))
PUBLISHED_FOR = schema_parameters(INSTRUMENTS.values())
SCHEMA = show_schema(PUBLISHED_FOR, pattern=any_player_pattern)
EXAMPLES = sorted((ROOT / "examples" / "shows").glob("*.json"))

Check = Callable[[Any], bool]

TYPES: dict[str, tuple[type, ...]] = {
    "object": (dict,),
    "array": (list,),
    "string": (str,),
    "boolean": (bool,),
    "number": (int, float),
    "integer": (int,),
}


def _valid(value: Any, schema: dict[str, Any]) -> bool:
    """The part of JSON Schema that the schema of shows makes use of; an unknown word fails the test."""
    items = cast("list[Any]", value) if isinstance(value, list) else []
    fields = cast("dict[str, Any]", value) if isinstance(value, dict) else {}
    checks: dict[str, Check] = {
        "type": lambda rule: (
            isinstance(value, TYPES[rule]) and (rule == "boolean" or not isinstance(value, bool))
        ),
        "const": lambda rule: value == rule,
        "enum": lambda rule: value in rule,
        "minimum": lambda rule: not _is_number(value) or value >= rule,
        "maximum": lambda rule: not _is_number(value) or value <= rule,
        "minLength": lambda rule: not isinstance(value, str) or len(value) >= rule,
        "pattern": lambda rule: not isinstance(value, str) or re.search(rule, value) is not None,
        "minItems": lambda rule: not isinstance(value, list) or len(items) >= rule,
        "maxItems": lambda rule: not isinstance(value, list) or len(items) <= rule,
        "items": lambda rule: all(_valid(item, rule) for item in items),
        "required": lambda rule: not isinstance(value, dict) or set(rule) <= set(fields),
        "properties": lambda rule: all(_valid(v, rule[name]) for name, v in fields.items() if name in rule),
        "additionalProperties": lambda _: set(fields) <= set(schema["properties"]),
        "allOf": lambda rule: all(_valid(value, part) for part in rule),
        "anyOf": lambda rule: any(_valid(value, part) for part in rule),
        "oneOf": lambda rule: sum(_valid(value, part) for part in rule) == 1,
        "if": lambda rule: not _valid(value, rule) or _valid(value, schema["then"]),
        "$ref": lambda rule: _valid(value, _pointed(rule)),
    }
    silent = ("then", "description", "title", "default", "$schema", "$defs")
    return all(checks[word](rule) for word, rule in schema.items() if word not in silent)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _pointed(reference: str) -> dict[str, Any]:
    found: Any = SCHEMA
    for part in reference.removeprefix("#/").split("/"):
        found = found[part.replace("~1", "/")]
    return found


def _one(path: str, *, events: Any = None, track: Any = None, **keyframe: Any) -> dict[str, Any]:
    entry: dict[str, Any] = {"parameter": path, **(track or {})}
    if keyframe:
        entry["keyframes"] = [{"time": 0, **keyframe}]
    if events is not None:
        entry["events"] = events
    return {"version": 1, "tracks": [entry]}


def test_the_published_schema_is_up_to_date() -> None:
    assert PUBLISHED.read_text(encoding="utf-8") == show_schema_text(PUBLISHED_FOR, any_player_pattern), (
        "run `make generate`"
    )


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_the_examples_are_valid(path: Path) -> None:
    assert _valid(json.loads(path.read_text(encoding="utf-8")), SCHEMA)


OF_A_PLAYER = next(one for one in PUBLISHED_FOR if any_player_pattern(one) and one.type == "number")
GOOD: list[dict[str, Any]] = [
    {"version": 1, "tracks": []},
    _one("camera/fov", value=0.5),
    _one("camera/fov", value=0.5, interpolation="cubic_bezier", handles=[0, 0, 1, 1]),
    _one("camera/fov", value=0.5, interpolation="elastic_out", amplitude=2, period=0.4),
    _one("blocks/color", value=[0, 0.5, 1], in_tangent=[1, 2, 3], interpolation="cubic_spline"),
    _one("blocks/visible", value=True, interpolation="step"),
    _one("smoke/density", value="thick", wind=3),
    _one("camera/fov", events={"on": "bars", "cycle": [0.5, 0.4]}),
    _one("lights/key/intensity", events={"on": "notes", "amount": 3, "hold": 1, "where": {"valves": [1]}}),
    _one("camera/fov", track={"before": "ping_pong", "muted": True, "time": "bars"}, value=1),
    _one("players/2/" + OF_A_PLAYER.path, value=OF_A_PLAYER.default),
]
BAD: list[dict[str, Any]] = [
    {"tracks": []},
    {"version": 2, "tracks": []},
    {"version": 1, "tracks": [{}]},
    {"version": 1, "tracks": [{"parameter": "camera/fov"}]},
    {"version": 1, "tracks": [{"parameter": "camera/fov", "keyframes": []}]},
    {"version": 1, "tracks": [], "notes": 1},
    _one("camera/fov", value=9),
    _one("camera/fov", value="wide"),
    _one("camera/fov", value=0.5, interpolation="smooth"),
    _one("camera/fov", value=0.5, speed=3),
    _one("blocks/visible", value=True, interpolation="linear"),
    _one("blocks/color", value="red"),
    _one("camera/position", value=[0, 1]),
    _one("camera/fov", events={"on": "bars"}),
    _one("camera/fov", events={"on": "never", "cycle": [0.5]}),
    _one("camera/fov", track={"after": "stop"}, value=1),
    _one("camera/fov", key="a b", value=1),
    _one(OF_A_PLAYER.path, value="wide"),
    _one("players/2/" + OF_A_PLAYER.path, value="wide"),
]


@pytest.mark.parametrize("document", GOOD)
def test_schema_and_reader_take_the_same(document: dict[str, Any]) -> None:
    assert _valid(document, SCHEMA)
    Show.from_document(document, REGISTRY)


@pytest.mark.parametrize("document", BAD)
def test_schema_and_reader_refuse_the_same(document: dict[str, Any]) -> None:
    assert not _valid(document, SCHEMA)
    with pytest.raises(ShowError):
        Show.from_document(document, REGISTRY)


def test_the_schema_is_plain_json() -> None:
    def numbers(value: Any) -> list[float]:
        if isinstance(value, dict):
            return [n for v in cast("dict[str, Any]", value).values() for n in numbers(v)]
        if isinstance(value, list):
            return [n for v in cast("list[Any]", value) for n in numbers(v)]
        return [value] if _is_number(value) else []

    assert all(math.isfinite(number) for number in numbers(SCHEMA))
