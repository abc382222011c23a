import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import least_squares

from reina.kinematics import (
    TABLE_1_RAD,
    VALVE_PHI_RAD,
    CoupledFinger,
    SolveStatus,
    finger_tip,
    planar_solutions,
    solve_planar,
)

RNG = np.random.default_rng(30)
COUNT = 5000
LENGTHS = RNG.uniform(0.012, 0.055, size=(COUNT, 3))
LOW, HIGH = TABLE_1_RAD[:, 0], TABLE_1_RAD[:, 1]
KAPPAS = [0.2, 1.0 / 3.0, 0.5, 2.0 / 3.0, 1.0]


def coupled_angles(kappa: float, count: int = COUNT) -> np.ndarray:
    angles = RNG.uniform(LOW, HIGH, size=(count, 3))
    angles[:, 2] = np.maximum(kappa * angles[:, 1], LOW[2])
    return angles


def test_table_1_is_the_papers() -> None:
    np.testing.assert_allclose(np.degrees(TABLE_1_RAD), [[-70, 80], [-135, 0], [-45, 0]])
    assert np.degrees(VALVE_PHI_RAD) == pytest.approx(-115)


def test_the_tip_of_a_straight_and_of_a_bent_finger() -> None:
    np.testing.assert_allclose(finger_tip([0, 0, 0], [3, 2, 1]), [6, 0])
    np.testing.assert_allclose(finger_tip([np.pi / 2, -np.pi / 2, -np.pi / 2], [3, 2, 1]), [2, 2], atol=1e-15)


def test_planar_solve_returns_random_poses_within_the_limits() -> None:
    angles = RNG.uniform(LOW, HIGH, size=(COUNT, 3))
    tips = finger_tip(angles, LENGTHS)
    found, status = solve_planar(tips, LENGTHS, angles.sum(axis=-1))
    assert np.all(status == SolveStatus.REACHED)
    np.testing.assert_allclose(finger_tip(found, LENGTHS), tips, atol=1e-12)
    np.testing.assert_allclose(found.sum(axis=-1), angles.sum(axis=-1), atol=1e-12)
    assert np.all((found >= LOW - 1e-9) & (found <= HIGH + 1e-9))
    # θ2 <= 0 leaves one solution, so the pose itself comes back; a straight one is ill-conditioned.
    bent = angles[:, 1] < -0.01
    np.testing.assert_allclose(found[bent], angles[bent], atol=1e-9)


def test_both_planar_solutions_reach_and_bend_either_way() -> None:
    angles = RNG.uniform(LOW, HIGH, size=(COUNT, 3))
    tips = finger_tip(angles, LENGTHS)
    both, excess = planar_solutions(tips, LENGTHS, angles.sum(axis=-1))
    assert excess.max() < 1e-12
    for i in range(2):
        np.testing.assert_allclose(finger_tip(both[:, i], LENGTHS), tips, atol=1e-9)
    assert np.all(both[:, 0, 1] <= 0.0)
    assert np.all(both[:, 1, 1] >= 0.0)


def test_without_a_solution_the_paper_sets_all_angles_to_zero() -> None:
    lengths = [0.04, 0.025, 0.018]
    angles, status = solve_planar([[0.2, 0.0], [0.075, 0.0]], lengths)
    assert status.tolist() == [SolveStatus.OUT_OF_REACH, SolveStatus.OUT_OF_REACH]
    np.testing.assert_array_equal(angles, 0.0)
    # Within reach for the two bones, but the last bone would have to bend backwards.
    angles, status = solve_planar([0.05, 0.02], lengths, 1.2)
    assert status == SolveStatus.AT_LIMIT
    np.testing.assert_array_equal(angles, 0.0)


def test_phi_of_115_degrees_reaches_13_percent_of_the_workspace() -> None:
    angles = RNG.uniform(LOW, HIGH, size=(20000, 3))
    lengths = np.array([0.040, 0.024, 0.020])
    _, status = solve_planar(finger_tip(angles, lengths), lengths)
    assert 0.05 < np.mean(status == SolveStatus.REACHED) < 0.3


@pytest.mark.parametrize("kappa", KAPPAS)
def test_coupled_solve_returns_random_poses(kappa: float) -> None:
    angles = coupled_angles(kappa)
    tips = finger_tip(angles, LENGTHS)
    found, status = CoupledFinger(LENGTHS, kappa).solve(tips)
    assert np.all(status == SolveStatus.REACHED)
    np.testing.assert_allclose(finger_tip(found, LENGTHS), tips, atol=1e-13)
    np.testing.assert_allclose(found, angles, atol=1e-7)
    np.testing.assert_allclose(found[:, 2], np.maximum(kappa * found[:, 1], LOW[2]), atol=1e-15)


def test_the_quartic_has_one_root_in_range_and_newton_finds_it() -> None:
    angles = coupled_angles(1.0 / 3.0, 300)
    lengths = LENGTHS[:300]
    tips = finger_tip(angles, lengths)
    found, _ = CoupledFinger(lengths).solve(tips)
    for (l1, l2, l3), (x, y), theta2 in zip(lengths, tips, found[:, 1], strict=True):
        constant = 2 * l1 * l3 + l1**2 + l2**2 + l3**2 - x**2 - y**2
        roots = np.roots([16 * l1 * l3, 8 * l1 * l2, -16 * l1 * l3, 2 * l2 * l3 - 6 * l1 * l2, constant])
        real = roots.real[np.abs(roots.imag) < 1e-6]
        inside = real[(real > np.sqrt(0.5) - 1e-9) & (real < 1 + 1e-9)]
        assert len(inside) == 1
        assert np.cos(theta2 / 3) == pytest.approx(inside[0], abs=1e-7)


@pytest.mark.parametrize("kappa", [1.0 / 3.0, 2.0 / 3.0])
def test_closed_form_agrees_with_a_numeric_solver(kappa: float) -> None:
    angles = coupled_angles(kappa, 40)
    lengths = LENGTHS[:40]
    tips = finger_tip(angles, lengths)
    found, _ = CoupledFinger(lengths, kappa).solve(tips)
    for tip, bones, ours in zip(tips, lengths, found, strict=True):

        def error(free: np.ndarray, bones: np.ndarray = bones, tip: np.ndarray = tip) -> np.ndarray:
            whole = [free[0], free[1], max(kappa * free[1], LOW[2])]
            return (finger_tip(whole, bones) - tip) * 100.0

        bounds = (LOW[:2] - 1e-9, HIGH[:2] + 1e-9)
        best = min(
            (
                least_squares(error, x0, bounds=bounds, xtol=1e-15, ftol=1e-15, gtol=1e-15)
                for x0 in ([0, -1], [0.5, -2])
            ),
            key=lambda result: result.cost,
        )
        assert best.cost < 1e-12
        np.testing.assert_allclose(ours[:2], best.x, atol=1e-4)


@given(st.floats(-0.2, 0.2), st.floats(-0.2, 0.2), st.sampled_from(KAPPAS))
def test_every_target_gives_angles_within_the_limits(x: float, y: float, kappa: float) -> None:
    lengths = np.array([0.040, 0.024, 0.020])
    angles, status = CoupledFinger(lengths, kappa).solve([x, y])
    assert np.all((angles >= LOW - 1e-12) & (angles <= HIGH + 1e-12))
    error = np.linalg.norm(finger_tip(angles, lengths) - [x, y])
    assert (error < 1e-9) == (status == SolveStatus.REACHED) or error < 2e-9


def test_out_of_reach_points_at_the_target_straight() -> None:
    lengths = np.array([0.040, 0.024, 0.020])
    angles, status = CoupledFinger(lengths).solve([[0.5, 0.3], [0.001, 0.0]])
    assert status.tolist() == [SolveStatus.OUT_OF_REACH, SolveStatus.OUT_OF_REACH]
    np.testing.assert_allclose(angles[0], [np.arctan2(0.3, 0.5), 0, 0], atol=1e-12)
    np.testing.assert_allclose(angles[1, 1:], LOW[1:], atol=1e-7)


def test_a_first_joint_that_stops_says_so() -> None:
    lengths = np.array([0.040, 0.024, 0.020])
    angles, status = CoupledFinger(lengths).solve([-0.07, 0.01])
    assert status == SolveStatus.AT_LIMIT
    assert angles[0] in (LOW[0], HIGH[0])


def test_the_result_moves_smoothly_past_the_end_of_reach() -> None:
    lengths = np.array([0.040, 0.024, 0.020])
    distance = np.linspace(0.07, 0.1, 3001)
    angles, _ = CoupledFinger(lengths).solve(np.stack([distance, np.zeros_like(distance)], axis=-1))
    # The straightening goes as a square root, so a step of 10 µm moves joints by no more than this.
    assert np.abs(np.diff(angles, axis=0)).max() < 0.06


@pytest.mark.parametrize(
    ("lengths", "kappa", "limits"),
    [
        ([0.04, 0.0, 0.02], 0.3, TABLE_1_RAD),
        ([0.04, 0.03, 0.02], 0.0, TABLE_1_RAD),
        ([1, 1, 1], 0.3, -TABLE_1_RAD[:, ::-1]),
    ],
)
def test_impossible_fingers_are_refused(lengths: list[float], kappa: float, limits: np.ndarray) -> None:
    with pytest.raises(ValueError, match="coupled finger"):
        CoupledFinger(lengths, kappa, limits)
