"""BVH files as programs write them and as they come from broken downloads: read, and told with a warning."""

from __future__ import annotations

import tracemalloc
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest

from reina.lab import clip_points
from reina.skeleton import BvhError, MotionClip, PositionMeaning, read_bvh, retarget, write_bvh
from reina.skeleton.load_rig import load_rig

ROOT = Path(__file__).parents[3]
CASES = ROOT / "tests" / "cases"
HEAD = """HIERARCHY
ROOT Hips
{
	OFFSET 0 9 0
	CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
	JOINT Spine
	{
		OFFSET 0 10 0
		CHANNELS 3 Zrotation Xrotation Yrotation
		End Site
		{
			OFFSET 0 5 0
		}
	}
}
"""
ROWS = "1 90 2 10 20 30 5 6 7\n2 91 3 11 21 31 6 7 8\n3 92 4 12 22 32 7 8 9\n"
MOTION = "MOTION\nFrames: 3\nFrame Time: 0.0333333\n"
PLAIN = HEAD + MOTION + ROWS
VALUES = np.array([row.split() for row in ROWS.splitlines()], dtype=np.float64)


def case(name: str, **choice: PositionMeaning) -> MotionClip:
    return read_bvh((CASES / name).read_bytes(), **choice)


def kinds(clip: MotionClip) -> list[str]:
    return [warning.kind for warning in clip.warnings]


def refused(data: str | bytes) -> str:
    with pytest.raises(BvhError) as caught:
        read_bvh(data)
    assert len(str(caught.value)) < 400
    return str(caught.value)


def test_positions_replace_the_offset_and_are_added_by_choice() -> None:
    distances: dict[PositionMeaning, float] = {"replace": 10.0, "add": 20.0}
    for meaning, distance in distances.items():
        points = clip_points(case("bvh-positions.bvh", positions=meaning)).positions
        assert np.linalg.norm(points[:, 1] - points[:, 0], axis=-1) == pytest.approx([distance] * 3)
        np.testing.assert_allclose(points[:, 0], [[1, 90, 2], [2, 91, 3], [3, 92, 4]])


def test_an_axis_without_a_position_channel_keeps_its_offset() -> None:
    text = HEAD.replace("CHANNELS 6 Xposition Yposition Zposition", "CHANNELS 4 Zposition")
    text += "MOTION\nFrames: 1\nFrame Time: 0.1\n7 0 0 0 0 0 0\n"
    assert clip_points(read_bvh(text)).positions[0, 0].tolist() == [0, 9, 7]
    assert clip_points(read_bvh(text, positions="add")).positions[0, 0].tolist() == [0, 9, 7]


@pytest.mark.parametrize("meaning", ["replace", "add"])
@pytest.mark.parametrize("name", ["bvh-positions.bvh", "bvh-dupname.bvh", "bvh-endbrace.bvh", "root-offset"])
def test_what_is_written_is_the_same_motion_in_either_reading(name: str, meaning: PositionMeaning) -> None:
    clip = case(name, positions=meaning) if name.endswith("bvh") else read_bvh(PLAIN, positions=meaning)
    places = clip_points(clip).positions
    for written in (clip, clip.without_still_positions()):
        text = write_bvh(written)
        for reading in ("replace", "add"):
            again = clip_points(read_bvh(text, positions=reading)).positions
            np.testing.assert_allclose(again, places, atol=1e-5)


def test_positions_that_keep_still_become_the_offset() -> None:
    clip = case("bvh-positions.bvh").without_still_positions()
    assert clip.channels[1] == ("Zrotation", "Xrotation", "Yrotation")
    assert clip.offsets.tolist() == [[0, 0, 0], [0, 10, 0]]
    assert clip.values.shape == (3, 9)
    moving = read_bvh((CASES / "bvh-positions.bvh").read_text().replace("0 10 0 7", "0 11 0 7"))
    assert len(moving.without_still_positions().channels[1]) == 6


def test_retargeting_takes_the_length_of_legs_from_position_channels() -> None:
    skeleton = load_rig(ROOT / "rigs" / "trumpeter").skeleton
    text = HEAD.replace("Hips", "LeftUpLeg").replace("Spine", "LeftLeg")
    text = text.replace("CHANNELS 3", "CHANNELS 6 Xposition Yposition Zposition").replace("0 5 0", "0 -5 0")
    rows = "MOTION\nFrames: 2\nFrame Time: 1\n0 90 0 0 0 0 0 -10 0 0 0 0\n0 95 0 0 0 0 0 -10 0 0 0 0\n"
    offset, none = (
        read_bvh(text.replace("OFFSET 0 10 0", told) + rows) for told in ("OFFSET 0 -10 0", "OFFSET 0 0 0")
    )
    for one, other in zip(retarget(offset, skeleton), retarget(none, skeleton), strict=True):
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize(("announced", "frames"), [(2, 3), (5, 3), (0, 3), (10**9, 3)])
def test_frames_are_those_that_are_there(announced: int, frames: int) -> None:
    clip = read_bvh(PLAIN.replace("Frames: 3", f"Frames: {announced}"))
    np.testing.assert_array_equal(clip.values, VALUES)
    (warning,) = clip.warnings
    assert (warning.kind, warning.place) == ("frame_count", "line 17")
    assert warning.message == f"{announced} frames are announced, {frames} are there, which are read"


def test_the_cases_are_read() -> None:
    assert len(case("bvh-frames.bvh")) == 3
    clip = case("bvh-endbrace.bvh")
    assert (len(clip.names), len(clip), clip.end_sites) == (2, 3, ((), ((0.0, 5.0, 0.0),)))
    assert clip.warnings == ()


def test_an_incomplete_last_frame_is_left_out() -> None:
    clip = read_bvh(PLAIN.removesuffix(" 8 9\n"))
    np.testing.assert_array_equal(clip.values, VALUES[:2])
    assert [(one.kind, one.place) for one in clip.warnings] == [
        ("frame_count", "line 17"),
        ("incomplete_frame", "line 21"),
    ]
    assert clip.warnings[1].message == "the last frame has 7 of 9 values and is left out"


def test_frames_over_several_lines_or_several_on_one_need_no_announced_number() -> None:
    for rows in (ROWS.replace(" 20", "\n20"), ROWS.replace("7\n2", "7 2"), " ".join(ROWS.split())):
        clip = read_bvh(HEAD + MOTION.replace(": 3", ": 8") + rows)
        np.testing.assert_array_equal(clip.values, VALUES)
        assert kinds(clip) == ["frame_count"]
    # A line that is short within the file shifts all that follows, and is told.
    short = ROWS.replace("30 5 6 7", "30\n\n5 6")
    assert refused(HEAD + MOTION + short) == "line 19: a frame has 9 values, the lines from here 8"
    long = HEAD + MOTION.replace(": 3", ": 20000") + "1 2 3 4 5 6 7 8 9 " * 19_999 + "\n1 2 3\n4 5 6 7 8 9 10"
    assert refused(long) == "line 20: a frame has 9 values, this line 3"


def test_text_after_the_last_frame_is_left_out() -> None:
    clip = read_bvh(PLAIN + "\nEND of the file 1 2 3\nmore\n")
    np.testing.assert_array_equal(clip.values, VALUES)
    (warning,) = clip.warnings
    assert (warning.kind, warning.place) == ("trailing_text", "line 23")
    assert "'END of the file 1 2 3'" in warning.message
    assert kinds(read_bvh(PLAIN + "\0\0\0")) == ["trailing_text"]
    # Before as many frames as announced it is no end, but a fault.
    assert refused(PLAIN.replace("Frames: 3", "Frames: 4") + "END") == "line 22: 'END' is no number"


def test_joints_of_one_name_are_numbered() -> None:
    clip = case("bvh-dupname.bvh")
    assert clip.names == ("Hips", "Spine", "Nub", "Nub.001")
    assert len(clip) == 3
    (warning,) = clip.warnings
    assert (warning.kind, warning.place) == ("repeated_name", "line 19")
    assert warning.message == "2 joints are called 'Nub'; the later ones are now 'Nub.001'"


def test_a_number_that_a_joint_has_already_is_not_given_twice() -> None:
    names = ["Nub", "Nub", "Nub.001", "Nub", "Nub.001"]
    joints = "".join(f"JOINT {name} {{ OFFSET 0 1 0 }}\n" for name in names)
    clip = read_bvh(f"HIERARCHY ROOT Hips {{ {joints} }}")
    assert clip.names == ("Hips", "Nub", "Nub.002", "Nub.001", "Nub.003", "Nub.001.001")
    many = "".join(f"JOINT n{i // 2} {{ }}\n" for i in range(200))
    clip = read_bvh(f"HIERARCHY ROOT Hips {{ {many} }}")
    assert len(set(clip.names)) == 201
    assert kinds(clip).count("repeated_name") == 21
    assert "80 more names" in clip.warnings[20].message


@pytest.mark.parametrize(
    "text",
    [
        " ".join(HEAD.replace("Hips", "Hips {", 1).replace("\n{", "", 1).split()) + "\n" + MOTION + ROWS,
        HEAD.replace("\n\t\t{", " {").replace("}\n", "} ") + MOTION.replace("\n", " ") + ROWS,
        HEAD.replace("0 10 0", "0\n10\n\n0").replace("JOINT Spine", "JOINT\n\tSpine") + MOTION + ROWS,
        HEAD.replace("Zrotation Xrotation", "Zrotation\nXrotation") + MOTION.replace(": ", ":") + ROWS,
        HEAD + MOTION.replace(": 3", " :\n3") + ROWS.replace(" 20", "\n20").replace(" 21", "\n\n21"),
        HEAD + MOTION + " ".join(ROWS.split()),
        HEAD + MOTION + "\n".join(ROWS.split()),
        HEAD + MOTION.replace(": 3", ": 3.0") + ROWS.replace("\n", "\n\n") + "\n\n  \t\n",
        PLAIN.replace("\n", "\r"),
        PLAIN.replace("\n", " \t\r\n"),
        "\ufeff\n\n" + PLAIN.swapcase().replace("hIPS", "Hips").replace("sPINE", "Spine"),
    ],
)
def test_words_may_stand_on_any_line(text: str) -> None:
    clip, plain = read_bvh(text.encode()), read_bvh(PLAIN)
    assert (clip.names, clip.channels, clip.end_sites) == (plain.names, plain.channels, plain.end_sites)
    np.testing.assert_array_equal(clip.offsets, plain.offsets)
    np.testing.assert_array_equal(clip.values, VALUES)
    assert clip.warnings == ()


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-16-le", "utf-16-be"])
def test_files_in_other_encodings(encoding: str) -> None:
    clip = read_bvh(PLAIN.replace("Hips", "腰 ミク").encode(encoding))
    assert clip.names == ("腰 ミク", "Spine")
    np.testing.assert_array_equal(clip.values, VALUES)


def test_names_keep_their_spaces_and_colons() -> None:
    clip = read_bvh(PLAIN.replace("Hips", "mixamorig:Left Hip ").replace("Spine", "Spine 1"))
    assert refused(PLAIN.replace("Spine", "Spine}")).startswith("line 6: here belongs '{', not '}'")
    assert clip.names == ("mixamorig:Left Hip", "Spine 1")


@pytest.mark.parametrize(
    ("motion", "kept"),
    [
        ("MOTION\nFrames: 0\nFrame Time: 0.0333333\n", []),
        ("MOTION\nFrames: 0\nFrame Time: 0\n", []),
        ("MOTION\nFrames: 0\n", []),
        ("MOTION\n", ["no_motion"]),
        ("", ["no_motion"]),
        ("MOTION\nFrames: 5\nFrame Time: 0.1\n", ["frame_count"]),
        ("MOTION\nFrames: 1\nFrame Time: 0.1\n1 2 3\n", ["frame_count", "incomplete_frame"]),
    ],
)
def test_a_file_without_frames_is_a_skeleton(motion: str, kept: list[str]) -> None:
    clip = read_bvh(HEAD + motion)
    assert len(clip) == 0
    assert kinds(clip) == kept
    assert 0.0 < clip.frame_time_s < 1.0
    assert clip_points(clip).positions[0, :2].tolist() == [[0, 9, 0], [0, 19, 0]]
    again = read_bvh(write_bvh(clip.without_still_positions()))
    np.testing.assert_array_equal(again.offsets, clip.offsets)


def test_one_frame_needs_no_frame_time() -> None:
    clip = read_bvh(HEAD + "MOTION\nFrames: 1\nFrame Time: 0\n" + ROWS.splitlines()[0])
    assert (len(clip), clip.frame_time_s, kinds(clip)) == (1, 1 / 30, ["frame_time"])


@pytest.mark.parametrize(
    ("number", "told"),
    [
        ("²", "'²' is no number"),
        ("1_000", "'1_000' is no number"),
        ("nan", "'nan' is no number"),
        ("-inf", "'-inf' is no number"),
        ("infinity", "'infinity' is no number"),
        ("１２", "'１２' is no number"),
        ("0x10", "'0x10' is no number"),
        ("1e", "'1e' is no number"),
        ("1.2.3", "'1.2.3' is no number"),
        ("1-2", "'1-2' is no number"),
        ("1,5", "'1,5' is no number: BVH has a point before decimals, and spaces between numbers"),
        ("1e999", "1e999 is too large: numbers go up to 1e+12"),
        ("1e13", "1e13 is too large"),
        ("9" * 5000, "has 5000 characters; a number has at most 100"),
    ],
)
def test_what_is_no_number_of_a_motion(number: str, told: str) -> None:
    places = {
        4: HEAD.replace("0 9 0", f"0 {number} 0") + MOTION + ROWS,
        9: HEAD.replace("CHANNELS 3", f"CHANNELS {number}") + MOTION + ROWS,
        17: HEAD + MOTION.replace(": 3", f": {number}") + ROWS,
        18: HEAD + MOTION.replace("0.0333333", number) + ROWS,
        20: HEAD + MOTION + ROWS.replace("91", number),
    }
    for line, text in places.items():
        message = refused(text)
        assert message.startswith(f"line {line}: ")
        assert told in message


def test_numbers_as_programs_write_them() -> None:
    clip = read_bvh(
        HEAD
        + MOTION.replace("0.0333333", ".0333333").replace(": 3", ": 3.0")
        + ROWS.replace("1 90 2", "+1. 9.0e+01 200E-2")
    )
    np.testing.assert_array_equal(clip.values, VALUES)
    assert clip.frame_time_s == 0.0333333


def test_sums_stay_in_bounds() -> None:
    far = PLAIN.replace("OFFSET 0 9 0", "OFFSET 0 1e12 0").replace("1 90 2", "1 1e12 2")
    assert np.all(np.isfinite(clip_points(read_bvh(far)).positions.astype(np.float32)))
    with pytest.raises(BvhError, match="line 2: OFFSET and Yposition add up to more than 1e\\+12"):
        read_bvh(far, positions="add")


def chain(joints: int) -> str:
    inner = "".join(f"JOINT j{i}\n{{\nOFFSET 0 1 0\nCHANNELS 1 Xrotation\n" for i in range(1, joints))
    frame = " ".join(["0.5"] * joints)
    begin = f"HIERARCHY\nROOT j0\n{{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n{inner}"
    return f"{begin}{'}' * joints}\nMOTION\nFrames: 1\nFrame Time: 0.1\n{frame}\n"


def test_a_file_may_be_as_deep_as_it_has_joints() -> None:
    for clip in (case("bvh-deep.bvh"), read_bvh(chain(2000))):
        text = write_bvh(clip)
        assert len(text) < 1_000_000
        np.testing.assert_allclose(
            clip_points(read_bvh(text)).positions[:, : len(clip.names)],
            clip_points(clip).positions[:, : len(clip.names)],
            atol=1e-3,
        )
        retarget(clip, load_rig(ROOT / "rigs" / "trumpet").skeleton)
    assert refused(chain(2001)) == "line 8002: the file has more than 2000 joints"


NO_CHANNELS = "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n}\nMOTION\nFrames: {}\nFrame Time: 0.01\n"


@pytest.mark.parametrize(
    "text",
    [
        *(NO_CHANNELS.replace("{}", str(frames)) for frames in (20_000_000, 10**9, 10**12)),
        PLAIN.replace("Frames: 3", "Frames: 1000000000"),
        PLAIN.replace("Frames: 3", "Frames: 1e9").replace("CHANNELS 3", "CHANNELS 999999999"),
        HEAD + "MOTION Frames: 999999999999 Frame Time: 0.1",
        PLAIN.replace("CHANNELS 6", "CHANNELS 1e12"),
    ],
)
def test_what_is_only_announced_takes_no_memory(text: str) -> None:
    tracemalloc.start()
    try:
        with suppress(BvhError):
            clip = read_bvh(text)
            clip_points(clip)
            write_bvh(clip)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 1_000_000


def test_memory_is_a_few_times_the_files() -> None:
    rows = "1 " * 1_000_000
    many = "HIERARCHY ROOT a { CHANNELS 1 Xposition } MOTION Frames: 7 Frame Time: 0.01\n" + rows
    tracemalloc.start()
    clip = read_bvh(many)
    points = clip_points(clip, most_points=10_000)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert len(clip) == 1_000_000
    assert len(points.positions) == 10_000
    assert peak < 30 * len(many)


def test_frames_of_many_joints_are_bounded() -> None:
    joints = "JOINT a { } " * 1999
    text = f"HIERARCHY ROOT a {{ CHANNELS 1 Xposition {joints} }} MOTION Frames: 5001 Frame Time: 1\n"
    assert refused(text + "1 " * 5001) == "line 1: 5001 frames of 2000 joints are more than Reina reads"
    sites = "End Site { OFFSET 0 0 0 } " * 2001
    assert refused(f"HIERARCHY ROOT a {{ {sites} }}") == "line 1: the file has more than 2000 end sites"
    assert "a name of 1001 letters" in refused(f"HIERARCHY ROOT {'a' * 1001} {{ }}")


@pytest.mark.parametrize("letter", ["x", "\0", "\x80", "\U000e0001", "\\", "'"])
def test_an_error_quotes_little_of_a_long_name_and_a_long_word(letter: str) -> None:
    name, word = f"a{250 * letter}", f"b{100_000 * letter}"
    said = refused(f"HIERARCHY ROOT {name}\n{{ OFFSET 0 0 0\n{word} }}")
    assert "is not OFFSET, CHANNELS, JOINT, End Site or a closing brace" in said
    assert len(said) < 400
