"""Every answer is checked against the whole skeleton's forward kinematics, not against the lab's own."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np
import pytest

from reina.kinematics import SolveStatus, solve_ccd, solve_damped_least_squares, solve_fabrik
from reina.lab import LabError, PosableChain, SolverSettings, check_angles, map_reach, pose_chain, solve_chain
from reina.lab.solver_settings import CLOSED_FORM, SOLVERS
from reina.rotations import conjugate, rotate
from reina.skeleton import forward_kinematics

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from reina.lab.solver_settings import SolverName
    from reina.skeleton import Rig

SHOWN = ("rightIndex", "leftLittle", "rightArm", "leftLeg")
QUESTIONS = [(name, solver) for name in SHOWN[:2] for solver in SOLVERS["finger"]] + [
    (name, solver) for name in SHOWN[2:] for solver in SOLVERS["limb"]
]


def random_angles(chain: PosableChain, generator: np.random.Generator) -> NDArray[np.float64]:
    low = [hinge.minimum_rad for hinge in chain.hinges]
    high = [hinge.maximum_rad for hinge in chain.hinges]
    return generator.uniform(low, high)


def stranger(chain: PosableChain, rig: Rig, angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """Joints and end in the carrier's frame, by forward kinematics of the whole rig."""
    local = rig.skeleton.rest_rotations.copy()
    local[list(chain.joints)] = chain.limited.rotations(angles[None])[0]
    positions, rotations = forward_kinematics(rig.skeleton, local)
    if chain.chain.effector is None:
        end = positions[chain.chain.joints[-1]]
    else:
        tip = rig.effectors[chain.chain.effector]
        end = positions[tip.joint] + rotate(rotations[tip.joint], tip.offset)
    points = np.array([*positions[list(chain.joints)], end])
    return rotate(conjugate(rotations[chain.carrier]), points - positions[chain.carrier])


def test_all_fingers_and_limbs_are_there(chains: dict[str, PosableChain]) -> None:
    sides = [
        f"{side}{part}"
        for side in ("left", "right")
        for part in ("Arm", "Leg", "Index", "Middle", "Ring", "Little")
    ]
    assert sorted(chains) == sorted(sides)
    assert [hinge.axis for hinge in chains["rightIndex"].hinges] == ["y", "z", "z", "z"]
    assert chains["rightArm"].joint_names == ("rightUpperArm", "rightLowerArm")
    assert chains["rightArm"].end_name == "rightHand"


@pytest.mark.parametrize("name", SHOWN)
def test_a_pose_is_what_the_whole_skeleton_says(name: str, chains: dict[str, PosableChain], rig: Rig) -> None:
    chain = chains[name]
    generator = np.random.default_rng(5)
    for _ in range(10):
        given = random_angles(chain, generator)
        angles = check_angles(chain, given, limits=True)
        pose = pose_chain(chain, angles)
        np.testing.assert_allclose(pose.positions, stranger(chain, rig, angles), atol=1e-12)
        np.testing.assert_allclose([hinge.angle_rad for hinge in pose.hinges], given)
        for hinge in pose.hinges:
            assert hinge.beyond_rad == 0.0
            np.testing.assert_allclose(hinge.fan @ hinge.axis, 0.0, atol=1e-12)
            # The present direction lies in the fan: no further from its nearest ray than half a step.
            assert np.max(hinge.fan @ hinge.direction) > np.cos(np.radians(2.6))


def test_a_finger_is_read_as_the_planar_arm_counts(chains: dict[str, PosableChain]) -> None:
    chain = chains["rightIndex"]
    settings = SolverSettings("planar_three_bone", phi_rad=float(np.radians(-80.0)), limits=False)
    target = chain.limited.links[0] + [0.055, -0.045, 0.0]
    solved = solve_chain(chain, target, settings)
    assert solved.status is SolveStatus.REACHED
    finger = pose_chain(chain, solved.angles).finger
    assert finger is not None
    assert np.degrees(finger.phi_rad) == pytest.approx(-80.0, abs=1e-6)
    l1, l2, l3 = chain.bone_lengths
    a, b, c = np.cumsum(finger.theta_rad)
    reach = l1 * np.cos(a) + l2 * np.cos(b) + l3 * np.cos(c)
    drop = l1 * np.sin(a) + l2 * np.sin(b) + l3 * np.sin(c)
    local = rotate(conjugate(chain.limited.rest[0]), target - chain.limited.links[0])
    assert [reach, drop] == pytest.approx([np.hypot(local[0], local[2]), local[1]], abs=1e-9)


@pytest.mark.parametrize(("name", "solver"), QUESTIONS)
@pytest.mark.parametrize("limits", [True, False])
def test_an_answer_is_as_good_as_it_says(
    name: str, solver: SolverName, limits: bool, chains: dict[str, PosableChain], rig: Rig
) -> None:
    chain = chains[name]
    settings = SolverSettings(solver, limits=limits, iterations=30)
    generator = np.random.default_rng(11)
    reached = 0
    for _ in range(6):
        target = stranger(chain, rig, check_angles(chain, random_angles(chain, generator), limits=True))[-1]
        solved = solve_chain(chain, target, settings)
        points = stranger(chain, rig, solved.angles)
        assert np.linalg.norm(points[-1] - target) == pytest.approx(solved.error_m, abs=1e-9)
        assert (solved.status is SolveStatus.REACHED) == (solved.error_m <= settings.tolerance_m)
        reached += solved.status is SolveStatus.REACHED
        pose = pose_chain(chain, solved.angles)
        if limits:
            assert max(hinge.beyond_rad for hinge in pose.hinges) == 0.0
        if solver in CLOSED_FORM:
            assert solved.rounds == ()
        else:
            assert solved.iterations <= settings.iterations
            np.testing.assert_allclose(solved.rounds[-1].positions, pose.positions, atol=1e-9)
    assert reached >= (0 if solver == "planar_three_bone" else 1)


@pytest.mark.parametrize("solver", ["ccd", "fabrik", "damped_least_squares"])
def test_round_by_round_is_the_same_as_at_once(solver: SolverName, chains: dict[str, PosableChain]) -> None:
    at_once = {"ccd": solve_ccd, "fabrik": solve_fabrik, "damped_least_squares": solve_damped_least_squares}
    chain = chains["rightArm"]
    target = np.array([-0.3, 0.05, 0.2])
    expected = at_once[solver](chain.limited, target, iterations=12)
    found = solve_chain(chain, target, SolverSettings(solver, iterations=12))
    assert found.iterations == expected.iterations[0]
    assert found.error_m == pytest.approx(float(expected.error[0]), abs=1e-12)
    errors = [one.error_m for one in found.rounds]
    for bound in (1, 3):
        shorter = at_once[solver](chain.limited, target, iterations=bound)
        assert errors[bound] == pytest.approx(float(shorter.error[0]), abs=1e-12)


def test_a_start_is_where_the_rounds_begin(chains: dict[str, PosableChain]) -> None:
    chain = chains["rightIndex"]
    start = check_angles(chain, np.radians([5.0, -30.0, -40.0, -10.0]), limits=True)
    target = chain.limited.links[0] + [0.06, -0.03, 0.0]
    solved = solve_chain(chain, target, SolverSettings("ccd"), start)
    np.testing.assert_allclose(solved.rounds[0].positions, pose_chain(chain, start).positions, atol=1e-9)


def test_out_of_reach_is_said_and_points_there(chains: dict[str, PosableChain]) -> None:
    for name, direction in (("rightIndex", [1.0, -0.3, 0.0]), ("rightArm", [-0.9, 0.1, 0.4])):
        chain = chains[name]
        target = chain.limited.links[0] + 2.0 * np.array(direction)
        for solver in chain.solvers:
            solved = solve_chain(chain, target, SolverSettings(solver, iterations=10))
            assert solved.status is SolveStatus.OUT_OF_REACH
            assert solved.error_m > 0.5


def test_a_swivel_moves_the_elbow_and_not_the_hand(chains: dict[str, PosableChain]) -> None:
    chain = chains["rightArm"]
    target = np.array([-0.3, -0.05, 0.25])
    elbows: list[NDArray[np.float64]] = []
    for swivel in np.radians([0.0, 40.0, 80.0]):
        settings = SolverSettings("two_bone", limits=False, swivel_rad=float(swivel))
        solved = solve_chain(chain, target, settings)
        assert solved.error_m < 1e-9
        elbows.append(pose_chain(chain, solved.angles).positions[1])
    line = target - chain.limited.links[0]
    line /= np.linalg.norm(line)
    arms = [elbow - chain.limited.links[0] for elbow in elbows]
    across = [arm - line * (arm @ line) for arm in arms]
    turns = [np.arccos(a @ b / np.linalg.norm(a) / np.linalg.norm(b)) for a, b in itertools.pairwise(across)]
    assert np.degrees(turns) == pytest.approx([40.0, 40.0])


def test_a_target_at_the_shoulder_itself_is_defined(chains: dict[str, PosableChain]) -> None:
    chain = chains["rightArm"]
    solved = solve_chain(chain, chain.limited.links[0], SolverSettings("two_bone"))
    assert np.all(np.isfinite(solved.angles))
    assert solved.status is SolveStatus.OUT_OF_REACH


def test_wrong_questions_are_refused_with_what_would_be_right(chains: dict[str, PosableChain]) -> None:
    with pytest.raises(
        LabError, match="two_bone does not solve a finger; rightIndex takes coupled_three_bone"
    ):
        solve_chain(chains["rightIndex"], np.zeros(3), SolverSettings("two_bone"))
    with pytest.raises(LabError, match=r"rightIndex has 4 angles .*, not 3"):
        check_angles(chains["rightIndex"], [0.0, 0.0, 0.0], limits=True)
    with pytest.raises(LabError, match=r"angles_rad/2: rightIndexIntermediate z turns from -1\d\d\.\d° to"):
        check_angles(chains["rightIndex"], [0.0, 0.0, 2.0, 0.0], limits=True)
    assert check_angles(chains["rightIndex"], [0.0, 0.0, 2.0, 0.0], limits=False).max() == 2.0


def test_without_limits_a_hinge_tells_how_far_it_is_beyond(chains: dict[str, PosableChain]) -> None:
    chain = chains["rightIndex"]
    high = chain.hinges[2].maximum_rad
    pose = pose_chain(chain, check_angles(chain, [0.0, 0.0, high + 0.25, 0.0], limits=False))
    assert [hinge.beyond_rad for hinge in pose.hinges] == pytest.approx([0.0, 0.0, 0.25, 0.0])


@pytest.mark.parametrize(("name", "solver"), [("rightIndex", "coupled_three_bone"), ("leftLeg", "two_bone")])
def test_a_reach_map_says_what_solving_says(
    name: str, solver: SolverName, chains: dict[str, PosableChain]
) -> None:
    chain = chains[name]
    settings = SolverSettings(solver, swivel_rad=0.0)
    through = pose_chain(chain, check_angles(chain, np.zeros(len(chain.hinges)), limits=False)).positions[-1]
    found = map_reach(chain, settings, "xy", through)
    rows, columns = found.reached.shape
    assert 0.02 < found.reached.mean() < 0.9
    generator = np.random.default_rng(2)
    for row, column in zip(
        generator.integers(rows, size=25), generator.integers(columns, size=25), strict=True
    ):
        cell = found.corner + column * found.right + row * found.up
        assert cell[2] == pytest.approx(through[2])
        assert found.reached[row, column] == (
            solve_chain(chain, cell, settings).status is SolveStatus.REACHED
        )


def test_the_papers_finger_reaches_less_than_the_coupled_one(chains: dict[str, PosableChain]) -> None:
    chain = chains["rightMiddle"]
    coupled, planar = (
        map_reach(chain, SolverSettings(solver), "xy", chain.limited.links[0]).reached.mean()
        for solver in ("coupled_three_bone", "planar_three_bone")
    )
    assert 0.0 < planar < 0.4 * coupled
