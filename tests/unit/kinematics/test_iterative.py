from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from reina import rotations as r
from reina.kinematics import (
    ChainSolution,
    JointChain,
    SolveStatus,
    clamp_to_limits,
    excess_over_limits,
    limit_angles,
    solve_ccd,
    solve_damped_least_squares,
    solve_fabrik,
)
from reina.skeleton import Limits, RigError, load_rig

RIG = load_rig(Path(__file__).parents[3] / "rigs" / "trumpeter")
Solver = Callable[..., ChainSolution]
SOLVERS: list[Solver] = [solve_ccd, solve_fabrik, solve_damped_least_squares]
TARGETS = 60

MIN_SOLVED = {
    ("rightIndex", "solve_ccd"): 0.9,
    ("rightIndex", "solve_fabrik"): 0.35,
    ("rightIndex", "solve_damped_least_squares"): 0.98,
    ("rightArm", "solve_ccd"): 0.6,
    ("rightArm", "solve_fabrik"): 0.4,
    ("rightArm", "solve_damped_least_squares"): 0.9,
    ("leftLeg", "solve_ccd"): 0.7,
    ("leftLeg", "solve_fabrik"): 0.9,
    ("leftLeg", "solve_damped_least_squares"): 0.95,
}
"""Of targets that random poses within the limits reach, from the rest pose. Limits are what makes it hard."""


def reachable(chain: JointChain, seed: int) -> np.ndarray:
    angles = np.random.default_rng(seed).uniform(chain.low, chain.high, size=(TARGETS, *chain.low.shape))
    return chain.stance(angles).positions[:, -1]


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("name", ["rightIndex", "rightArm", "leftLeg"])
def test_solvers_reach_what_can_be_reached_and_keep_the_limits(name: str, solver: Solver) -> None:
    chain = JointChain.from_rig(RIG, name)
    targets = reachable(chain, 1)
    found = solver(chain, targets, tolerance_m=1e-4, iterations=100)
    reached = found.status == SolveStatus.REACHED
    assert np.mean(reached) >= MIN_SOLVED[name, solver.__name__]
    ends = chain.stance(chain.angles(found.rotations)).positions[:, -1]
    np.testing.assert_allclose(np.linalg.norm(ends - targets, axis=-1), found.error, atol=1e-9)
    assert found.error[reached].max() <= 1e-4
    assert np.all(found.status[~reached] == SolveStatus.NOT_CONVERGED)
    assert np.all(found.iterations[~reached] == 100)
    np.testing.assert_allclose(np.linalg.norm(found.rotations, axis=-1), 1.0, atol=1e-12)
    for joint, limits in enumerate(chain.limits):
        assert excess_over_limits(found.rotations[:, joint], chain.rest[joint], limits).max() < 1e-9


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_chain_without_limits_is_always_solved(solver: Solver) -> None:
    rng = np.random.default_rng(2)
    links = rng.normal(scale=0.2, size=(6, 3))
    chain = JointChain(links, Rotation.random(5, random_state=3).as_quat(), (None,) * 5)
    start = Rotation.random(TARGETS * 5, random_state=4).as_quat().reshape(TARGETS, 5, 4)
    found = solver(chain, reachable_by_rotations(chain, 5), start, iterations=200)
    assert np.all(found.status == SolveStatus.REACHED)


def reachable_by_rotations(chain: JointChain, seed: int) -> np.ndarray:
    angles = np.random.default_rng(seed).uniform(-np.pi, np.pi, size=(TARGETS, *chain.low.shape))
    return chain.stance(angles).positions[:, -1]


@pytest.mark.parametrize("solver", SOLVERS)
def test_beyond_its_length_a_chain_stretches_and_says_so(solver: Solver) -> None:
    links = [[0.0, 0, 0], [0.3, 0, 0], [0.2, 0, 0], [0.1, 0, 0]]
    chain = JointChain(links, np.tile([0.0, 0, 0, 1], (3, 1)), (None, None, None))
    start = r.from_euler(np.random.default_rng(6).uniform(-1, 1, size=(3, 3)), "xyz")
    found = solver(chain, [0.0, 0.0, 2.0], start, iterations=300)
    assert found.status.tolist() == [SolveStatus.OUT_OF_REACH]
    assert found.error[0] == pytest.approx(2.0 - 0.6, abs=0.01)


@pytest.mark.parametrize("solver", SOLVERS)
def test_what_is_there_already_takes_no_round(solver: Solver) -> None:
    chain = JointChain.from_rig(RIG, "leftArm")
    here = chain.stance(chain.angles(chain.rest[None])).positions[:, -1]
    found = solver(chain, here)
    assert found.iterations.tolist() == [0]
    assert found.status.tolist() == [SolveStatus.REACHED]


def test_angles_and_rotations_are_two_ways_to_say_a_pose() -> None:
    chain = JointChain.from_rig(RIG, "rightIndex")
    angles = np.random.default_rng(7).uniform(chain.low, chain.high, size=(50, *chain.low.shape))
    np.testing.assert_allclose(chain.angles(chain.rotations(angles)), angles, atol=1e-9)


def test_limits_beyond_a_right_angle_are_read_rightly() -> None:
    """A finger bends by 113° about its middle axis: its other set of angles would break limits."""
    limits = Limits("yzx", (0.0, 0.0, -1.98), (0.0, 0.0, 0.38))
    bent = r.about_axis(2, np.array([-1.97, -1.6, -0.5, 0.3]))
    np.testing.assert_allclose(
        limit_angles(bent, r.IDENTITY, limits)[:, 1], [-1.97, -1.6, -0.5, 0.3], atol=1e-9
    )
    np.testing.assert_allclose(excess_over_limits(bent, r.IDENTITY, limits), 0.0, atol=1e-9)
    over = r.about_axis(2, np.array([-2.5, 1.0]))
    np.testing.assert_allclose(excess_over_limits(over, r.IDENTITY, limits), [0.52, 0.62], atol=1e-9)
    clamped = clamp_to_limits(over, r.IDENTITY, limits)
    np.testing.assert_allclose(
        r.angle_between(clamped, r.about_axis(2, np.array([-1.98, 0.38]))), 0.0, atol=1e-9
    )


def test_chains_that_are_none_are_refused() -> None:
    with pytest.raises(RigError, match="no chain 'tail'"):
        JointChain.from_rig(RIG, "tail")
    with pytest.raises(ValueError, match="2 joints need 3 links and 2 limits"):
        JointChain(np.zeros((2, 3)), np.tile([0.0, 0, 0, 1], (2, 1)), (None, None))
    stiff = Limits("xyz", (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    with pytest.raises(ValueError, match="no joint of the chain can turn"):
        JointChain(np.ones((2, 3)), [[0.0, 0, 0, 1]], (stiff,))
