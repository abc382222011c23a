"""BVH files of a session, read back."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.integration.scores import scale

from reina.errors import InputError
from reina.music import read_score
from reina.rotations import multiply, rotate
from reina.sessions.frames import EncodedFrames
from reina.sessions.motion_export import BvhExport
from reina.sessions.production import Production
from reina.sessions.stage import Stage
from reina.skeleton import MotionClip, forward_kinematics, read_bvh

RIGS = Path(__file__).parents[3] / "rigs"


@pytest.fixture(scope="module")
def production() -> Production:
    return Production.plan(Stage.load(RIGS), read_score(scale(8)))


def exported(production: Production, skeleton: str, first: int, end: int) -> str:
    export = BvhExport(production, skeleton, first, end)
    return "".join(export.text(block) for block in export.blocks)


def world_positions(clip: MotionClip) -> np.ndarray:
    """(F, J, 3), parents before children."""
    rotations, translations = clip.motion()
    positions, world = translations.copy(), rotations.copy()
    for joint, parent in enumerate(clip.parents.tolist()):
        if parent >= 0:
            positions[:, joint] = positions[:, parent] + rotate(world[:, parent], translations[:, joint])
            world[:, joint] = multiply(world[:, parent], rotations[:, joint])
    return positions


@pytest.mark.parametrize("skeleton", ["player", "trumpet"])
@pytest.mark.parametrize("fps", [60, 24])
@pytest.mark.parametrize(("first", "end"), [(0, 150), (45, 75), (61, 62)])
def test_joints_are_where_the_frames_have_them(
    production: Production, skeleton: str, fps: int, first: int, end: int
) -> None:
    at_rate = production.at_rate(fps)
    clip = read_bvh(exported(at_rate, skeleton, first, end))
    assert len(clip) == end - first
    assert clip.frame_time_s == pytest.approx(1 / fps, abs=1e-8)
    frames = EncodedFrames(at_rate.performance, at_rate.manifest).span(first, end - 1)
    names = [layout.name for layout in at_rate.manifest.skeletons]
    index = names.index(skeleton)
    start = sum(len(layout.joints) for layout in at_rate.manifest.skeletons[:index])
    rig = production.stage.rigs[("trumpeter", "trumpet")[index]]
    joints = len(rig.skeleton.names)
    expected, _ = forward_kinematics(
        rig.skeleton, frames["rotations"][:, start : start + joints], frames["root_positions"][:, index]
    )
    found = world_positions(clip)
    order = [clip.names.index(name) for name in rig.skeleton.names]
    assert np.abs(found[:, order] - expected).max() < 1e-5


def test_angles_go_on_from_block_to_block(production: Production) -> None:
    clip = read_bvh(exported(production, "player", 0, 240))
    turns = np.abs(np.diff(clip.values[:, 3:], axis=0))
    assert turns.max() < 180.0


def test_a_span_without_frames_is_a_file_without_frames(production: Production) -> None:
    assert exported(production, "player", 30, 30).endswith("Frames: 0\nFrame Time: 0.01666667\n")


def test_a_skeleton_that_is_not_there_is_told(production: Production) -> None:
    with pytest.raises(InputError, match="player, trumpet, not 'drums'"):
        BvhExport(production, "drums", 0, 1)
