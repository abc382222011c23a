from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from reina.lab import clip_points
from reina.skeleton import Skeleton, forward_kinematics, read_bvh

CLIPS = Path(__file__).parents[3] / "rigs" / "trumpeter" / "clips"
ARM = """HIERARCHY
ROOT shoulder
{
  OFFSET 1 2 3
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT elbow
  {
    OFFSET 10 0 0
    CHANNELS 4 Xposition Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 5 0 0
    }
  }
}
MOTION
Frames: 3
Frame Time: 0.5
1 2 3 0 0 0 10 0 0 0
2 2 3 90 0 0 10 0 0 0
1 2 3 0 0 0 12 90 0 0
"""


def test_points_are_where_the_file_puts_them() -> None:
    points = clip_points(read_bvh(ARM))
    assert points.names == ("shoulder", "elbow", "elbow end")
    assert points.parents.tolist() == [-1, 0, 1]
    assert points.joints.tolist() == [0, 1, 1]
    assert points.frame_step == 1
    expected = [
        [[1, 2, 3], [11, 2, 3], [16, 2, 3]],
        [[2, 2, 3], [2, 12, 3], [2, 17, 3]],
        [[1, 2, 3], [13, 2, 3], [13, 7, 3]],
    ]
    np.testing.assert_allclose(points.positions, expected, atol=1e-12)


def test_long_clips_are_thinned_evenly_down_to_one_frame() -> None:
    clip = read_bvh(ARM)
    whole = clip_points(clip)
    half = clip_points(clip, most_points=6)
    assert half.frame_step == 2
    np.testing.assert_array_equal(half.positions, whole.positions[::2])
    assert len(clip_points(clip, most_points=1).positions) == 1


def test_a_clip_without_frames_is_one_at_rest() -> None:
    clip = read_bvh(ARM.partition("Frames")[0] + "Frames: 0\nFrame Time: 0.5\n")
    assert len(clip) == 0
    points = clip_points(clip)
    np.testing.assert_array_equal(points.positions, [[[1, 2, 3], [11, 2, 3], [16, 2, 3]]])


@pytest.mark.parametrize("path", sorted(CLIPS.glob("*.bvh")), ids=lambda path: path.stem)
def test_shipped_clips_agree_with_forward_kinematics_of_a_skeleton(path: Path) -> None:
    clip = read_bvh(path.read_bytes())
    rotations, translations = clip.motion()
    skeleton = Skeleton(
        clip.names, clip.parents.copy(), clip.offsets.copy(), np.tile([0.0, 0, 0, 1], (len(clip.names), 1))
    )
    positions, _ = forward_kinematics(skeleton, rotations, translations[:, 0])
    np.testing.assert_allclose(clip_points(clip).positions[:, : len(clip.names)], positions, atol=1e-9)
