import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from reina import rotations as r

QUATERNIONS = Rotation.random(500, random_state=4).as_quat()
_DIRECTIONS = np.random.default_rng(5).normal(size=(200, 3))
AXES = _DIRECTIONS / np.linalg.norm(_DIRECTIONS, axis=1, keepdims=True)
# Where naive formulas break: none, tiny, next to pi, pi.
HARD_ANGLES = [0.0, 1e-300, 1e-160, 1e-17, 1e-9, 1e-4, 1.0, np.pi - 1e-4, np.pi - 1e-9, np.pi - 1e-15, np.pi]


def test_matrices_agree_with_scipy_both_ways() -> None:
    matrices = Rotation.from_quat(QUATERNIONS).as_matrix()
    np.testing.assert_allclose(r.to_matrix(QUATERNIONS), matrices, atol=1e-12)
    assert r.angle_between(r.from_matrix(matrices), QUATERNIONS).max() < 1e-12


def test_half_turns_survive_the_matrix() -> None:
    half_turns = r.from_axis_angle(AXES, np.pi)
    assert r.angle_between(r.from_matrix(r.to_matrix(half_turns)), half_turns).max() < 1e-12


def test_from_matrix_names_a_wrong_shape() -> None:
    with pytest.raises(ValueError, match=r"\(\.\.\., 3, 3\)"):
        r.from_matrix(np.eye(4))


@pytest.mark.parametrize("angle", HARD_ANGLES)
def test_log_returns_what_exp_was_given(angle: float) -> None:
    vectors = AXES * angle
    q = r.exp(vectors)
    np.testing.assert_allclose(np.sum(q * q, axis=-1), 1.0, atol=1e-15)
    back = r.log(q)
    np.testing.assert_allclose(np.linalg.norm(back, axis=-1), angle, rtol=1e-15, atol=1e-15)
    # At pi itself an axis and its opposite are one rotation.
    if angle < np.pi - 1e-12:
        np.testing.assert_allclose(back, vectors, rtol=1e-12, atol=1e-15 * angle)
    assert r.angle_between(r.exp(back), q).max() < 4e-15


def test_exp_and_log_agree_with_scipy() -> None:
    vectors = Rotation.from_quat(QUATERNIONS).as_rotvec()
    np.testing.assert_allclose(r.log(QUATERNIONS), vectors, atol=1e-12)
    np.testing.assert_allclose(r.log_matrix(r.to_matrix(QUATERNIONS)), vectors, atol=1e-11)
    np.testing.assert_allclose(r.exp_matrix(vectors), Rotation.from_rotvec(vectors).as_matrix(), atol=1e-12)
    long_way = np.random.default_rng(6).normal(size=(100, 3)) * 20.0
    assert r.angle_between(r.exp(long_way), Rotation.from_rotvec(long_way).as_quat()).max() < 1e-12


def test_log_of_a_negative_quaternion_is_the_short_way() -> None:
    np.testing.assert_allclose(r.log(-QUATERNIONS), r.log(QUATERNIONS), atol=1e-15)
    assert np.linalg.norm(r.log(QUATERNIONS), axis=-1).max() <= np.pi


def test_turns_about_the_coordinate_axes() -> None:
    for axis in range(3):
        np.testing.assert_array_equal(r.about_axis(axis, 0.7), r.from_axis_angle(np.eye(3)[axis], 0.7))


@pytest.mark.parametrize("order", r.ORDERS)
def test_euler_agrees_with_scipy(order: str) -> None:
    intrinsic = order.upper()  # scipy writes turns about moving axes in capitals
    expected = Rotation.from_quat(QUATERNIONS).as_euler(intrinsic)
    np.testing.assert_allclose(r.to_euler(QUATERNIONS, order), expected, atol=1e-12)
    angles = np.random.default_rng(7).uniform(-4, 4, size=(200, 3))
    assert (
        r.angle_between(r.from_euler(angles, order), Rotation.from_euler(intrinsic, angles).as_quat()).max()
        < 1e-12
    )


@pytest.mark.parametrize("order", r.ORDERS)
@pytest.mark.parametrize("off", [0.0, 1e-12, 1e-8, 1e-6, 1e-3])
def test_euler_keeps_the_rotation_in_and_near_gimbal_lock(order: str, off: float) -> None:
    middles = [off, np.pi - off] if order[0] == order[2] else [np.pi / 2 - off, off - np.pi / 2]
    for middle in middles:
        q = r.from_euler([0.7, middle, 0.4], order)
        angles = r.to_euler(q, order)
        assert r.angle_between(r.from_euler(angles, order), q) < max(3e-8 if off else 1e-15, 1e-15)
        if off == 0.0:
            assert angles[2] == 0.0


@given(st.sampled_from(r.ORDERS), st.lists(st.floats(-7, 7), min_size=3, max_size=3))
def test_euler_there_and_back(order: str, angles: list[float]) -> None:
    q = r.from_euler(angles, order)
    assert r.angle_between(r.from_euler(r.to_euler(q, order), order), q) < 2e-7


def test_one_and_two_angles_are_orders_too() -> None:
    np.testing.assert_array_equal(r.from_euler([0.3], "y"), r.about_axis(1, 0.3))
    np.testing.assert_array_equal(
        r.from_euler([0.3, 0.4], "yz"), r.multiply(r.about_axis(1, 0.3), r.about_axis(2, 0.4))
    )


@pytest.mark.parametrize("order", ["abc", "xyzx", "", "XYZ"])
def test_unknown_orders_are_named(order: str) -> None:
    with pytest.raises(ValueError, match="not known"):
        r.from_euler(np.zeros(max(len(order), 1)), order)
    with pytest.raises(ValueError, match=r"not known; the orders are xyx"):
        r.to_euler(r.IDENTITY, order)
