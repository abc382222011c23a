from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from reina import rotations as r
from reina.skeleton import (
    BvhError,
    MotionClip,
    blended,
    clip_of_motion,
    forward_kinematics,
    humanoid_name,
    load_rig,
    looped,
    read_bvh,
    retarget,
    write_bvh,
)

RIG = load_rig(Path(__file__).parents[3] / "rigs" / "trumpeter")

PLAIN = """HIERARCHY
ROOT Hips
{
	OFFSET 1.0 2.0 3.0
	CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
	JOINT Left Knee
	{
		OFFSET 0.0 -18.5 0.5
		CHANNELS 3 Yrotation Zrotation Xrotation
		End Site
		{
			OFFSET 0.0 -3.1 0.0
		}
	}
	JOINT Chest
	{
		OFFSET 0.0 5.25 0.0
		CHANNELS 1 Xrotation
		End Site
		{
			OFFSET 0.0 1.0 0.0
		}
	}
}
MOTION
Frames: 2
Frame Time: 0.033333
1 2 3 10 20 30 40 50 60 70
-1 -2 -3 -10 -20 -30 -40 -50 -60 -70
"""


def world_positions(clip: MotionClip) -> np.ndarray:
    """Positions by 4 x 4 matrices, channel by channel: another reading of the same format."""
    frames = np.zeros((len(clip), len(clip.names), 3))
    for frame, row in enumerate(clip.values):
        values = iter(row.tolist())
        matrices: list[np.ndarray] = []
        for joint, channels in enumerate(clip.channels):
            link, turn = np.eye(4), np.eye(4)
            link[:3, 3] = clip.offsets[joint]
            for channel in channels:
                axis, kind = "XYZ".index(channel[0]), channel[1:]
                if kind == "position":
                    link[axis, 3] = next(values)
                else:
                    one = np.eye(4)
                    one[:3, :3] = Rotation.from_euler(
                        channel[0].lower(), next(values), degrees=True
                    ).as_matrix()
                    turn = turn @ one
            parent: np.ndarray = matrices[int(clip.parents[joint])] if joint else np.eye(4)
            matrices.append(parent @ link @ turn)
            frames[frame, joint] = matrices[-1][:3, 3]
    return frames


def our_positions(clip: MotionClip) -> np.ndarray:
    rotations, translations = clip.motion()
    world = np.empty(rotations.shape)
    positions = np.empty(translations.shape)
    for joint, parent in enumerate(clip.parents.tolist()):
        if joint == 0:
            world[:, 0], positions[:, 0] = rotations[:, 0], translations[:, 0]
            continue
        world[:, joint] = r.multiply(world[:, parent], rotations[:, joint])
        positions[:, joint] = positions[:, parent] + r.rotate(world[:, parent], translations[:, joint])
    return positions


def test_a_plain_file() -> None:
    clip = read_bvh(PLAIN)
    assert clip.names == ("Hips", "Left Knee", "Chest")
    assert clip.parents.tolist() == [-1, 0, 0]
    assert clip.channels[2] == ("Xrotation",)
    assert clip.end_sites[1] == ((0.0, -3.1, 0.0),)
    assert clip.frame_time_s == 0.033333
    assert clip.values.shape == (2, 10)
    np.testing.assert_allclose(our_positions(clip), world_positions(clip), atol=1e-12)
    # The root stands where its channels say; by choice at its offset and as far from there.
    np.testing.assert_allclose(our_positions(clip)[0, 0], [1, 2, 3])
    np.testing.assert_allclose(our_positions(read_bvh(PLAIN, positions="add"))[0, 0], [2, 4, 6])
    assert clip.warnings == ()


def test_files_in_the_wild() -> None:
    wild = PLAIN.replace("\n", "\r\n").replace("\t", "   \t ").replace("Xposition", "XPOSITION")
    wild = (
        wild.replace("Zrotation", "ZROTATION")
        .replace("1 2 3 10", "1e0 2.0E+00  3 \t1.0e1")
        .replace("ROOT", "root")
    )
    wild = (
        wild.replace("MOTION", "\r\n\r\nMotion")
        .replace("Frames: 2", "frames : 2")
        .replace("End Site", "END SITE")
    )
    wild = (
        "\ufeff"
        + wild.replace("JOINT Chest\r\n", "Joint Chest {\r\n").replace("{\r\n   \t    \t {", "{")
        + "\r\n\r\n"
    )
    wild = wild.replace("Joint Chest {\r\n   \t {\r\n", "Joint Chest {\r\n")
    clip, plain = read_bvh(wild.encode()), read_bvh(PLAIN)
    assert clip.names == plain.names
    assert clip.channels == plain.channels
    np.testing.assert_array_equal(clip.values, plain.values)
    # A position channel on another joint moves that joint.
    moved = PLAIN.replace("CHANNELS 1 Xrotation", "CHANNELS 2 Yposition Xrotation").replace(
        "60 70", "60 2 70"
    )
    moved = moved.replace("-60 -70", "-60 2 -70")
    clip = read_bvh(moved)
    np.testing.assert_allclose(our_positions(clip), world_positions(clip), atol=1e-12)
    assert np.linalg.norm(our_positions(clip)[0, 2] - our_positions(clip)[0, 0]) == pytest.approx(2.0)
    added = our_positions(read_bvh(moved, positions="add"))
    assert np.linalg.norm(added[0, 2] - added[0, 0]) == pytest.approx(7.25)


def test_what_is_written_reads_back_to_the_digits() -> None:
    clip = read_bvh(PLAIN)
    text = write_bvh(clip)
    again = read_bvh(text)
    assert again.names == clip.names
    assert again.end_sites == clip.end_sites
    np.testing.assert_array_equal(again.values, clip.values)
    # The root's place is its channels', however a reader takes its OFFSET.
    np.testing.assert_array_equal(again.offsets, [[0, 0, 0], [0, -18.5, 0.5], [0, 5.25, 0]])
    assert write_bvh(again) == text
    np.testing.assert_array_equal(read_bvh(text, positions="add").values, clip.values)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("HIERARCHY", "HIERACHY"), "line 1: a BVH file begins with HIERARCHY"),
        (("OFFSET 1.0 2.0 3.0", "OFFSET 1.0 2.0"), "line 4: here belongs OFFSET with three numbers"),
        (("OFFSET 1.0 2.0", "OFFSET 1.0 two"), "line 4: 'two' is no number"),
        (("Yrotation\n", "Wrotation\n"), "line 5: channel 'Wrotation' is none of Xposition"),
        (("CHANNELS 3 Y", "CHANNELS 4 Y"), "line 9: CHANNELS gives their number"),
        (("CHANNELS 3 Yrotation Z", "CHANNELS 3 Zrotation Z"), "line 9: a joint has the same channel twice"),
        (("JOINT Chest", "JOINTS Chest"), "line 15: 'JOINTS' is not OFFSET, CHANNELS, JOINT, End Site or"),
        (("JOINT Chest\n", "JOINT\n"), "line 15: a joint needs a name"),
        (("CHANNELS 3 Y", "CHANNELS 2 Y"), "line 9: CHANNELS gives their number and then their names, not 2"),
        (("5.25 0.0", "5.25 0.0\nOFFSET 1 1 1"), "line 18: 'Chest' has a second OFFSET"),
        (("CHANNELS 1 X", "CHANNELS 0 CHANNELS 1 X"), "line 18: 'Chest' has CHANNELS twice"),
        (("\t}\n}\nMOTION", "\t}\nMOTION"), "line 24: 'MOTION' is not OFFSET"),
        (("MOTION", "ROOT Other"), "line 25: there is a second ROOT"),
        (("Frames: 2", "Frames: many"), "line 26: 'many' is no number"),
        (("Frames: 2", "Frames: 2.5"), "line 26: the number of frames is a whole number, not 2.5"),
        (("Frames: 2", "Frames: -2"), "line 26: the number of frames is a whole number, not -2"),
        (("Time: 0.033333", "Time: 0"), "line 27: the frame time is positive"),
        (("Time: 0.033333", "Time: 1e11"), "line 27: the frame time lies between 1e-05 and 3600 seconds"),
        (("Time: 0.033333", "Time: 1e-320"), "line 27: the frame time lies between 1e-05 and 3600 seconds"),
        (("60 70", "60"), "line 28: a frame has 10 values, this line 9"),
        (("60 70", "60 70 80"), "line 28: a frame has 10 values, this line 11"),
        (("-50", "x50"), "line 29: 'x50' is no number"),
    ],
)
def test_faults_are_named_with_their_line(change: tuple[str, str], message: str) -> None:
    broken = PLAIN.replace(*change, 1)
    assert broken != PLAIN
    with pytest.raises(BvhError) as caught:
        read_bvh(broken)
    assert message in str(caught.value)


def test_a_file_that_ends_in_the_middle() -> None:
    with pytest.raises(BvhError, match="ends here, in the middle"):
        read_bvh(PLAIN[: PLAIN.index("JOINT Chest")])
    with pytest.raises(BvhError):
        read_bvh(b"")
    with pytest.raises(BvhError):
        read_bvh(bytes(range(256)))


def random_motion(frames: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(11)
    turns = r.exp(rng.normal(scale=0.3, size=(frames, len(RIG.skeleton), 3)))
    return r.multiply(RIG.skeleton.rest_rotations, turns), rng.normal(size=(frames, 3))


def test_an_exported_clip_stands_where_the_skeleton_stands() -> None:
    rotations, roots = random_motion(5)
    clip = read_bvh(write_bvh(clip_of_motion(RIG.skeleton, rotations, roots, 1 / 60), decimals=9))
    wanted, _ = forward_kinematics(RIG.skeleton, rotations, roots)
    found = dict(zip(clip.names, np.moveaxis(world_positions(clip), 1, 0), strict=True))
    for joint, name in enumerate(RIG.skeleton.names):
        np.testing.assert_allclose(found[name], wanted[:, joint], atol=1e-6)


def test_retargeting_to_the_same_skeleton_gives_the_motion_back() -> None:
    rotations, roots = random_motion(5)
    roots = 0.02 * roots + RIG.skeleton.rest_translations[0]
    clip = clip_of_motion(RIG.skeleton, rotations, roots, 1 / 60)
    names = {name: name for name in RIG.skeleton.names}
    found, root = retarget(clip, RIG.skeleton, names)
    assert r.angle_between(found, rotations).max() < 1e-9
    np.testing.assert_allclose(root, roots, atol=1e-9)
    # Twice the size in the file's own unit, and hips that move from where they rest, are the same motion.
    larger = replace(clip, offsets=clip.offsets * 200.0, values=clip.values.copy())
    larger.values[:, :3] = (roots - RIG.skeleton.rest_translations[0]) * 200.0
    _, again = retarget(larger, RIG.skeleton, names)
    feet, _ = forward_kinematics(RIG.skeleton, RIG.skeleton.rest_rotations)
    moved = roots - RIG.skeleton.rest_translations[0]
    moved[:, 1] += RIG.skeleton.rest_translations[0, 1] - feet[:, 1].min()
    np.testing.assert_allclose(again, moved, atol=1e-9)


def test_retargeting_by_name_turns_the_partners_and_scales_the_way() -> None:
    clip = read_bvh(PLAIN.replace("Left Knee", "LeftUpLeg"))
    local, root = retarget(clip, RIG.skeleton)
    _, world = forward_kinematics(RIG.skeleton, local)
    _, rest = forward_kinematics(RIG.skeleton, RIG.skeleton.rest_rotations)
    turned = r.multiply(world, r.conjugate(rest))
    chest = RIG.skeleton.index("chest")
    expected = r.multiply(clip.motion()[0][:, 0], clip.motion()[0][:, 2])
    assert r.angle_between(turned[:, chest], expected).max() < 1e-9
    # What has no partner goes with its parent.
    head = RIG.skeleton.index("head")
    assert r.angle_between(turned[:, head], turned[:, chest]).max() < 1e-9
    height = 18.5 + 3.1
    scale = RIG.skeleton.rest_translations[0, 1] / height
    np.testing.assert_allclose(root[1] - root[0], np.array([-2, -4, -6]) * scale, rtol=1e-9)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("mixamorig:LeftForeArm", "leftLowerArm"),
        ("LeftForeArm", "leftLowerArm"),
        ("left_forearm", "leftLowerArm"),
        ("lForeArm", "leftLowerArm"),
        ("forearm.L", "leftLowerArm"),
        ("RightUpLeg", "rightUpperLeg"),
        ("RightKnee", "rightLowerLeg"),
        ("Hips", "hips"),
        ("Spine1", "chest"),
        ("Tail", None),
    ],
)
def test_names_of_motion_files(name: str, expected: str | None) -> None:
    assert humanoid_name(name) == expected


def test_a_looped_clip_ends_where_it_begins() -> None:
    smooth = r.exp(np.linspace(0, 1, 100)[:, None, None] * np.array([[0.5, 0.2, 0.0], [0.0, 0.0, 1.0]]))
    loop = looped(smooth, 40)
    assert r.angle_between(loop[-1], loop[0]).max() < 1e-12
    np.testing.assert_array_equal(loop[:59], smooth[:59])
    steps = r.angle_between(loop[1:], loop[:-1])
    assert steps.max() < 0.06
    with pytest.raises(ValueError, match="100 frames cannot be blended over 101"):
        looped(smooth, 101)


def test_blending_goes_from_one_motion_to_the_other() -> None:
    rotations, _ = random_motion(8)
    other = rotations[::-1]
    assert r.angle_between(blended(rotations, other, 0.0), rotations).max() < 1e-12
    weight = np.linspace(0, 1, 8)
    result = blended(rotations, other, weight)
    assert r.angle_between(result[0], rotations[0]).max() < 1e-12
    assert r.angle_between(result[-1], other[-1]).max() < 1e-12
