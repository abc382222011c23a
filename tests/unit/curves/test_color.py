"""Colours against published values: CSS Color 4's OKLab of its named colours, and a mix that it defines."""

import numpy as np
import pytest

from reina.curves import OKLAB, EasedKeyframe, Keyframe, PerformanceEventEmitter
from reina.curves.color import hex_from_linear, linear_from_hex, linear_from_oklab, oklab_from_linear

# CSS Color Module Level 4, "Converting colors", and its reference code: sRGB -> L, a, b.
OKLAB_OF = {
    "#FF0000": (0.62796, 0.22486, 0.12585),
    "#00FF00": (0.86644, -0.23389, 0.17950),
    "#0000FF": (0.45201, -0.03246, -0.31153),
    "#FFFFFF": (1.0, 0.0, 0.0),
    "#000000": (0.0, 0.0, 0.0),
    "#808080": (0.59987, 0.0, 0.0),
}


@pytest.mark.parametrize("color", OKLAB_OF)
def test_oklab_is_the_published_one(color: str) -> None:
    lab = oklab_from_linear(linear_from_hex(color))
    np.testing.assert_allclose(lab, OKLAB_OF[color], atol=2e-5)
    assert hex_from_linear(linear_from_oklab(lab)) == color


def _srgb_of_oklab(lightness: float, a: float, b: float) -> list[float]:
    """Ottosson's own inverse, digit by digit as he published it, then the sRGB transfer curve."""
    long = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3
    medium = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3
    short = (lightness - 0.0894841775 * a - 1.2914855480 * b) ** 3
    linear = (
        +4.0767416621 * long - 3.3077115913 * medium + 0.2309699292 * short,
        -1.2684380046 * long + 2.6097574011 * medium - 0.3413193965 * short,
        -0.0041960863 * long - 0.7034186147 * medium + 1.7076147010 * short,
    )
    return [12.92 * c if c <= 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055 for c in linear]


@pytest.mark.parametrize(("first", "second"), [("#FF0000", "#0000FF"), ("#0000FF", "#FFFFFF")])
def test_halfway_is_halfway_in_oklab_as_in_css_color_mix(first: str, second: str) -> None:
    keys = [Keyframe(0.0, linear_from_hex(first)), EasedKeyframe(2.0, linear_from_hex(second))]
    found = PerformanceEventEmitter(keys, space=OKLAB).value_at(1.0)
    middle = (np.array(OKLAB_OF[first]) + OKLAB_OF[second]) / 2.0
    expected = [min(255, round(255 * part)) for part in _srgb_of_oklab(*middle.tolist())]
    shown = [int(hex_from_linear(found)[at : at + 2], 16) for at in (1, 3, 5)]
    # What no screen shows is clipped; and five published digits may round a channel the other way.
    np.testing.assert_allclose(shown, expected, atol=1)
