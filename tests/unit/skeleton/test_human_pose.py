"""One frame of anybody's motion file as a pose."""

from dataclasses import replace

import numpy as np
import pytest
from tests.unit.skeleton.figures import NAMES, POSES, figure

from reina.rotations import angle_between, from_euler, multiply
from reina.skeleton import HumanPose, MotionClip, PoseError, human_pose, humanoid_name, read_bvh, write_bvh
from reina.skeleton.human_pose import POSED


def apart(one: HumanPose, other: HumanPose) -> float:
    """The largest angle between the turns of two poses, degrees."""
    return max(float(np.degrees(angle_between(one.turns[name], other.turns[name]))) for name in POSED)


@pytest.mark.parametrize("names", NAMES)
@pytest.mark.parametrize("pose", POSES)
def test_whatever_the_joints_are_called_it_is_the_same_pose(names: str, pose: str) -> None:
    written = write_bvh(figure(pose, names))
    assert apart(human_pose(read_bvh(written), 0.1), human_pose(figure(pose), 0.1)) < 1e-3


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("mixamorig:LeftForeArm", "leftLowerArm"),
        ("Character1_RightUpLeg", "rightUpperLeg"),
        ("Bip001 L Calf", "leftLowerLeg"),
        ("bip01_r_foot", "rightFoot"),
        ("DEF-thigh.L", "leftUpperLeg"),
        ("rfemur", "rightUpperLeg"),
        ("LEFT_KNEE", "leftLowerLeg"),
        ("RightAnkle", "rightFoot"),
        ("LHipJoint", None),
        ("LeftFootEnd", None),
        ("", None),
    ],
)
def test_a_name_is_told_by_its_words(name: str, meant: str | None) -> None:
    assert humanoid_name(name) == meant


def test_size_place_and_facing_do_not_matter() -> None:
    plain = human_pose(figure(), 0.1)
    for scale in (1.0, 0.01, 1.0 / 2.54):
        assert (
            apart(plain, human_pose(figure(scale=scale, facing=130.0, place=(40.0, 10.0, -900.0)), 0.1))
            < 1e-4
        )


def test_the_first_frame_stands_upright() -> None:
    assert (
        apart(human_pose(figure(), 0.0), HumanPose({name: np.array([0.0, 0, 0, 1]) for name in POSED})) < 1e-6
    )


def test_a_file_whose_height_is_z_is_stood_up() -> None:
    clip = figure()
    rotations, translations = clip.motion()
    lying = from_euler(np.radians([90.0]), "x")
    turned = multiply(multiply(lying, rotations), lying * [-1.0, -1.0, -1.0, 1.0])
    stood = MotionClip.from_motion(
        clip.names,
        clip.parents,
        clip.offsets[:, [0, 2, 1]] * [1.0, -1.0, 1.0],
        turned,
        translations[:, 0],
        clip.frame_time_s,
    )
    assert apart(human_pose(stood, 0.1), human_pose(clip, 0.1)) < 1e-4


def test_what_is_missing_is_named_with_what_there_is() -> None:
    clip = figure()
    renamed = replace(clip, names=tuple("thing" if name == "LeftFoot" else name for name in clip.names))
    with pytest.raises(PoseError, match=r"no joint for leftFoot; its joints are Hips, LowerBack"):
        human_pose(renamed, 0.1)


def test_a_time_beyond_the_end_and_a_figure_that_lies_are_refused() -> None:
    with pytest.raises(PoseError, match=r"2 s: there is no frame; the file has them from 0 to 0.10 s"):
        human_pose(figure(), 2.0)
    with pytest.raises(PoseError, match=r"0.10 s: nobody stands in this frame"):
        human_pose(figure({"hips": (-88.0, 0.0, 0.0)}), 0.1)
