"""BVH files written."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.skeleton.motion_clip import POSITIONS

if TYPE_CHECKING:
    from collections.abc import Iterable

    from reina.skeleton.motion_clip import MotionClip

DECIMALS = 6
_DEEPEST_INDENT = 32
"""A chain of a thousand joints would be mostly tabs."""


def write_bvh(clip: MotionClip, *, decimals: int = DECIMALS) -> str:
    """A clip as the text of a BVH file, one line a frame, numbers with so many decimals."""
    return bvh_head(clip, len(clip), decimals=decimals) + bvh_rows(clip, decimals=decimals)


def bvh_head(clip: MotionClip, frames: int, *, decimals: int = DECIMALS) -> str:
    """What stands before a clip's values, as the head of a file of so many frames.

    Where a joint has position channels its OFFSET is 0, so that readers that add the two and readers that
    take the channels alone have it at the same place.
    """
    children = _children(clip)
    lines = ["HIERARCHY"]
    open_joints: list[int] = []
    for joint in _depth_first(children):
        while open_joints and open_joints[-1] != clip.parents[joint]:
            open_joints.pop()
            lines.append(f"{_indent(len(open_joints))}}}")
        pad = _indent(len(open_joints))
        lines.append(f"{pad}{'JOINT' if open_joints else 'ROOT'} {clip.names[joint]}")
        open_joints.append(joint)
        own = clip.channels[joint]
        moved = [axis in own and frames > 0 for axis in POSITIONS]
        offset = np.where(moved, 0.0, clip.offsets[joint]).tolist()
        lines.append(f"{pad}{{")
        lines.append(f"{pad}\tOFFSET {_numbers(offset, decimals)}")
        lines.append(f"{pad}\tCHANNELS {' '.join([str(len(own)), *own])}")
        # A joint without children or sites would be no bone to most readers.
        for site in clip.end_sites[joint] or (() if children.get(joint) else ((0.0, 0.0, 0.0),)):
            lines += [f"{pad}\tEnd Site", f"{pad}\t{{"]
            lines += [f"{pad}\t\tOFFSET {_numbers(site, decimals)}", f"{pad}\t}}"]
    lines += [f"{_indent(depth)}}}" for depth in reversed(range(len(open_joints)))]
    lines += ["MOTION", f"Frames: {frames}", f"Frame Time: {clip.frame_time_s:.8f}"]
    return "\n".join(lines) + "\n"


def bvh_rows(clip: MotionClip, *, decimals: int = DECIMALS) -> str:
    """The lines of a clip's frames, as they stand behind its head."""
    begins = np.cumsum([0, *(len(one) for one in clip.channels)]).tolist()
    order = _depth_first(_children(clip))
    columns = [column for joint in order for column in range(begins[joint], begins[joint + 1])]
    return "".join(f"{_numbers(row, decimals)}\n" for row in clip.values[:, columns].tolist())


def _numbers(values: Iterable[float], decimals: int) -> str:
    return " ".join(f"{value:.{decimals}f}" for value in values)


def _indent(depth: int) -> str:
    return "\t" * min(depth, _DEEPEST_INDENT)


def _children(clip: MotionClip) -> dict[int, list[int]]:
    children: dict[int, list[int]] = {}
    for joint, parent in enumerate(clip.parents.tolist()):
        children.setdefault(parent, []).append(joint)
    return children


def _depth_first(children: dict[int, list[int]]) -> list[int]:
    order: list[int] = []
    stack = [0]
    while stack:
        joint = stack.pop()
        order.append(joint)
        stack.extend(reversed(children.get(joint, [])))
    return order
