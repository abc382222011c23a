import numpy as np
import pytest

from reina.kinematics import MotionCurves, minimum_jerk


def test_minimum_jerk_goes_from_rest_to_rest() -> None:
    np.testing.assert_array_equal(minimum_jerk([-1.0, 0.0, 0.5, 1.0, 2.0]), [0, 0, 0.5, 1, 1])
    u = np.linspace(0, 1, 100_001)
    velocity = np.gradient(minimum_jerk(u), u)
    acceleration = np.gradient(velocity, u)
    assert abs(velocity[[0, -1]]).max() < 1e-6
    assert abs(acceleration[[1, -2]]).max() < 1e-2
    assert np.all(velocity >= 0)


def test_curves_hold_between_movements_and_reach_exact_values() -> None:
    curves = MotionCurves({"a": ([(1.0, 2.0, 5.0), (3.0, 3.5, -1.0)], 2.0), "still": ([], 7.0)})
    times = np.array([-10.0, 1.0, 1.5, 2.0, 2.7, 3.0, 3.25, 3.5, 99.0])
    a, still = curves.evaluate(times)
    np.testing.assert_array_equal(a, [2, 2, 3.5, 5, 5, 5, 2, -1, -1])
    np.testing.assert_array_equal(still, np.full(9, 7.0))
    assert curves.index(["still", "a"]).tolist() == [1, 0]


def test_many_curves_agree_with_each_alone() -> None:
    rng = np.random.default_rng(5)
    table: dict[str, tuple[np.ndarray, float]] = {}
    for name in "abcdefgh":
        edges = np.sort(rng.uniform(0, 100, size=2 * int(rng.integers(0, 30))))
        movements = np.column_stack([edges[::2], edges[1::2], rng.normal(size=len(edges) // 2)])
        table[name] = movements, float(rng.normal())
    times = rng.uniform(-1, 101, size=500)
    whole = MotionCurves(table).evaluate(times)
    for row, (name, curve) in enumerate(table.items()):
        np.testing.assert_array_equal(whole[row], MotionCurves({name: curve}).evaluate(times)[0])
        value = curve[1]
        for start, end, goal in curve[0]:
            middle = MotionCurves({name: curve}).evaluate(np.array([(start + end) / 2]))[0, 0]
            assert middle == pytest.approx((value + goal) / 2)
            value = goal


def test_movements_that_overlap_are_refused() -> None:
    with pytest.raises(ValueError, match="'a' overlap"):
        MotionCurves({"a": ([(0, 2, 1), (1, 3, 0)], 0)})
    with pytest.raises(ValueError, match="'b' overlap"):
        MotionCurves({"b": ([(2, 1, 1)], 0)})
