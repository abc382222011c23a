"""CSS's timing curve: against the definition solved by halving, and its published properties."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reina.curves.cubic_bezier import cubic_bezier

# The keywords of CSS Easing Functions Level 1, and two that editors offer.
KEYWORDS = {
    "ease": (0.25, 0.1, 0.25, 1.0),
    "ease-in": (0.42, 0.0, 1.0, 1.0),
    "ease-out": (0.0, 0.0, 0.58, 1.0),
    "ease-in-out": (0.42, 0.0, 0.58, 1.0),
    "overshoot": (0.34, 1.56, 0.64, 1.0),
    "upright": (1.0, 0.0, 0.0, 1.0),
}


def _by_halving(u: float, handles: tuple[float, float, float, float]) -> float:
    x1, y1, x2, y2 = handles
    if u in (0.0, 1.0):
        return u

    def curve(s: float, first: float, second: float) -> float:
        return 3 * (1 - s) ** 2 * s * first + 3 * (1 - s) * s**2 * second + s**3

    low, high = 0.0, 1.0
    for _ in range(80):
        middle = (low + high) / 2
        if curve(middle, x1, x2) < u:
            low = middle
        else:
            high = middle
    return curve((low + high) / 2, y1, y2)


@pytest.mark.parametrize("name", KEYWORDS)
def test_a_keyword_s_curve_is_its_definition(name: str) -> None:
    u = np.linspace(0.0, 1.0, 101)
    expected = [_by_halving(float(k), KEYWORDS[name]) for k in u]
    found = cubic_bezier(u, np.broadcast_to(KEYWORDS[name], (u.size, 4)))
    # At an upright tangent height changes as the cube root of time, and so do rounding errors.
    np.testing.assert_allclose(found, expected, atol=1e-9 if name != "upright" else 1e-4)


def test_known_values_of_ease() -> None:
    # Solved by hand: at s = 1/2 the curve of `ease` is at x = (3·0.25 + 3·0.25 + 1)/8, y = (3·0.1 + 3 + 1)/8.
    found = cubic_bezier(np.array([0.3125]), np.array([KEYWORDS["ease"]]))
    np.testing.assert_allclose(found, [0.5375], atol=1e-12)


def test_handles_on_the_diagonal_are_a_straight_line() -> None:
    u = np.linspace(0.0, 1.0, 33)
    np.testing.assert_allclose(cubic_bezier(u, np.tile([1 / 3, 1 / 3, 2 / 3, 2 / 3], (33, 1))), u, atol=1e-12)


unit = st.floats(0.0, 1.0)


@given(unit, unit, unit, unit, unit)
def test_it_is_solved_for_any_handles(u: float, x1: float, y1: float, x2: float, y2: float) -> None:
    found = cubic_bezier(np.array([u]), np.array([[x1, y1, x2, y2]]))[0]
    # The height between those of the times a hair earlier and later: exact where the curve is upright too.
    hair = 1e-9
    around = [_by_halving(min(max(k, 0.0), 1.0), (x1, y1, x2, y2)) for k in (u - hair, u + hair)]
    assert min(around) - 1e-6 <= found <= max(around) + 1e-6


@given(st.lists(unit, min_size=2, max_size=30), unit, unit)
def test_heights_within_the_box_never_go_back(times: list[float], x1: float, x2: float) -> None:
    u = np.sort(np.array(times))
    found = cubic_bezier(u, np.broadcast_to([x1, 0.0, x2, 1.0], (u.size, 4)))
    assert np.all(np.diff(found) >= -1e-9)


def test_the_ends_are_exact_and_hold_beyond() -> None:
    u = np.array([-1.0, 0.0, 1.0, 2.0])
    np.testing.assert_array_equal(
        cubic_bezier(u, np.tile(KEYWORDS["overshoot"], (4, 1))), [0.0, 0.0, 1.0, 1.0]
    )
