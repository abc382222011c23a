from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from reina.curves import EasedKeyframe, Keyframe, PerformanceEventEmitter
from reina.curves.interpolation import interpolations
from reina.curves.keyframe import T


class PaperEaseIn(Keyframe[T]):
    """The example of the paper: quadratic easing, in `eval` and nothing else."""

    def eval(self, previous: Keyframe[T], t: NDArray[np.float64]) -> NDArray[Any]:
        start: Any = previous.value
        end: Any = self.value
        total_time = self.time - previous.time
        percent_there = (t - previous.time) / total_time
        percent_there = percent_there * percent_there
        return start + (end - start) * percent_there


def test_a_key_by_itself_holds_the_one_before() -> None:
    key = Keyframe(3.0, 7.0)
    np.testing.assert_array_equal(key.eval(Keyframe(1.0, 2.0), np.array([1.0, 2.0, 2.999])), [2.0, 2.0, 2.0])


def test_a_subclass_that_overrides_eval_alone_is_an_interpolation() -> None:
    emitter = PerformanceEventEmitter([Keyframe(1.0, 10.0), PaperEaseIn(3.0, 20.0)])
    np.testing.assert_allclose(
        emitter.values_at(np.array([0.0, 1.0, 2.0, 2.5, 3.0, 9.0])), [10, 10, 12.5, 15.625, 20, 20]
    )


@pytest.mark.parametrize("value", [3.0, np.array([1.0, -2.0, 5.0]), np.arange(6.0).reshape(2, 3)])
def test_the_paper_s_formula_is_the_built_in_quad_in(value: Any) -> None:
    times = np.linspace(-1.0, 5.0, 61)
    own = PerformanceEventEmitter([Keyframe(0.5, 0.0 * value), PaperEaseIn(4.0, value)])
    built_in = PerformanceEventEmitter([Keyframe(0.5, 0.0 * value), interpolations()["quad_in"](4.0, value)])
    assert own.values_at(times).shape == (61, *np.shape(value))
    np.testing.assert_allclose(own.values_at(times), built_in.values_at(times), atol=1e-15)


def test_the_interpolation_belongs_to_the_key_that_ends_the_segment() -> None:
    emitter = PerformanceEventEmitter(
        [EasedKeyframe(0.0, 0.0), Keyframe(1.0, 10.0), EasedKeyframe(2.0, 20.0)]
    )
    np.testing.assert_allclose(emitter.values_at(np.array([0.5, 0.999, 1.0, 1.5])), [0.0, 0.0, 10.0, 15.0])


def test_the_emitter_follows_the_performance_s_time() -> None:
    time = [0.0]
    emitter = PerformanceEventEmitter([Keyframe(0.0, 0.0), EasedKeyframe(4.0, 8.0)], now=lambda: time[0])
    assert emitter.value() == 0.0
    time[0] = 3.0
    assert emitter.value() == 6.0


def test_an_emitter_without_a_clock_says_so() -> None:
    with pytest.raises(ValueError, match="value_at"):
        PerformanceEventEmitter([Keyframe(0.0, 0.0)]).value()


def test_keys_come_in_any_order_but_never_two_at_one_time() -> None:
    emitter = PerformanceEventEmitter([EasedKeyframe(2.0, 4.0), Keyframe(0.0, 0.0)])
    assert emitter.value_at(1.0) == 2.0
    with pytest.raises(ValueError, match="one time"):
        PerformanceEventEmitter([Keyframe(1.0, 0.0), Keyframe(1.0, 2.0)])
    with pytest.raises(ValueError, match="one keyframe at least"):
        PerformanceEventEmitter([])


@dataclass(frozen=True)
class Chord:
    """A value that knows nothing of arrays: it can be added, subtracted and scaled."""

    root: float
    fifth: float

    def __add__(self, other: "Chord") -> "Chord":
        return Chord(self.root + other.root, self.fifth + other.fifth)

    def __sub__(self, other: "Chord") -> "Chord":
        return Chord(self.root - other.root, self.fifth - other.fifth)

    def __mul__(self, factor: float) -> "Chord":
        return Chord(self.root * factor, self.fifth * factor)


@pytest.mark.parametrize("interpolation", ["step", "linear", "quad_in", "elastic_out", "cubic_bezier"])
def test_any_class_with_addition_and_scaling_can_be_keyed(interpolation: str) -> None:
    numbers = [Keyframe(0.0, 1.0), interpolations()[interpolation](2.0, 5.0)]
    chords = [Keyframe(0.0, Chord(1.0, -1.0)), interpolations()[interpolation](2.0, Chord(5.0, -5.0))]
    times = np.array([-1.0, 0.0, 0.3, 1.0, 1.7, 2.0, 3.0])
    expected = PerformanceEventEmitter(numbers).values_at(times)
    found = PerformanceEventEmitter(chords).values_at(times)
    np.testing.assert_allclose([chord.root for chord in found], expected, atol=1e-12)
    np.testing.assert_allclose([chord.fifth for chord in found], -expected, atol=1e-12)
    assert isinstance(PerformanceEventEmitter(chords).value_at(1.0), Chord)


def test_objects_loop_but_cannot_be_extrapolated() -> None:
    keys = [Keyframe(0.0, Chord(0.0, 0.0)), EasedKeyframe(2.0, Chord(4.0, 0.0))]
    assert PerformanceEventEmitter(keys, after="loop").value_at(3.0).root == pytest.approx(2.0)
    with pytest.raises(ValueError, match="extrapolated"):
        PerformanceEventEmitter(keys, after="extrapolate")
