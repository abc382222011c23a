import json
from typing import Any

import numpy as np
import pytest

from reina.curves import Parameter, ParameterRegistry
from reina.curves.color import hex_from_linear, linear_from_hex, linear_from_srgb, srgb_from_linear
from reina.curves.value_types import TypeName
from reina.stage import STAGE_PARAMETERS, stage_registry

SPOT = ("intensity", "color", "position", "target", "angle", "softness")
SHOW_PATHS = {
    *("camera/position", "camera/target", "camera/fov", "camera/roll"),
    *("lights/key/intensity", "lights/key/color", "lights/key/position"),
    *("lights/fill/intensity", "lights/fill/color"),
    *("lights/rim/intensity", "lights/rim/color", "lights/rim/position"),
    *("lights/ambient/intensity", "lights/ambient/color", "lights/environment/intensity"),
    *("stage/exposure", "stage/background", "stage/floor_color", "stage/fog/density"),
    *("blocks/visible", "blocks/color", "blocks/sounding_color", "blocks/opacity", "blocks/glow"),
    *("blocks/speed", "blocks/arrangement"),
    *(f"lights/spots/{spot}/{what}" for spot in (1, 2, 3) for what in SPOT),
    "lights/key/softness",
    "lights/back_wash/intensity",
    "lights/back_wash/color",
    "lights/haze",
    "camera/focus_distance",
    "camera/aperture",
    "stage/bloom/strength",
    "stage/bloom/threshold",
    "look/style",
    "trumpet/finish",
}


def test_what_every_show_moves_is_declared() -> None:
    assert {parameter.path for parameter in STAGE_PARAMETERS} >= SHOW_PATHS


@pytest.mark.parametrize("parameter", STAGE_PARAMETERS, ids=lambda parameter: parameter.path)
def test_a_stage_parameter_says_what_it_is(parameter: Parameter) -> None:
    assert parameter.documentation.endswith(".")
    floats = parameter.floats(parameter.default)
    assert floats.shape == (parameter.length,)
    assert parameter.parse(parameter.default) == parameter.default
    np.testing.assert_allclose(parameter.floats(parameter.value(floats)), floats, atol=1e-12)
    if parameter.type == "number":
        assert parameter.minimum is not None
        assert parameter.maximum is not None
    assert parameter.blend == (parameter.type not in ("boolean", "choice"))


def test_layout_and_defaults_go_together() -> None:
    registry = stage_registry()
    layout, defaults = registry.layout(), registry.defaults()
    assert registry.size == defaults.size
    end = 0
    for parameter in registry:
        offset, length = layout[parameter.path]
        assert (offset, length) == (end, parameter.length)
        np.testing.assert_array_equal(defaults[offset : offset + length], parameter.floats(parameter.default))
        end += length
    assert end == registry.size


def test_the_description_is_json_and_complete() -> None:
    described = json.loads(json.dumps(stage_registry().describe(), allow_nan=False))
    assert [entry["path"] for entry in described["parameters"]] == [p.path for p in STAGE_PARAMETERS]
    arrangement = next(e for e in described["parameters"] if e["path"] == "blocks/arrangement")
    assert arrangement["choices"] == ["toward_bell", "lane_below"]
    assert arrangement["interpolations"] == ["step"]
    assert arrangement["blend"] is False
    color = next(e for e in described["parameters"] if e["path"] == "blocks/color")
    assert color["length"] == 3
    assert "elastic_in_out" in color["interpolations"]
    names = [entry["name"] for entry in described["interpolations"]]
    assert names == color["interpolations"]
    bezier = next(e for e in described["interpolations"] if e["name"] == "cubic_bezier")
    assert bezier["options"][0]["name"] == "handles"
    assert all(entry["documentation"].endswith(".") for entry in described["interpolations"])


def test_a_registry_refuses_a_path_twice() -> None:
    parameter = Parameter("a/b", "number", 0.0)
    with pytest.raises(ValueError, match="a/b"):
        ParameterRegistry([parameter, parameter])


def test_a_registry_can_be_extended() -> None:
    registry = stage_registry().extended([Parameter("trumpet/valve/1", "number", 0.0)])
    assert registry.layout()["trumpet/valve/1"] == (stage_registry().size, 1)
    assert "trumpet/valve/1" in registry
    assert "trumpet/valve/1" not in stage_registry()


@pytest.mark.parametrize(
    ("kind", "value", "floats"),
    [
        ("number", 2, [2.0]),
        ("boolean", True, [1.0]),
        ("color", "#FF0000", [1.0, 0.0, 0.0]),
        ("color", [0.25, 0.5, 1.0], [0.25, 0.5, 1.0]),
        ("vector", [1, 2, 3], [1.0, 2.0, 3.0]),
        ("orientation", [0, 0, 0, 1], [0.0, 0.0, 0.0, 1.0]),
        (
            "transform",
            {"position": [1, 2, 3], "orientation": [0, 1, 0, 0], "scale": [1, 1, 2]},
            [1.0, 2.0, 3.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 2.0],
        ),
    ],
)
def test_values_become_floats(kind: TypeName, value: Any, floats: list[float]) -> None:
    parameter = Parameter("p", kind, value, blend=kind != "boolean")
    np.testing.assert_allclose(parameter.floats(parameter.parse(value)), floats)
    assert parameter.length == len(floats)


def test_a_choice_is_the_index_of_its_word() -> None:
    parameter = Parameter("p", "choice", "low", choices=("high", "low"), blend=False)
    np.testing.assert_array_equal(parameter.floats("low"), [1.0])
    assert parameter.value(np.array([0.0])) == "high"


@pytest.mark.parametrize(
    ("kind", "value", "message"),
    [
        ("number", "3", "no number"),
        ("number", True, "no number"),
        ("number", float("nan"), "no number"),
        ("number", 11.0, "at most 10 m"),
        ("number", -1.0, "at least 0 m"),
        ("vector", [1, 2], "2 numbers are given where 3 are needed"),
        ("vector", "abc", "no list"),
        ("vector", [1, 2, "3"], "no number"),
        ("color", "red", "#RRGGBB"),
        ("color", [0, 0, 1.5], "0..1"),
        ("color", 3, "#RRGGBB"),
        ("orientation", [0, 0, 0, 2], "unit quaternion"),
        ("boolean", 1, "neither true nor false"),
        ("transform", {"position": [0, 0, 0]}, "orientation: it is missing"),
    ],
)
def test_a_wrong_value_is_refused_with_what_would_be_right(kind: TypeName, value: Any, message: str) -> None:
    defaults: dict[str, Any] = {
        "number": 0.0,
        "vector": (0, 0, 0),
        "color": "#000000",
        "orientation": (0, 0, 0, 1),
        "boolean": False,
        "transform": {"position": (0, 0, 0), "orientation": (0, 0, 0, 1), "scale": (1, 1, 1)},
    }
    bounds: dict[str, Any] = {"minimum": 0.0, "maximum": 10.0, "unit": "m"} if kind == "number" else {}
    parameter = Parameter("p", kind, defaults[kind], blend=kind != "boolean", **bounds)
    with pytest.raises(ValueError, match=message):
        parameter.parse(value)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"path": "A/b", "type": "number", "default": 0.0}, "no parameter path"),
        ({"path": "a", "type": "colour", "default": 0.0}, "is none of"),
        ({"path": "a", "type": "boolean", "default": True}, "blend=False"),
        ({"path": "a", "type": "choice", "default": "x", "blend": False}, "needs choices"),
        ({"path": "a", "type": "number", "default": 3.0, "maximum": 2.0}, "at most 2"),
    ],
)
def test_a_parameter_that_makes_no_sense_is_refused(arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Parameter(**arguments)


def test_srgb_there_and_back() -> None:
    encoded = np.linspace(0.0, 1.0, 256)
    np.testing.assert_allclose(srgb_from_linear(linear_from_srgb(encoded)), encoded, atol=1e-7)
    for text in ("#000000", "#FFFFFF", "#D9A441", "#14171F", "#4C6A9A"):
        assert hex_from_linear(linear_from_hex(text)) == text


def test_known_linear_values() -> None:
    # IEC 61966-2-1: half grey, 0x80, is 0.21586 of the light.
    np.testing.assert_allclose(linear_from_hex("#808080"), [0.2158605] * 3, atol=1e-6)
