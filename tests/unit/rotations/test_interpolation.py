import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

from reina import rotations as r

A = Rotation.random(200, random_state=8).as_quat()
B = Rotation.random(200, random_state=9).as_quat()
FRACTIONS = np.linspace(0.0, 1.0, 11)


def test_slerp_agrees_with_scipy() -> None:
    for a, b in zip(A, B, strict=True):
        expected = Slerp([0.0, 1.0], Rotation.from_quat([a, b]))(FRACTIONS).as_quat()
        assert r.angle_between(r.slerp(a, b, FRACTIONS), expected).max() < 1e-12


def test_slerp_is_r1_exp_t_log_r1_transposed_r2() -> None:
    for t in (0.0, 0.3, 1.0, 1.4):
        expected = r.slerp_matrix(r.to_matrix(A), r.to_matrix(B), t)
        np.testing.assert_allclose(r.to_matrix(r.slerp(A, B, t)), expected, atol=1e-11)


def test_slerp_turns_at_constant_speed() -> None:
    path = r.slerp(A[:, None], B[:, None], np.linspace(0, 1, 60))
    steps = r.angle_between(path[:, 1:], path[:, :-1])
    np.testing.assert_allclose(steps, np.broadcast_to(steps[:, :1], steps.shape), atol=1e-13)


@pytest.mark.parametrize("angle", [0.0, 1e-300, 1e-12, 1e-6, 1e-3, np.pi - 1e-9])
def test_slerp_is_exact_for_near_and_far_ends(angle: float) -> None:
    end = r.multiply(A, r.about_axis(1, angle))
    np.testing.assert_allclose(r.angle_between(r.slerp(A, end, 0.25), A), 0.25 * angle, atol=1e-15)


def test_slerp_takes_the_short_way_unless_told() -> None:
    np.testing.assert_allclose(r.slerp(A, -B, 0.4), r.slerp(A, B, 0.4) * 1.0, atol=1e-14)
    far = r.slerp(r.IDENTITY, -r.about_axis(0, 0.2), 0.5, shortest=False)
    assert r.angle_between(far, r.IDENTITY) == pytest.approx(np.pi - 0.1)


def test_exactly_opposite_ends_give_a_unit_quaternion() -> None:
    q = r.slerp(A, -A, FRACTIONS[:, None], shortest=False)
    assert np.all(np.isfinite(q))


@pytest.mark.parametrize("curve", [r.squad, r.spline])
def test_curves_pass_through_their_keys_and_hold_outside(curve: type) -> None:
    times = np.array([0.0, 0.5, 1.0, 1.5, 2.0])
    keys = A[:5]
    assert r.angle_between(curve(times, keys, times), keys).max() < 1e-12
    outside = curve(times, keys, [-1.0, 3.0])
    assert r.angle_between(outside, keys[[0, -1]]).max() < 1e-12
    assert r.angle_between(curve([1.0], keys[:1], [0.0, 2.0]), keys[0]).max() < 1e-12


@pytest.mark.parametrize(
    ("curve", "times"), [(r.squad, [0, 0.5, 1.0, 1.5, 2.0]), (r.spline, [0, 0.2, 1.0, 1.3, 2.0])]
)
def test_curves_have_a_continuous_velocity(curve: type, times: list[float]) -> None:
    rng = np.random.default_rng(10)
    keys = r.exp(np.cumsum(rng.normal(scale=0.5, size=(5, 3)), axis=0))
    h = 1e-6

    def velocity(t: float) -> np.ndarray:
        ends = curve(times, keys, [t - h / 2, t + h / 2])
        return r.log(r.multiply(r.conjugate(ends[0]), ends[1])) / h

    for t in times[1:-1]:
        before, after = velocity(t - h), velocity(t + h)
        np.testing.assert_allclose(before, after, atol=2e-4)
        assert np.linalg.norm(before) > 0.01


def test_curves_take_blocks_of_joints() -> None:
    keys = A[:12].reshape(4, 3, 4)
    times = [0.0, 1.0, 1.5, 3.0]
    at = np.linspace(0, 3, 20)
    for curve in (r.squad, r.spline):
        whole = curve(times, keys, at)
        assert whole.shape == (20, 3, 4)
        assert r.angle_between(whole[:, 1], curve(times, keys[:, 1], at)).max() < 1e-12


def test_curves_refuse_times_that_do_not_increase() -> None:
    with pytest.raises(ValueError, match="must increase"):
        r.spline([0.0, 0.0], A[:2], [0.0])
    with pytest.raises(ValueError, match="one time each"):
        r.squad([0.0, 1.0, 2.0], A[:2], [0.0])
