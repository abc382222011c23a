"""The easing curves against their published definitions, written out anew and case by case."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reina.curves import Keyframe
from reina.curves.easings import EASE_IN, directed
from reina.curves.interpolation import BUILT_IN

FRACTIONS = np.linspace(0.0, 1.0, 257)
EXPO_START = 2.0**-10


def _expo(k: float) -> float:
    """Blender's: scaled, so that it starts at 0."""
    return (2 ** (10 * (k - 1)) - EXPO_START) / (1 - EXPO_START)


def _bounce_out(k: float) -> float:
    if k < 1 / 2.75:
        return 7.5625 * k * k
    if k < 2 / 2.75:
        k -= 1.5 / 2.75
        return 7.5625 * k * k + 0.75
    if k < 2.5 / 2.75:
        k -= 2.25 / 2.75
        return 7.5625 * k * k + 0.9375
    k -= 2.625 / 2.75
    return 7.5625 * k * k + 0.984375


def _in_out(ease_in: Callable[[float], float]) -> Callable[[float], float]:
    return lambda k: 0.5 * ease_in(2 * k) if k < 0.5 else 1 - 0.5 * ease_in(2 - 2 * k)


C1 = 1.70158
C2 = C1 * 1.525

DEFINITIONS: dict[str, Callable[[float], float]] = {
    "linear": lambda k: k,
    "sine_in": lambda k: 1 - math.cos(k * math.pi / 2),
    "sine_out": lambda k: math.sin(k * math.pi / 2),
    "sine_in_out": lambda k: -0.5 * (math.cos(math.pi * k) - 1),
    "quad_in": lambda k: k**2,
    "quad_out": lambda k: 1 - (1 - k) ** 2,
    "quad_in_out": lambda k: 2 * k * k if k < 0.5 else 1 - (-2 * k + 2) ** 2 / 2,
    "cubic_in": lambda k: k**3,
    "cubic_out": lambda k: 1 - (1 - k) ** 3,
    "cubic_in_out": lambda k: 4 * k**3 if k < 0.5 else 1 - (-2 * k + 2) ** 3 / 2,
    "quart_in": lambda k: k**4,
    "quart_out": lambda k: 1 - (1 - k) ** 4,
    "quart_in_out": lambda k: 8 * k**4 if k < 0.5 else 1 - (-2 * k + 2) ** 4 / 2,
    "quint_in": lambda k: k**5,
    "quint_out": lambda k: 1 - (1 - k) ** 5,
    "quint_in_out": lambda k: 16 * k**5 if k < 0.5 else 1 - (-2 * k + 2) ** 5 / 2,
    "expo_in": _expo,
    "expo_out": lambda k: 1 - _expo(1 - k),
    "expo_in_out": _in_out(_expo),
    "circ_in": lambda k: 1 - math.sqrt(1 - k * k),
    "circ_out": lambda k: math.sqrt(max(0.0, 1 - (k - 1) ** 2)),
    "circ_in_out": _in_out(lambda k: 1 - math.sqrt(max(0.0, 1 - k * k))),
    "back_in": lambda k: (C1 + 1) * k**3 - C1 * k * k,
    "back_out": lambda k: 1 + (C1 + 1) * (k - 1) ** 3 + C1 * (k - 1) ** 2,
    "back_in_out": lambda k: (
        ((2 * k) ** 2 * ((C2 + 1) * 2 * k - C2)) / 2
        if k < 0.5
        else ((2 * k - 2) ** 2 * ((C2 + 1) * (2 * k - 2) + C2) + 2) / 2
    ),
    "bounce_in": lambda k: 1 - _bounce_out(1 - k),
    "bounce_out": _bounce_out,
    "bounce_in_out": lambda k: (
        (1 - _bounce_out(1 - 2 * k)) / 2 if k < 0.5 else (1 + _bounce_out(2 * k - 1)) / 2
    ),
    # Penner's elastic curves jump by 2^-10 at their gentle end; here they have the scaled envelope instead.
    "elastic_in": lambda k: -_expo(k) * math.sin((10 * k - 10.75) * 2 * math.pi / 3),
    "elastic_out": lambda k: _expo(1 - k) * math.sin((10 * k - 0.75) * 2 * math.pi / 3) + 1,
    "elastic_in_out": lambda k: (
        -_expo(2 * k) * math.sin((20 * k - 11.125) * 2 * math.pi / 4.5) / 2
        if k < 0.5
        else _expo(2 - 2 * k) * math.sin((20 * k - 11.125) * 2 * math.pi / 4.5) / 2 + 1
    ),
}


@pytest.mark.parametrize("name", DEFINITIONS)
def test_an_easing_is_its_definition(name: str) -> None:
    expected = [DEFINITIONS[name](float(k)) for k in FRACTIONS]
    found = BUILT_IN[name](1.0, 1.0).eval(Keyframe(0.0, 0.0), FRACTIONS)
    np.testing.assert_allclose(found, expected, atol=1e-12)


def test_every_family_is_there_in_every_direction() -> None:
    families = ("sine", "quad", "cubic", "quart", "quint", "expo", "circ", "back", "bounce", "elastic")
    names = {f"{family}_{direction}" for family in families for direction in ("in", "out", "in_out")}
    assert names | {"linear"} == set(DEFINITIONS)
    assert set(BUILT_IN) == names | {"step", "linear", "cubic_bezier", "cubic_spline", "automatic", "clamped"}


@pytest.mark.parametrize("name", ["expo_in", "elastic_in", "elastic_out", "elastic_in_out"])
def test_the_scaled_envelope_stays_within_a_thousandth_of_penner_s(name: str) -> None:
    def penner(k: float) -> float:
        return 0.0 if k == 0 else 2 ** (10 * k - 10)

    scaled = np.array([DEFINITIONS[name](float(k)) for k in FRACTIONS])
    originals: dict[str, Callable[[float], float]] = {
        "expo_in": penner,
        "elastic_in": lambda k: -penner(k) * math.sin((10 * k - 10.75) * 2 * math.pi / 3),
        "elastic_out": lambda k: 1 + penner(1 - k) * math.sin((10 * k - 0.75) * 2 * math.pi / 3),
        "elastic_in_out": lambda k: (
            -penner(2 * k) * math.sin((20 * k - 11.125) * 2 * math.pi / 4.5) / 2
            if k < 0.5
            else 1 + penner(2 - 2 * k) * math.sin((20 * k - 11.125) * 2 * math.pi / 4.5) / 2
        ),
    }
    assert np.abs(scaled - [originals[name](float(k)) for k in FRACTIONS]).max() < 1e-3


@pytest.mark.parametrize("family", EASE_IN)
@given(st.floats(0.0, 1.0))
def test_out_is_in_turned_about_the_middle(family: str, k: float) -> None:
    u = np.array([k])
    options = np.array([[1.5, 0.4]])
    ease_in = directed(EASE_IN[family], "in", 1.0 - u, options)
    np.testing.assert_allclose(directed(EASE_IN[family], "out", u, options), 1.0 - ease_in, atol=1e-12)


@pytest.mark.parametrize("name", ["elastic_in", "elastic_out", "elastic_in_out"])
@given(st.floats(1.0, 5.0), st.floats(0.05, 2.0))
def test_an_elastic_curve_of_any_height_and_period_ends_where_it_should(
    name: str, height: float, period: float
) -> None:
    interpolation: Any = BUILT_IN[name]
    found = interpolation(1.0, 1.0, amplitude=height, period=period).eval(
        Keyframe(0.0, 0.0), np.array([0.0, 1.0])
    )
    np.testing.assert_allclose(found, [0.0, 1.0], atol=1e-9)


def test_overshoot_is_an_option() -> None:
    interpolation: Any = BUILT_IN["back_out"]
    found = interpolation(1.0, 1.0, overshoot=0.0).eval(Keyframe(0.0, 0.0), FRACTIONS)
    np.testing.assert_allclose(found, 1 - (1 - FRACTIONS) ** 3, atol=1e-12)
