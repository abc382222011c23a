"""The evaluation of blocks against each keyframe's own `eval`, and the properties that a curve must have."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from reina.curves import (
    OKLAB,
    ORIENTATION,
    AutomaticKeyframe,
    ClampedKeyframe,
    EasedKeyframe,
    Extrapolation,
    Keyframe,
    PerformanceEventEmitter,
    SplineKeyframe,
)
from reina.curves.interpolation import BUILT_IN
from reina.rotations import angle_between, exp, multiply, slerp

FloatArray = NDArray[np.float64]
NAMES = tuple(BUILT_IN)
MOVING = tuple(name for name in NAMES if name != "step")
NOT_SPLINES = tuple(name for name in NAMES if name not in ("automatic", "clamped"))

key_times = st.lists(st.integers(-200, 200), min_size=2, max_size=8, unique=True).map(
    lambda numbers: [number / 16.0 for number in sorted(numbers)]
)


@st.composite
def random_keys(
    draw: st.DrawFn, names: Sequence[str] = NAMES, length: int = 3
) -> list[Keyframe[NDArray[np.float64]]]:
    times = draw(key_times)
    seed = draw(st.integers(0, 2**32 - 1))
    random = np.random.default_rng(seed)
    chosen: list[str] = random.choice(list(names), len(times)).tolist()
    keys: list[Keyframe[FloatArray]] = []
    for name, time in zip(chosen, times, strict=True):
        value, arriving, leaving = random.normal(size=(3, length))
        keys.append(BUILT_IN[name](time, value, in_tangent=arriving, out_tangent=leaving))
    return keys


def _between(keys: Sequence[Keyframe[Any]]) -> FloatArray:
    times: FloatArray = np.array([key.time for key in keys])
    inside = np.linspace(float(times[0]) - 1.0, float(times[-1]) + 1.0, 203)
    return np.sort(np.concatenate([inside, times]))


def _one_by_one(keys: Sequence[Keyframe[Any]], times: FloatArray) -> FloatArray:
    """Every time by itself: the key before and the key that ends the segment."""
    rows: list[FloatArray] = []
    for t in times:
        after = next((i for i, key in enumerate(keys) if key.time > t), len(keys))
        if after in (0, len(keys)):
            rows.append(np.asarray(keys[min(after, len(keys) - 1)].value))
        else:
            rows.append(keys[after].eval(keys[after - 1], np.array([[t]]))[0])
    return np.array(rows)


@given(random_keys(NOT_SPLINES))
def test_a_block_is_what_each_key_says_by_itself(keys: list[Keyframe[FloatArray]]) -> None:
    times = _between(keys)
    found = PerformanceEventEmitter(keys).values_at(times)
    np.testing.assert_allclose(found, _one_by_one(keys, times), atol=1e-11)


@given(random_keys(), st.sampled_from(["hold", "extrapolate"]))
def test_a_curve_passes_through_its_keys(keys: list[Keyframe[FloatArray]], outside: Extrapolation) -> None:
    emitter = PerformanceEventEmitter(keys, before=outside, after=outside)
    found = emitter.values_at(np.array([key.time for key in keys]))
    np.testing.assert_allclose(found, [key.value for key in keys], atol=1e-12)


@given(random_keys(MOVING))
def test_where_nothing_steps_nothing_jumps(keys: list[Keyframe[FloatArray]]) -> None:
    emitter = PerformanceEventEmitter(keys)
    times = np.array([key.time for key in keys])
    before, after = emitter.values_at(times - 1e-9), emitter.values_at(times + 1e-9)
    # circ and elastic curves are upright at an end, so even a hair of time moves them a little.
    np.testing.assert_allclose(before, after, atol=2e-3)


@pytest.mark.parametrize("interpolation", [AutomaticKeyframe, ClampedKeyframe])
@given(random_keys(("linear",)))
def test_automatic_splines_are_smooth(
    interpolation: type[Keyframe[FloatArray]], keys: list[Keyframe[FloatArray]]
) -> None:
    emitter = PerformanceEventEmitter([interpolation(key.time, key.value) for key in keys])
    times = np.array([key.time for key in keys])
    h = 1e-7
    coming = (emitter.values_at(times) - emitter.values_at(times - h)) / h
    going = (emitter.values_at(times + h) - emitter.values_at(times)) / h
    bend = 100.0 / np.diff(times).min() ** 2  # more than any second derivative of these keys
    np.testing.assert_allclose(coming, going, atol=1e-5 + h * bend)


@given(random_keys(("linear",)))
def test_clamped_splines_never_leave_their_keys(keys: list[Keyframe[FloatArray]]) -> None:
    clamped = [ClampedKeyframe(key.time, key.value) for key in keys]
    emitter = PerformanceEventEmitter(clamped)
    for a, b in pairwise(clamped):
        found = emitter.values_at(np.linspace(a.time, b.time, 50))
        assert np.all(found >= np.minimum(a.value, b.value) - 1e-12)
        assert np.all(found <= np.maximum(a.value, b.value) + 1e-12)


def test_clamped_slopes_are_those_of_scipy_s_monotone_interpolation() -> None:
    times = np.array([0.0, 1.0, 1.5, 4.0, 5.0, 7.0, 7.5])
    values = np.array([0.0, 2.0, 2.5, 2.5, 1.0, -3.0, 4.0])
    emitter = PerformanceEventEmitter([ClampedKeyframe(t, v) for t, v in zip(times, values, strict=True)])
    inner = np.linspace(1.0, 7.0, 400)  # at the ends a track that holds comes to rest
    np.testing.assert_allclose(emitter.values_at(inner), PchipInterpolator(times, values)(inner), atol=1e-12)


def test_automatic_slopes_reproduce_a_parabola() -> None:
    times = np.array([0.0, 0.7, 2.0, 2.5, 4.0])
    emitter = PerformanceEventEmitter([AutomaticKeyframe(t, t * t - 3.0 * t) for t in times])
    inner = np.linspace(0.7, 2.5, 200)
    np.testing.assert_allclose(emitter.values_at(inner), inner * inner - 3.0 * inner, atol=1e-12)


def test_a_spline_rests_before_a_step() -> None:
    keys = [
        AutomaticKeyframe(0.0, 0.0),
        AutomaticKeyframe(1.0, 1.0),
        Keyframe(2.0, 9.0),
        AutomaticKeyframe(3.0, 10.0),
    ]
    emitter = PerformanceEventEmitter(keys)
    h = 1e-6
    assert (emitter.value_at(1.0) - emitter.value_at(1.0 - h)) / h == pytest.approx(0.0, abs=1e-4)
    assert (emitter.value_at(2.0 + h) - emitter.value_at(2.0)) / h == pytest.approx(0.0, abs=1e-4)


def test_a_closed_loop_is_smooth_where_it_meets_itself() -> None:
    keys = [AutomaticKeyframe(float(t), np.sin(t * np.pi / 4.0)) for t in range(9)]
    emitter = PerformanceEventEmitter(keys, after="loop")
    h = 1e-6
    going = (emitter.value_at(8.0 + h) - emitter.value_at(8.0)) / h
    coming = (emitter.value_at(8.0 - h) - emitter.value_at(8.0 - 2 * h)) / h
    assert going == pytest.approx(coming, abs=1e-4)
    assert going == pytest.approx(np.sin(np.pi / 4.0), abs=1e-4)


# glTF 2.0, appendix C.5: p(t) = (2t³-3t²+1) v0 + td (t³-2t²+t) b0 + (-2t³+3t²) v1 + td (t³-t²) a1
def _gltf_cubic_spline(u: FloatArray, td: float, v0: Any, b0: Any, v1: Any, a1: Any) -> FloatArray:
    t = u[:, None]
    return (
        (2 * t**3 - 3 * t**2 + 1) * np.asarray(v0)
        + td * (t**3 - 2 * t**2 + t) * np.asarray(b0)
        + (-2 * t**3 + 3 * t**2) * np.asarray(v1)
        + td * (t**3 - t**2) * np.asarray(a1)
    )


def test_a_cubic_spline_is_gltf_s() -> None:
    v0, b0 = np.array([1.0, 2.0, 3.0]), np.array([0.5, -1.0, 4.0])
    v1, a1 = np.array([-2.0, 0.0, 5.0]), np.array([3.0, 0.25, -1.0])
    emitter = PerformanceEventEmitter(
        [Keyframe(2.0, v0, out_tangent=b0), SplineKeyframe(5.0, v1, in_tangent=a1)]
    )
    u = np.linspace(0.0, 1.0, 40, endpoint=False)
    np.testing.assert_allclose(
        emitter.values_at(2.0 + 3.0 * u), _gltf_cubic_spline(u, 3.0, v0, b0, v1, a1), atol=1e-12
    )


quaternions = st.integers(0, 2**32 - 1).map(lambda seed: _random_quaternion(np.random.default_rng(seed)))


def _random_quaternion(random: np.random.Generator) -> FloatArray:
    q = random.normal(size=4)
    return q / np.linalg.norm(q)


def test_a_cubic_spline_of_rotations_is_gltf_s() -> None:
    random = np.random.default_rng(7)
    v0, v1 = _random_quaternion(random), _random_quaternion(random)
    v1 = v1 * np.sign(v0 @ v1)
    b0, a1 = random.normal(size=4), random.normal(size=4)
    keys = [Keyframe(0.0, v0, out_tangent=b0), SplineKeyframe(2.0, v1, in_tangent=a1)]
    u = np.linspace(0.0, 1.0, 40)
    expected = _gltf_cubic_spline(u, 2.0, v0, b0, v1, a1)
    expected /= np.linalg.norm(expected, axis=1, keepdims=True)
    found = PerformanceEventEmitter(keys, space=ORIENTATION).values_at(2.0 * u)
    assert angle_between(found, expected).max() < 1e-7
    assert np.all(found[:, 3] >= 0.0)


@given(quaternions, quaternions, st.sampled_from(MOVING))
def test_orientations_turn_the_short_way(a: FloatArray, b: FloatArray, name: str) -> None:
    keys = [Keyframe(0.0, a), BUILT_IN[name](1.0, b)]
    found = PerformanceEventEmitter(keys, space=ORIENTATION).values_at(np.linspace(0.0, 1.0, 50))
    np.testing.assert_allclose(np.linalg.norm(found, axis=1), 1.0, atol=1e-12)
    whole = float(angle_between(a, b))
    beyond = 1.0 if not name.startswith(("back", "elastic", "cubic_bezier")) else 2.5
    if whole < 3.1:
        assert float(angle_between(found, a[None]).max()) <= beyond * whole + 1e-7


@given(quaternions, quaternions)
def test_linear_orientations_are_slerp(a: FloatArray, b: FloatArray) -> None:
    u = np.linspace(0.0, 1.0, 21)
    found = PerformanceEventEmitter([Keyframe(0.0, a), EasedKeyframe(1.0, b)], space=ORIENTATION).values_at(u)
    if float(angle_between(a, b)) < 3.1:
        assert float(angle_between(found, slerp(a[None], b[None], u)).max()) < 1e-7


@given(st.integers(0, 2**32 - 1))
def test_automatic_orientations_turn_smoothly(seed: int) -> None:
    random = np.random.default_rng(seed)
    times = np.cumsum(random.uniform(0.3, 2.0, 6))
    turns = [_random_quaternion(random)]
    for _ in range(5):
        turns.append(multiply(turns[-1], exp(random.normal(size=3) * 0.6)))
    keys = [AutomaticKeyframe(float(t), q) for t, q in zip(times, turns, strict=True)]
    emitter = PerformanceEventEmitter(keys, space=ORIENTATION)
    h = 1e-5
    before, at, after = (emitter.values_at(times[1:-1] + shift) for shift in (-h, 0.0, h))
    coming = 2.0 * (at * np.sign(np.sum(at * before, axis=1, keepdims=True)) - before) / h
    going = 2.0 * (after * np.sign(np.sum(at * after, axis=1, keepdims=True)) - at) / h
    turned_back = np.sign(np.sum(at * before, axis=1, keepdims=True))
    np.testing.assert_allclose(coming * turned_back, going, atol=5e-3)


def test_colours_are_mixed_in_oklab() -> None:
    # White to black: OKLab's lightness is halved, which is 0.125 of the light.
    keys = [Keyframe(0.0, np.ones(3)), EasedKeyframe(1.0, np.zeros(3))]
    found = PerformanceEventEmitter(keys, space=OKLAB).values_at(np.array([0.0, 0.5, 1.0]))
    np.testing.assert_allclose(found, [[1.0] * 3, [0.125] * 3, [0.0] * 3], atol=1e-7)


@given(st.integers(0, 2**32 - 1), st.sampled_from(MOVING))
def test_colours_pass_through_their_keys_and_stay_colours(seed: int, name: str) -> None:
    random = np.random.default_rng(seed)
    colors = random.uniform(size=(4, 3))
    keys = [BUILT_IN[name](float(i), color) for i, color in enumerate(colors)]
    emitter = PerformanceEventEmitter(keys, space=OKLAB)
    np.testing.assert_allclose(emitter.values_at(np.arange(4.0)), colors, atol=1e-12)
    found = emitter.values_at(np.linspace(0.0, 3.0, 100))
    assert found.min() >= 0.0
    assert found.max() <= 1.0


RAMP = [Keyframe(1.0, 0.0), EasedKeyframe(3.0, 4.0), EasedKeyframe(5.0, 2.0)]


@pytest.mark.parametrize(
    ("outside", "before", "after"),
    [
        ("hold", [0.0, 0.0], [2.0, 2.0]),
        ("loop", [3.0, 4.0], [0.0, 2.0]),
        ("ping_pong", [2.0, 4.0], [2.0, 3.0]),
        ("extrapolate", [-2.0, -4.0], [2.0, 1.0]),
    ],
)
def test_outside_of_the_keys(outside: Extrapolation, before: list[float], after: list[float]) -> None:
    emitter = PerformanceEventEmitter(RAMP, before=outside, after=outside)
    np.testing.assert_allclose(emitter.values_at(np.array([0.0, -1.0])), before, atol=1e-12)
    np.testing.assert_allclose(emitter.values_at(np.array([5.0, 6.0])), after, atol=1e-12)


@given(st.floats(-1000.0, 1000.0))
def test_a_loop_repeats_and_a_ping_pong_mirrors(t: float) -> None:
    loop = PerformanceEventEmitter(RAMP, before="loop", after="loop")
    back_and_forth = PerformanceEventEmitter(RAMP, before="ping_pong", after="ping_pong")
    # 4 is the span; a time within a rounding of its seam may fall on either side of it.
    if abs((t - 1.0) / 4.0 - round((t - 1.0) / 4.0)) > 1e-9:
        assert loop.value_at(t) == pytest.approx(loop.value_at(t + 4.0), abs=1e-9)
    assert back_and_forth.value_at(t) == pytest.approx(back_and_forth.value_at(t + 8.0), abs=1e-9)
    assert back_and_forth.value_at(5.0 + t) == pytest.approx(back_and_forth.value_at(5.0 - t), abs=1e-9)


@given(
    random_keys(), st.sampled_from(["hold", "loop", "ping_pong", "extrapolate"]), st.integers(0, 2**32 - 1)
)
def test_a_value_is_a_function_of_its_time_alone(
    keys: list[Keyframe[FloatArray]], outside: Extrapolation, seed: int
) -> None:
    emitter = PerformanceEventEmitter(keys, before=outside, after=outside)
    times = _between(keys)
    shuffled = np.random.default_rng(seed).permutation(times.size)
    np.testing.assert_allclose(
        emitter.values_at(times[shuffled]), emitter.values_at(times)[shuffled], atol=1e-12
    )


def test_extrapolation_goes_on_with_given_slopes() -> None:
    keys = [Keyframe(0.0, 0.0, out_tangent=2.0), SplineKeyframe(1.0, 1.0, in_tangent=-3.0)]
    emitter = PerformanceEventEmitter(keys, before="extrapolate", after="extrapolate")
    np.testing.assert_allclose(emitter.values_at(np.array([-1.0, 2.0])), [-2.0, -2.0])


def test_an_extrapolated_orientation_keeps_turning() -> None:
    keys = [Keyframe(0.0, np.array([0.0, 0.0, 0.0, 1.0])), EasedKeyframe(1.0, exp([0.0, 0.4, 0.0]))]
    emitter = PerformanceEventEmitter(keys, space=ORIENTATION, before="extrapolate", after="extrapolate")
    np.testing.assert_allclose(emitter.value_at(3.0), exp([0.0, 1.2, 0.0]), atol=1e-12)
    np.testing.assert_allclose(emitter.value_at(-1.0), exp([0.0, -0.4, 0.0]), atol=1e-12)
