import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from reina import rotations as r

RNG = np.random.default_rng(20)
A = Rotation.random(500, random_state=1).as_quat()
B = Rotation.random(500, random_state=2).as_quat()
C = Rotation.random(500, random_state=3).as_quat()
VECTORS = RNG.normal(size=(500, 3))


def test_multiply_agrees_with_scipy() -> None:
    expected = (Rotation.from_quat(A) * Rotation.from_quat(B)).as_quat()
    assert r.angle_between(r.multiply(A, B), expected).max() < 1e-12


def test_the_units_multiply_as_hamilton_wrote() -> None:
    i, j, k = np.eye(4)[:3]
    np.testing.assert_array_equal(r.multiply(i, j), k)
    np.testing.assert_array_equal(r.multiply(j, k), i)
    np.testing.assert_array_equal(r.multiply(k, i), j)
    np.testing.assert_array_equal(r.multiply(i, i), [0, 0, 0, -1])


def test_group_axioms() -> None:
    left = r.multiply(r.multiply(A, B), C)
    right = r.multiply(A, r.multiply(B, C))
    np.testing.assert_allclose(left, right, atol=1e-15)
    np.testing.assert_allclose(
        r.multiply(A, r.conjugate(A)), np.broadcast_to(r.IDENTITY, A.shape), atol=1e-15
    )
    np.testing.assert_array_equal(r.multiply(A, r.IDENTITY), A)


def test_multiply_broadcasts_and_takes_views_that_are_not_contiguous() -> None:
    block = np.stack([A[:60], B[:60]], axis=1)  # (60, 2, 4)
    product = r.multiply(block, C[:2])
    np.testing.assert_array_equal(product[:, 1], r.multiply(B[:60], C[1]))
    reversed_storage = np.asfortranarray(A)
    np.testing.assert_array_equal(r.multiply(reversed_storage, B), r.multiply(A, B))
    assert r.multiply([0, 0, 0, 1], [1, 0, 0, 0]).tolist() == [1, 0, 0, 0]


def test_rotate_agrees_with_scipy() -> None:
    np.testing.assert_allclose(r.rotate(A, VECTORS), Rotation.from_quat(A).apply(VECTORS), atol=1e-12)
    np.testing.assert_allclose(r.rotate(A[:, None], VECTORS[:3])[:, 2], r.rotate(A, VECTORS[2]), atol=1e-15)


def test_cross_agrees_with_numpy() -> None:
    np.testing.assert_allclose(r.cross(VECTORS, VECTORS[::-1]), np.cross(VECTORS, VECTORS[::-1]), atol=1e-15)


@pytest.mark.parametrize("scale", [1e-300, 1e-8, 1.0, 1e300])
def test_normalize_keeps_the_direction_at_every_size(scale: float) -> None:
    np.testing.assert_allclose(r.normalize(A * scale), A, atol=1e-15)


@pytest.mark.parametrize("broken", [[0.0, 0, 0, 0], [np.nan, 0, 0, 1], [np.inf, 0, 0, 1]])
def test_normalize_refuses_what_is_no_rotation(broken: list[float]) -> None:
    with pytest.raises(ValueError, match="no rotation"):
        r.normalize(broken)


def test_a_wrong_shape_is_named() -> None:
    with pytest.raises(ValueError, match=r"\(\.\.\., 4\).*\(5, 3\)"):
        r.multiply(np.zeros((5, 3)), A[0])


@given(st.floats(0.0, np.pi), st.integers(0, 499))
def test_angle_between_returns_the_angle_of_the_turn(angle: float, index: int) -> None:
    turned = r.multiply(A[index], r.from_axis_angle(VECTORS[index] / np.linalg.norm(VECTORS[index]), angle))
    assert abs(r.angle_between(A[index], turned) - angle) < 4e-15
    assert abs(r.angle_between(A[index], -turned) - angle) < 4e-15


def test_angle_between_is_exact_for_tiny_angles() -> None:
    for angle in (1e-3, 1e-8, 1e-12):
        turned = r.multiply(A, r.from_axis_angle([0.0, 0.0, 1.0], angle))
        np.testing.assert_allclose(r.angle_between(A, turned), angle, atol=1e-15)


def test_same_hemisphere_changes_the_sign_alone() -> None:
    result = r.same_hemisphere(A, B)
    assert np.all(r.dot(result, B) >= 0.0)
    np.testing.assert_array_equal(np.abs(result), np.abs(A))


def test_continuous_undoes_random_sign_flips() -> None:
    smooth = r.exp(np.linspace(0, 9, 400)[:, None] * np.array([0.6, 0.0, 0.8]))
    signs = np.where(RNG.random(400) < 0.5, -1.0, 1.0)
    signs[0] = 1.0
    np.testing.assert_array_equal(r.continuous(smooth * signs[:, None]), smooth)
    block = np.stack([smooth * signs[:, None], smooth], axis=0)
    np.testing.assert_array_equal(r.continuous(block, axis=1)[0], smooth)
    np.testing.assert_array_equal(r.continuous(A[:1]), A[:1])
