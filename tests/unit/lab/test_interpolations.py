from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from reina.lab import LabError, Orientation, compare_interpolations
from reina.rotations import ORDERS, angle_between, rotate

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from reina.lab import Comparison, Way

ANGLES = arrays(np.float64, 3, elements=st.floats(-3.0, 3.0))


def compare(first: Orientation, second: Orientation, order: str = "zyx", samples: int = 61) -> Comparison:
    return compare_interpolations(first, second, euler_order=order, samples=samples, tip=[0.2, -0.5, 1.0])


def way(comparison: Comparison, name: str) -> Way:
    return next(way for way in comparison.ways if way.name == name)


@given(ANGLES, ANGLES, st.sampled_from(ORDERS))
def test_slerp_alone_is_shortest_and_even(
    first: NDArray[np.float64], second: NDArray[np.float64], order: str
) -> None:
    found = compare(Orientation.from_euler(first, order), Orientation.from_euler(second, order), order)
    slerp = way(found, "slerp")
    assert slerp.length_rad == pytest.approx(found.angle_rad, abs=1e-9)
    np.testing.assert_allclose(slerp.speed, found.angle_rad, atol=1e-9)
    for one in found.ways:
        assert one.length_rad >= found.angle_rad - 1e-9
        np.testing.assert_allclose(np.linalg.norm(one.quaternions, axis=1), 1.0, atol=1e-12)
        if one.name != "matrix":
            np.testing.assert_allclose(one.determinant, 1.0, atol=1e-12)
            assert one.orthogonality_error.max() < 1e-12


@given(ANGLES, ANGLES)
def test_all_ways_begin_and_end_at_the_same_orientations(
    first: NDArray[np.float64], second: NDArray[np.float64]
) -> None:
    found = compare(Orientation.from_euler(first, "yxz"), Orientation.from_euler(second, "zxz"), "xyz")
    for one in found.ways:
        ends = angle_between(one.quaternions[[0, -1]], np.array([found.start, found.end]))
        np.testing.assert_allclose(ends, 0.0, atol=1e-7)
        np.testing.assert_allclose(one.tip[0], rotate(found.start, [0.2, -0.5, 1.0]), atol=1e-7)


def test_the_wrong_ways_are_uneven_and_a_blended_matrix_shrinks() -> None:
    found = compare(
        Orientation.from_euler(np.radians([80, -20, -50]), "zyx"),
        Orientation.from_euler(np.radians([-60, 80, 80]), "zyx"),
    )
    euler, matrix, vector = (way(found, name) for name in ("euler", "matrix", "rotation_vector"))
    assert euler.speed.max() / euler.speed.min() > 1.5
    assert euler.length_rad > 1.7 * found.angle_rad
    assert matrix.speed.max() / matrix.speed.min() > 8
    assert matrix.determinant.min() < 0.2
    assert matrix.orthogonality_error.max() > 1.0
    assert np.linalg.norm(matrix.tip, axis=1).min() < 0.9 * np.linalg.norm([0.2, -0.5, 1.0])
    assert vector.length_rad > 1.5 * found.angle_rad


def test_angles_go_the_way_that_they_were_given() -> None:
    rest = Orientation.from_euler([0.0, 0.0, 0.0], "zyx")
    for turn, length in ((270.0, 270.0), (-90.0, 90.0)):
        by_euler = compare(rest, Orientation.from_euler(np.radians([turn, 0.0, 0.0]), "zyx"))
        assert np.degrees(way(by_euler, "euler").length_rad) == pytest.approx(length)
        about = Orientation.from_axis_angle([0.0, 0.0, 5.0], float(np.radians(turn)))
        by_vector = compare(Orientation.from_axis_angle([1.0, 0.0, 0.0], 0.0), about)
        assert np.degrees(way(by_vector, "rotation_vector").length_rad) == pytest.approx(length)
        assert np.degrees(by_vector.angle_rad) == pytest.approx(90.0)


def test_in_another_order_the_angles_are_those_within_range() -> None:
    turned = Orientation.from_euler(np.radians([270.0, 0.0, 0.0]), "zyx")
    assert np.degrees(turned.as_euler("zyx")).tolist() == pytest.approx([270.0, 0.0, 0.0])
    assert np.degrees(turned.as_euler("xyz")) == pytest.approx([0.0, 0.0, -90.0])


def test_half_a_turn_has_no_shortest_way_and_is_defined_all_the_same() -> None:
    found = compare(
        Orientation.from_axis_angle([0, 1, 0], 0.0), Orientation.from_axis_angle([0, 1, 0], float(np.pi))
    )
    for one in found.ways:
        assert np.all(np.isfinite(one.quaternions))
        assert np.all(np.isfinite(one.speed))
    assert way(found, "matrix").determinant.min() == pytest.approx(0.0, abs=1e-12)


def test_an_axis_without_direction_is_refused() -> None:
    with pytest.raises(LabError, match="axis: its length is zero"):
        Orientation.from_axis_angle([0.0, 0.0, 0.0], 1.0)
    with pytest.raises(LabError, match="quaternion"):
        Orientation.from_quaternion([0.0, 0.0, 0.0, 0.0])
