"""Poses reflected from left to right."""

from pathlib import Path

import numpy as np
import pytest

from reina.rotations import dot, from_axis_angle, multiply, normalize, rotate
from reina.rotations.arrays import FloatArray
from reina.skeleton import (
    ACROSS,
    Mirror,
    Rig,
    RigError,
    Skeleton,
    forward_kinematics,
    load_hold,
    load_rig,
    mirrored_hold,
    other_side,
)

RIGS = Path(__file__).resolve().parents[3] / "rigs"
PLAYERS = ("trumpeter", "soloist")


def bent(rig: Rig, seed: int) -> FloatArray:
    """Some pose, ``(3, J, 4)``."""
    rest = rig.skeleton.rest_rotations
    chance = np.random.default_rng(seed)
    turns = normalize(
        np.concatenate([0.5 * chance.normal(size=(3, len(rest), 3)), np.ones((3, len(rest), 1))], -1)
    )
    return multiply(rest, turns)


@pytest.mark.parametrize("name", PLAYERS)
def test_every_place_of_a_pose_is_on_the_other_side(name: str) -> None:
    rig = load_rig(RIGS / name)
    skeleton, mirror = rig.skeleton, Mirror(rig.skeleton)
    pose, root = bent(rig, 1), np.array([[0.1, 0.9, 0.2]] * 3)
    places, turns = forward_kinematics(skeleton, pose, root)
    other, other_turns = forward_kinematics(skeleton, mirror.rotations(pose), root * ACROSS)
    own = np.array([0.01, 0.02, 0.03])
    for joint, called in enumerate(skeleton.names):
        partner = skeleton.index(other_side(called))
        assert other[:, joint] == pytest.approx(places[:, partner] * ACROSS, abs=1e-6), called
        # What is fixed to a joint goes along.
        fixed = rotate(other_turns[:, joint], own * mirror.axes[joint])
        assert fixed == pytest.approx(rotate(turns[:, partner], own) * ACROSS, abs=1e-6), called


@pytest.mark.parametrize("name", PLAYERS)
def test_twice_reflected_is_the_same_to_the_last_bit(name: str) -> None:
    rig = load_rig(RIGS / name)
    mirror, pose = Mirror(rig.skeleton), bent(rig, 2)
    assert np.array_equal(mirror.rotations(mirror.rotations(pose)), pose)
    rest = rig.skeleton.rest_rotations
    assert (dot(mirror.rotations(rest), rest) > 0.999).all()


def test_the_kit_s_own_joints_keep_their_names() -> None:
    kit, left = (load_rig(RIGS / name).skeleton for name in ("drumkit", "drumkit_left_handed"))
    mirror = Mirror(kit, left)
    places, _ = forward_kinematics(kit, kit.rest_rotations)
    mirrored, _ = forward_kinematics(left, mirror.rotations(kit.rest_rotations))
    assert mirrored == pytest.approx(places * ACROSS, abs=1e-9)
    assert left.names == kit.names


@pytest.mark.parametrize("name", PLAYERS)
def test_a_hold_is_mirrored_with_what_is_carried(name: str) -> None:
    player, hold = load_rig(RIGS / name), load_hold(RIGS / name, "drumkit")
    sticks = {f"{side}_stick": load_rig(RIGS / f"{side}_stick") for side in ("left", "right")}
    carried = {stick: rig.skeleton for stick, rig in sticks.items()}
    mirrored = mirrored_hold(hold, player.skeleton, carried, instrument="drumkit_left_handed")
    places = [
        forward_kinematics(player.skeleton, one.rotations(player), one.hips_position)
        for one in (hold, mirrored)
    ]
    for stick, other in (("left_stick", "right_stick"), ("right_stick", "left_stick")):
        tips: list[FloatArray] = []
        for (at, turns), one, called in zip(places, (hold, mirrored), (stick, other), strict=True):
            attached = one.attachments[called]
            hand = player.skeleton.index(attached.joint)
            tip = sticks[called].effector(f"{called.removesuffix('_stick')}StickTip").offset
            along = attached.position + rotate(attached.rotation, tip)
            tips.append(at[hand] + rotate(turns[hand], along))
        assert tips[1] == pytest.approx(tips[0] * ACROSS, abs=1e-6), stick


def test_who_is_not_the_mirror_image_is_named() -> None:
    figure = load_rig(RIGS / "soloist").skeleton
    longer = figure.rest_translations.copy()
    longer[figure.index("leftHand")] *= 1.1
    lame = Skeleton(figure.names, figure.parents, longer, figure.rest_rotations)
    with pytest.raises(RigError, match="'leftHand' does not rest as the mirror image of 'rightHand'"):
        Mirror(lame)
    turned = figure.rest_rotations.copy()
    toes = figure.index("rightToes")
    turned[toes] = multiply(turned[toes], from_axis_angle(np.array([1.0, 0.0, 0.0]), np.array(0.1)))
    with pytest.raises(RigError, match="'leftToes' does not rest"):
        Mirror(Skeleton(figure.names, figure.parents, figure.rest_translations, turned))
    with pytest.raises(RigError, match="no joint is the mirror image of"):
        Mirror(figure, load_rig(RIGS / "drumkit").skeleton)
