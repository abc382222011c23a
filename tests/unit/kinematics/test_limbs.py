from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from reina import rotations as r
from reina.kinematics import SolveStatus, TwistHelpers, TwoBoneLimbs, hinge_directions_from_poles
from reina.skeleton import RigError, forward_kinematics, load_rig, read_rig
from reina.skeleton.document import Node

RIG = load_rig(Path(__file__).parents[3] / "rigs" / "trumpeter")
NAMES = ["leftArm", "rightArm", "leftLeg", "rightLeg"]
FRAMES = 300


def random_poses(limbs: TwoBoneLimbs, seed: int) -> np.ndarray:
    """Whole poses with every limb turned at random and every hinge at random within its limits."""
    rng = np.random.default_rng(seed)
    rotations = np.broadcast_to(RIG.skeleton.rest_rotations, (FRAMES, len(RIG.skeleton), 4)).copy()
    for k, (upper, lower, end) in enumerate(limbs.joints.tolist()):
        rotations[:, upper] = Rotation.random(FRAMES, random_state=seed + k).as_quat()
        rotations[:, end] = Rotation.random(FRAMES, random_state=seed + 9 + k).as_quat()
        limits = RIG.limits[lower]
        axis = int(np.argmax(np.subtract(limits.maximum, limits.minimum)))
        rest = RIG.skeleton.rest_rotations[lower]
        angle = rng.uniform(limits.minimum[axis], limits.maximum[axis], size=FRAMES)
        rotations[:, lower] = r.multiply(rest, r.about_axis(axis, angle))
    return rotations


def test_ends_come_back_from_random_poses() -> None:
    limbs = TwoBoneLimbs(RIG, NAMES)
    rotations = random_poses(limbs, 1)
    positions, world = forward_kinematics(RIG.skeleton, rotations)
    roots, ends = positions[:, limbs.joints[:, 0]], positions[:, limbs.joints[:, 2]]
    hinges = r.rotate(world[:, limbs.joints[:, 0]], limbs.hinge)
    pose = limbs.solve(roots, ends, hinges)
    assert np.mean(pose.status == SolveStatus.REACHED) > 0.99
    reached = pose.status == SolveStatus.REACHED
    np.testing.assert_allclose(pose.ends[reached], ends[reached], atol=1e-9)
    # Put into the skeleton, the limbs do meet their ends.
    parents = world[:, RIG.skeleton.parents[limbs.joints[:, 0]]]
    rotations[:, limbs.joints[:, 0]] = r.multiply(r.conjugate(parents), pose.upper)
    rotations[:, limbs.joints[:, 1]] = pose.lower_local
    again, _ = forward_kinematics(RIG.skeleton, rotations)
    error = np.linalg.norm(again[:, limbs.joints[:, 2]] - ends, axis=-1)
    assert error[reached].max() < 1e-9
    for k, lower in enumerate(limbs.joints[:, 1].tolist()):
        limits = RIG.limits[lower]
        from_rest = r.multiply(r.conjugate(RIG.skeleton.rest_rotations[lower]), pose.lower_local[:, k])
        euler = r.to_euler(from_rest, limits.order)
        for place, letter in enumerate(limits.order):
            component = "xyz".index(letter)
            assert euler[:, place].min() > limits.minimum[component] - 1e-7
            assert euler[:, place].max() < limits.maximum[component] + 1e-7


def test_agrees_with_a_numeric_solver() -> None:
    limbs = TwoBoneLimbs(RIG, ["rightArm"])
    upper, lower, end = limbs.joints[0].tolist()
    rest = RIG.skeleton.rest_rotations[lower]
    limits = RIG.limits[lower]
    for wanted in (0.2, 0.35, 0.48):

        def miss(angle: np.ndarray, wanted: float = wanted) -> list[float]:
            local = r.multiply(rest, r.about_axis(1, angle[0]))
            reach = RIG.skeleton.rest_translations[lower] + r.rotate(
                local, RIG.skeleton.rest_translations[end]
            )
            return [float(np.linalg.norm(reach)) - wanted]

        numeric = least_squares(miss, [0.5], bounds=([limits.minimum[1]], [limits.maximum[1]]), xtol=1e-14)
        pose = limbs.solve([[0.0, 0, 0]], [[0, 0, wanted]], [[1.0, 0, 0]])
        expected = r.multiply(rest, r.about_axis(1, numeric.x[0]))
        assert r.angle_between(pose.lower_local[0], expected) < 1e-6
        assert upper != lower


def test_elbows_and_knees_point_at_their_poles() -> None:
    limbs = TwoBoneLimbs(RIG, NAMES)
    rng = np.random.default_rng(4)
    roots = rng.normal(size=(FRAMES, 4, 3))
    directions = rng.normal(size=(FRAMES, 4, 3))
    directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
    targets = roots + directions * 0.8 * limbs.reach[:, None]
    poles = roots + rng.normal(size=(FRAMES, 4, 3))
    pose = limbs.solve(roots, targets, hinge_directions_from_poles(roots, targets, poles, limbs.bend))
    lower = RIG.skeleton.rest_translations[limbs.joints[:, 1]]
    elbows = r.rotate(pose.upper, lower)
    across = elbows - directions * r.dot(elbows, directions)[..., None]
    to_pole = poles - roots
    to_pole = to_pole - directions * r.dot(to_pole, directions)[..., None]
    cosine = r.dot(across, to_pole) / np.linalg.norm(across, axis=-1) / np.linalg.norm(to_pole, axis=-1)
    # Arms bend about an axis exactly across their bones; the study's legs do not lie in one plane.
    assert cosine[:, :2].min() > 1 - 1e-9
    assert cosine[:, 2:].min() > 0.8


def test_out_of_reach_stretches_towards_the_target() -> None:
    limbs = TwoBoneLimbs(RIG, ["leftArm"])
    pose = limbs.solve([[0.0, 0, 0]], [[0.0, 0, 3.0]], [[0.0, 1.0, 0]])
    assert pose.status.tolist() == [SolveStatus.OUT_OF_REACH]
    np.testing.assert_allclose(pose.ends, [[0, 0, limbs.reach[0]]], atol=1e-12)
    near = limbs.solve([[0.0, 0, 0]], [[0.0, 0, 0.01]], [[0.0, 1.0, 0]])
    assert near.status.tolist() == [SolveStatus.OUT_OF_REACH]
    np.testing.assert_allclose(near.ends, [[0, 0, limbs.nearest[0]]], atol=1e-12)


def test_soft_reach_straightens_without_a_snap() -> None:
    hard, soft = TwoBoneLimbs(RIG, ["leftArm"]), TwoBoneLimbs(RIG, ["leftArm"], softness=0.05)
    distance = np.linspace(0.8, 1.1, 2000)[:, None] * hard.reach
    targets = np.zeros((2000, 1, 3))
    targets[..., 2] = distance
    roots, hinge = np.zeros((2000, 1, 3)), np.array([[0.0, 1.0, 0.0]])
    angles = [r.log(limbs.solve(roots, targets, hinge).lower_local)[:, 0, 1] for limbs in (hard, soft)]
    steps = [np.abs(np.diff(angle)).max() for angle in angles]
    assert steps[1] < 0.3 * steps[0]
    before = distance[:, 0] < 0.94 * hard.reach[0]
    np.testing.assert_allclose(angles[1][before], angles[0][before], atol=1e-9)


def test_a_hinge_needs_limits_that_leave_one_axis() -> None:
    def joint(name: str, parent: str | None, limits: Any = None) -> dict[str, Any]:
        entry: dict[str, Any] = {
            "name": name,
            "parent": parent,
            "translation": [1, 0, 0],
            "rotation": [0, 0, 0, 1],
        }
        return entry | ({"limits": limits} if limits else {})

    free = {"order": "xyz", "x": [-1, 1], "y": [-1, 1], "z": [0, 0]}
    for limits, message in ((None, "needs limits"), (free, "one axis, not x, y")):
        document = {
            "name": "arm",
            "joints": [joint("a", None), joint("b", "a", limits), joint("c", "b")],
            "chains": [{"name": "arm", "joints": ["a", "b", "c"], "solver": "two_bone"}],
        }
        with pytest.raises(RigError, match=message):
            TwoBoneLimbs(read_rig(Node(document)), ["arm"])


def test_twist_helpers_take_their_share() -> None:
    twists = TwistHelpers(RIG)
    angle = 0.9
    rest = RIG.skeleton.rest_rotations
    sources = r.multiply(rest[twists.sources], r.about_axis(0, np.full(len(twists.sources), angle)))
    helpers = r.multiply(r.conjugate(rest[twists.joints]), twists.solve(sources))
    fractions = np.array([twist.fraction for twist in RIG.twists])
    np.testing.assert_allclose(2.0 * np.arctan2(helpers[:, 0], helpers[:, 3]), angle * fractions, atol=1e-12)
    # A swing of the source alone leaves them where they are.
    swung = r.multiply(rest[twists.sources], r.about_axis(1, np.full(len(twists.sources), 0.7)))
    np.testing.assert_allclose(r.angle_between(twists.solve(swung), rest[twists.joints]), 0.0, atol=1e-12)
