"""What is made of motion files. Long ones are read in a process of its own.

Nothing here imports the web framework, which that process would have to load.
"""

from __future__ import annotations

import base64
from dataclasses import asdict
from typing import TYPE_CHECKING

from reina.lab import clip_points
from reina.protocol.lab import ParsedClip
from reina.skeleton import human_pose, read_bvh

if TYPE_CHECKING:
    from reina.skeleton import HumanPose, MotionClip, PositionMeaning


def parsed_text(data: bytes, positions: PositionMeaning) -> bytes:
    """What a BVH file holds, as JSON.

    Raises:
        BvhError: It cannot be read.
    """
    return _parsed(read_bvh(data, positions=positions)).model_dump_json().encode()


def plain_clip(data: bytes, positions: PositionMeaning) -> MotionClip:
    """The clip of a BVH file without what other programs stumble over.

    Raises:
        BvhError: It cannot be read.
    """
    return read_bvh(data, positions=positions).without_still_positions()


def pose_in_clip(data: bytes, positions: PositionMeaning, time_s: float) -> HumanPose:
    """How a humanoid stands at a time of a BVH file.

    Raises:
        BvhError: The file cannot be read.
        PoseError: It shows no humanoid, or not then.
    """
    return human_pose(read_bvh(data, positions=positions), time_s)


def _parsed(clip: MotionClip) -> ParsedClip:
    points = clip_points(clip)
    positions = points.positions.astype("<f4")
    return ParsedClip.model_validate(
        {
            "joints": [
                {
                    "name": name,
                    "parent": None if parent < 0 else parent,
                    "offset": offset,
                    "channels": channels,
                }
                for name, parent, offset, channels in zip(
                    clip.names,
                    clip.parents.tolist(),
                    clip.offsets.tolist(),
                    map(list, clip.channels),
                    strict=True,
                )
            ],
            "frames": len(clip),
            "frame_time_s": clip.frame_time_s,
            "duration_s": len(clip) * clip.frame_time_s,
            "warnings": [asdict(warning) for warning in clip.warnings],
            "points": list(points.names),
            "point_parents": points.parents.tolist(),
            "frame_step": points.frame_step,
            "sampled_frames": len(positions),
            "minimum": positions.min(axis=(0, 1)).tolist(),
            "maximum": positions.max(axis=(0, 1)).tolist(),
            "positions": base64.b64encode(positions.tobytes()).decode("ascii"),
        }
    )
