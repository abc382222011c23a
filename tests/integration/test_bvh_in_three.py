"""What Reina writes as BVH stands in three.js where Reina has it: three's own loader, mixer and bones."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
from tests.integration.stranger import take

from reina import rotations as r
from reina.lab import clip_points
from reina.skeleton import PositionMeaning, read_bvh, write_bvh

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from tests.integration.server import Owned

SCRIPT = Path(__file__).with_name("bvh_in_three.mjs")
CASES = Path(__file__).parents[1] / "cases"
CLIPS = sorted((Path(__file__).parents[2] / "rigs").glob("*/clips/*.bvh"))
THREE_M = 1e-5
"""What three.js's 32-bit keyframes leave of a position."""


def in_three(text: str) -> tuple[NDArray[np.float64], dict[str, NDArray[np.float64]]]:
    """Times ``(F,)`` and bones' world positions ``(F, 3)``."""
    done = subprocess.run(
        ["node", str(SCRIPT)], input=text, capture_output=True, text=True, check=True, timeout=60
    )
    said = json.loads(done.stdout)
    return np.array(said["times"]), {name: np.array(places) for name, places in said["bones"].items()}


@pytest.mark.parametrize("path", CLIPS, ids=lambda path: path.stem)
def test_shipped_clips_stand_there_as_here(path: Path) -> None:
    clip = read_bvh(path.read_bytes())
    times, bones = in_three(path.read_text(encoding="utf-8"))
    assert set(bones) == set(clip.names)
    np.testing.assert_allclose(times, np.arange(len(clip)) * clip.frame_time_s, atol=1e-5)
    local, links = clip.motion()
    world, places = np.empty(local.shape), np.empty(links.shape)
    for joint, parent in enumerate(clip.parents.tolist()):
        above = world[:, parent] if joint else np.array([0.0, 0.0, 0.0, 1.0])
        begin = places[:, parent] if joint else np.zeros(3)
        world[:, joint] = r.multiply(above, local[:, joint])
        places[:, joint] = begin + r.rotate(above, links[:, joint])
    for joint, name in enumerate(clip.names):
        np.testing.assert_allclose(bones[name], places[:, joint], atol=THREE_M, err_msg=name)


@pytest.mark.parametrize("meaning", ["replace", "add"])
def test_positions_of_any_joint_stand_there_as_here(meaning: PositionMeaning) -> None:
    text = (CASES / "bvh-positions.bvh").read_text().replace("OFFSET 0.0 0.0 0.0", "OFFSET 3 4 5")
    clip = read_bvh(text, positions=meaning)
    places = clip_points(clip).positions
    for written in (write_bvh(clip), write_bvh(clip.without_still_positions())):
        _, bones = in_three(written)
        for joint, name in enumerate(clip.names):
            np.testing.assert_allclose(bones[name], places[:, joint], atol=1e-4, err_msg=name)
    # As it is, three.js adds the two.
    _, bones = in_three(text)
    added = clip_points(read_bvh(text, positions="add")).positions
    np.testing.assert_allclose(bones["Spine"], added[:, 1], atol=1e-4)


def test_an_exported_performance_stands_there_as_its_frames_do(owned: Owned) -> None:
    text = owned.client.get(f"{owned.path}/export.bvh", params={"start_s": 0.5, "end_s": 2.5})
    times, bones = in_three(text.raise_for_status().text)
    frames = take(owned.client, owned.id, 0.5, 2.5)
    assert len(times) == len(frames.song_time_s) == 120
    player = frames.skeleton("trumpeter")
    assert set(bones) == set(player.positions)
    for name, places in player.positions.items():
        np.testing.assert_allclose(bones[name], places, atol=2 * THREE_M, err_msg=name)
