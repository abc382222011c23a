from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from reina import rotations as r
from reina.kinematics import (
    FingerChains,
    SolveStatus,
    finger_rotations,
    finger_tip,
    project_on_finger_plane,
    project_on_hand_planes,
    solve_planar,
    target_in_hand,
)
from reina.skeleton import Rig, RigError, forward_kinematics, read_rig
from reina.skeleton.document import Node

RNG = np.random.default_rng(31)
LENGTHS = np.array([[0.040, 0.024, 0.020], [0.045, 0.026, 0.021], [0.041, 0.024, 0.020]])


def hand_rig(*, solver: dict[str, Any], seed: int = 0) -> Rig:
    """A hand with three fingers whose rest rotations are random where the conventions leave them free."""
    rng = np.random.default_rng(seed)

    def joint(
        name: str, parent: str | None, translation: Any, rotation: Any, limits: Any = None
    ) -> dict[str, Any]:
        entry = {"name": name, "parent": parent, "translation": list(translation), "rotation": list(rotation)}
        return entry | ({"limits": limits} if limits else {})

    root = Rotation.random(random_state=seed).as_quat()
    joints = [joint("hand", None, rng.normal(size=3), root)]
    effectors: list[dict[str, Any]] = []
    chains: list[dict[str, Any]] = []
    for f, (l1, l2, l3) in enumerate(LENGTHS):
        rest = Rotation.random(random_state=seed + f + 1).as_quat()
        bend2, bend3 = rng.uniform(-0.6, 0.1, size=2)
        limits = [
            {"order": "yzx", "x": [0, 0], "y": [-0.35, 0.35], "z": [-1.2, 1.4]},
            {"order": "yzx", "x": [0, 0], "y": [0, 0], "z": [-2.35619449 - bend2, -bend2]},
            {"order": "yzx", "x": [0, 0], "y": [0, 0], "z": [-0.785398164 - bend3, -bend3]},
        ]
        joints.append(joint(f"f{f}a", "hand", rng.normal(scale=0.03, size=3), rest, limits[0]))
        joints.append(joint(f"f{f}b", f"f{f}a", (l1, 0, 0), r.about_axis(2, bend2), limits[1]))
        joints.append(joint(f"f{f}c", f"f{f}b", (l2, 0, 0), r.about_axis(2, bend3), limits[2]))
        effectors.append({"name": f"tip{f}", "joint": f"f{f}c", "offset": [l3, 0, 0]})
        chains.append(
            {"name": f"f{f}", "joints": [f"f{f}a", f"f{f}b", f"f{f}c"], "effector": f"tip{f}", **solver}
        )
    document = {"name": "hand", "joints": joints, "effectors": effectors, "chains": chains}
    return read_rig(Node(document))


NAMES = ["f0", "f1", "f2"]
COUPLED = {"solver": "coupled_three_bone", "kappa": 1 / 3}


def world_tips(rig: Rig, rotations: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Tips by the rig's own forward kinematics, and the hand's pose, all in the world."""
    positions, world = forward_kinematics(rig.skeleton, rotations)
    tips = [
        positions[..., p.joint, :] + r.rotate(world[..., p.joint, :], p.offset)
        for p in rig.effectors.values()
    ]
    return np.stack(tips, axis=-2), positions[..., 0, :], world[..., 0, :]


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_pads_reach_their_targets_from_random_poses_and_rests(seed: int) -> None:
    rig = hand_rig(solver=COUPLED, seed=seed)
    fingers = FingerChains(rig, NAMES)
    frames = 200
    rotations = np.broadcast_to(rig.skeleton.rest_rotations, (frames, 10, 4)).copy()
    rotations[:, 0] = Rotation.random(frames, random_state=seed).as_quat()
    angles = RNG.uniform(fingers.limits[..., 0], fingers.limits[..., 1], size=(frames, 3, 3))
    angles[..., 2] = angles[..., 1] / 3
    local = finger_rotations(RNG.uniform(-0.34, 0.34, size=(frames, 3)), angles)
    local[..., 0, :] = r.multiply(rig.skeleton.rest_rotations[fingers.joints[:, 0]], local[..., 0, :])
    rotations[:, fingers.joints] = local
    tips, hand, R_world_hand = world_tips(rig, rotations)

    in_hand = r.rotate(r.conjugate(R_world_hand)[:, None], tips - hand[:, None])
    np.testing.assert_allclose(fingers.tips(local), in_hand, atol=1e-12)
    found, status = fingers.solve(in_hand)
    # A finger bent so far that its tip is behind its knuckle may turn sideways otherwise than it did.
    assert np.mean(status == SolveStatus.REACHED) > 0.95
    rotations[:, fingers.joints] = found
    again, _, _ = world_tips(rig, rotations)
    reached = status == SolveStatus.REACHED
    assert np.linalg.norm(again - tips, axis=-1)[reached].max() < 1e-9
    for finger in range(3):
        for place in range(3):
            joint = int(fingers.joints[finger, place])
            limits = rig.limits[joint]
            from_rest = r.multiply(r.conjugate(rig.skeleton.rest_rotations[joint]), found[:, finger, place])
            euler = r.to_euler(from_rest, limits.order)
            first, middle, last = euler[:, 0], euler[:, 1], euler[:, 2]
            # Beyond 90° about the middle axis the rotation's other set of angles is the one in limits.
            folded = np.abs(first) > 0.5 * np.pi
            middle = np.where(folded, np.copysign(np.pi, middle) - middle, middle)
            first, last = (
                np.where(folded, angle - np.copysign(np.pi, angle), angle) for angle in (first, last)
            )
            for angle, letter in zip((first, middle, last), limits.order, strict=True):
                component = "xyz".index(letter)
                assert angle.min() > limits.minimum[component] - 1e-7
                assert angle.max() < limits.maximum[component] + 1e-7


def test_the_papers_finger_reaches_with_phi() -> None:
    rig = hand_rig(solver={"solver": "planar_three_bone", "phi_rad": float(np.radians(-115))})
    fingers = FingerChains(rig, NAMES)
    assert len(fingers.names) == 3
    angles = np.array([0.2, -1.5, np.radians(-115) + 1.3])
    planar = finger_tip(angles, LENGTHS)
    local = finger_rotations(np.array([0.1, 0.0, -0.2]), np.broadcast_to(angles, (3, 3)))
    local[..., 0, :] = r.multiply(rig.skeleton.rest_rotations[fingers.joints[:, 0]], local[..., 0, :])
    found, status = fingers.solve(fingers.tips(local))
    assert status.tolist() == [SolveStatus.REACHED] * 3
    assert r.angle_between(found, local).max() < 1e-9
    assert planar.shape == (3, 2)


def test_the_eight_steps_and_what_the_projection_costs() -> None:
    """The paper's planes shorten the target by the cosine of the abduction; the finger's own does not."""
    lengths = LENGTHS[0]
    hand = Rotation.random(random_state=3).as_quat()
    origin = np.array([0.3, 1.1, -0.2])
    for abduction in (0.0, 0.1, 0.3):
        angles = np.array([0.1, -1.4, np.radians(-115) + 1.3])
        local = finger_rotations(abduction, angles)

        def tip(local: np.ndarray) -> np.ndarray:
            point = np.array([lengths[2], 0, 0])
            point = r.rotate(local[2], point) + np.array([lengths[1], 0, 0])
            point = r.rotate(local[1], point) + np.array([lengths[0], 0, 0])
            return r.rotate(local[0], point)

        target = origin + r.rotate(hand, tip(local))
        in_hand = target_in_hand(hand, origin, target)
        np.testing.assert_allclose(in_hand, tip(local), atol=1e-12)

        side, planar, off_plane = project_on_finger_plane(in_hand)
        assert side == pytest.approx(abduction, abs=1e-12)
        assert off_plane == pytest.approx(0.0, abs=1e-15)
        own, _ = solve_planar(planar, lengths, angles.sum())
        np.testing.assert_allclose(tip(finger_rotations(side, own)), in_hand, atol=1e-12)

        side, planar = project_on_hand_planes(in_hand)
        assert side == pytest.approx(abduction, abs=1e-12)
        assert planar[0] == pytest.approx(np.cos(abduction) * np.hypot(in_hand[0], in_hand[2]), abs=1e-12)
        paper, _ = solve_planar(planar, lengths, angles.sum())
        error = np.linalg.norm(tip(finger_rotations(side, paper)) - in_hand)
        shortening = np.hypot(in_hand[0], in_hand[2]) * (1 - np.cos(abduction))
        assert error == pytest.approx(shortening, rel=1e-6, abs=1e-12)


def test_flipped_hand_axes() -> None:
    plain = target_in_hand([0, 0, 0, 1], [0, 0, 0], [1, 2, 3])
    assert plain.tolist() == [1, 2, 3]
    flipped = target_in_hand([0, 0, 0, 1], [0, 0, 0], [1, 2, 3], axis_signs=(-1, -1, 1))
    assert flipped.tolist() == [-1, -2, 3]


def test_abduction_stops_at_its_limit_and_says_how_far_off() -> None:
    side, planar, off = project_on_finger_plane([0.05, -0.02, -0.05], (-0.3, 0.3))
    assert side == 0.3
    assert abs(off) > 0.02
    rebuilt = r.rotate(r.about_axis(1, side), [planar[0], planar[1], off])
    np.testing.assert_allclose(rebuilt, [0.05, -0.02, -0.05], atol=1e-15)


def test_a_target_behind_the_knuckle_is_met_by_bending() -> None:
    side, planar, off = project_on_finger_plane([-0.02, -0.03, 0.004])
    assert abs(side) < 0.3
    assert planar[0] < 0
    assert off == pytest.approx(0.0, abs=1e-15)


def test_rigs_that_break_the_fingers_conventions_are_refused() -> None:
    rig = hand_rig(solver=COUPLED)
    rig.skeleton.rest_translations.flags.writeable = True
    rig.skeleton.rest_translations[2, 1] = 0.01  # of f0b: where the bone of f0a ends
    with pytest.raises(RigError, match="the bone of 'f0a' must lie along its x axis"):
        FingerChains(rig, NAMES)
    rig = hand_rig(solver=COUPLED)
    rig.skeleton.rest_rotations.flags.writeable = True
    rig.skeleton.rest_rotations[3] = r.about_axis(0, 0.3)
    with pytest.raises(RigError, match="'f0c' must rest turned about z alone"):
        FingerChains(rig, NAMES)
