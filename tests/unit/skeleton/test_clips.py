"""The clips that ship with the player: loops on planted feet, made anew byte for byte by their script."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from reina import rotations as r
from reina.skeleton import MotionClip, RigError, load_rig, read_bvh, retarget, write_bvh

ROOT = Path(__file__).parents[3]
CLIPS = sorted((ROOT / "rigs" / "trumpeter" / "clips").glob("*.bvh"))


def places(clip: MotionClip) -> dict[str, np.ndarray]:
    """Every joint and its end sites in the world, ``(F, 3)`` each, as any BVH reader has them."""
    local, translations = clip.motion()
    world, position = np.empty(local.shape), np.empty(translations.shape)
    found: dict[str, np.ndarray] = {}
    for joint, parent in enumerate(clip.parents.tolist()):
        if joint:
            world[:, joint] = r.multiply(world[:, parent], local[:, joint])
            position[:, joint] = position[:, parent] + r.rotate(world[:, parent], translations[:, joint])
        else:
            world[:, 0], position[:, 0] = local[:, 0], translations[:, 0]
        found[clip.names[joint]] = position[:, joint]
        for number, site in enumerate(clip.end_sites[joint]):
            found[f"{clip.names[joint]} end {number}"] = position[:, joint] + r.rotate(world[:, joint], site)
    return found


@pytest.fixture(params=CLIPS, ids=lambda path: path.stem)
def clip(request: pytest.FixtureRequest) -> MotionClip:
    return read_bvh(request.param.read_bytes())


def test_three_ship() -> None:
    assert [path.stem for path in CLIPS] == ["breathing", "shifting", "swaying"]


def test_it_ends_where_it_begins_and_goes_on_at_the_same_speed(clip: MotionClip) -> None:
    np.testing.assert_array_equal(clip.values[-1], clip.values[0])
    speed = np.diff(np.concatenate([clip.values[:-1], clip.values[:2]]), axis=0) / clip.frame_time_s
    change = np.abs(np.diff(speed, axis=0))
    assert change[-1].max() <= change.max()
    assert np.abs(speed).max() < 25.0  # degrees a second: a stance, no dance


def test_feet_stay_and_the_body_moves(clip: MotionClip) -> None:
    found = places(clip)
    for name in ("leftFoot", "rightFoot", "leftToes", "rightToes"):
        assert np.abs(found[name] - found[name][0]).max() < 5e-5
        assert 0.0 < found[name][0, 1] < 0.12
    assert np.ptp(found["head"], axis=0).max() > 0.002
    assert found["head"][:, 1].min() > 1.3
    # The arms hang beside the body and not in it.
    for side, outwards in (("left", 1.0), ("right", -1.0)):
        hand = found[f"{side}Hand"]
        assert (outwards * hand[:, 0]).min() > 0.2
        assert hand[:, 1].max() < found["chest"][:, 1].min()


def test_it_is_a_motion_of_the_rig_within_its_limits(clip: MotionClip) -> None:
    rig = load_rig(ROOT / "rigs" / "trumpeter")
    rotations, roots = retarget(clip, rig.skeleton, {name: name for name in clip.names})
    np.testing.assert_allclose(roots, clip.values[:, :3], atol=2e-5)
    for joint, limits in rig.limits.items():
        turned = r.multiply(r.conjugate(rig.skeleton.rest_rotations[joint]), rotations[:, joint])
        angles = r.to_euler(turned, limits.order)
        for angle, letter in zip(angles.T, limits.order, strict=True):
            axis = "xyz".index(letter)
            assert angle.min() > limits.minimum[axis] - 1e-4, (rig.skeleton.names[joint], letter)
            assert angle.max() < limits.maximum[axis] + 1e-4, (rig.skeleton.names[joint], letter)


def test_written_again_it_is_the_same_file() -> None:
    for path in sorted((ROOT / "rigs").glob("*/clips/*.bvh")):
        text = path.read_text(encoding="utf-8")
        clip = read_bvh(text)
        assert clip.warnings == ()
        assert write_bvh(clip.without_still_positions(), decimals=5) == text
        np.testing.assert_array_equal(read_bvh(text, positions="add").values, clip.values)


def test_the_script_makes_them_anew(tmp_path: Path) -> None:
    folder = tmp_path / "trumpeter"
    folder.mkdir()
    (folder / "rig.json").write_bytes((ROOT / "rigs" / "trumpeter" / "rig.json").read_bytes())
    script = ROOT / "rigs" / "build" / "clips.py"
    subprocess.run([sys.executable, str(script), "--rigs", str(tmp_path)], check=True, capture_output=True)
    for path in CLIPS:
        made, shipped = read_bvh((folder / "clips" / path.name).read_bytes()), read_bvh(path.read_bytes())
        assert made.names == shipped.names
        np.testing.assert_allclose(made.values, shipped.values, atol=2e-5)


def test_a_broken_clip_is_named(tmp_path: Path) -> None:
    (tmp_path / "clips").mkdir()
    (tmp_path / "clips" / "bad.bvh").write_text("HIERARCHY\nROOT hips\n{\nOFFSET 0 0\n")
    (tmp_path / "rig.json").write_bytes((ROOT / "rigs" / "trumpet" / "rig.json").read_bytes())
    with pytest.raises(RigError, match=r"clips/bad\.bvh: this clip is no motion: line 4"):
        load_rig(tmp_path)
