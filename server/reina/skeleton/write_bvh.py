"""BVH files written."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from reina.skeleton.motion_clip import MotionClip


def write_bvh(clip: MotionClip, *, decimals: int = 6) -> str:
    """A clip as the text of a BVH file, one line a frame, numbers with so many decimals."""
    children: dict[int, list[int]] = {}
    for joint, parent in enumerate(clip.parents.tolist()):
        children.setdefault(parent, []).append(joint)
    lines = ["HIERARCHY"]

    def numbers(values: tuple[float, ...] | list[float]) -> str:
        return " ".join(f"{value:.{decimals}f}" for value in values)

    def joint_lines(joint: int, depth: int) -> None:
        pad = "\t" * depth
        lines.append(f"{pad}{'JOINT' if depth else 'ROOT'} {clip.names[joint]}")
        lines.append(f"{pad}{{")
        lines.append(f"{pad}\tOFFSET {numbers(clip.offsets[joint].tolist())}")
        lines.append(f"{pad}\tCHANNELS {' '.join([str(len(clip.channels[joint])), *clip.channels[joint]])}")
        for child in children.get(joint, []):
            joint_lines(child, depth + 1)
        # A joint without children or sites would be no bone to most readers.
        for site in clip.end_sites[joint] or (() if children.get(joint) else ((0.0, 0.0, 0.0),)):
            lines.extend([f"{pad}\tEnd Site", f"{pad}\t{{", f"{pad}\t\tOFFSET {numbers(site)}", f"{pad}\t}}"])
        lines.append(f"{pad}}}")

    joint_lines(0, 0)
    order = _depth_first(children)
    lines += ["MOTION", f"Frames: {len(clip)}", f"Frame Time: {clip.frame_time_s:.8f}"]
    begins = np.cumsum([0, *(len(one) for one in clip.channels)]).tolist()
    columns = [column for joint in order for column in range(begins[joint], begins[joint + 1])]
    values = clip.values[:, columns]
    lines += [numbers(row) for row in values.tolist()]
    return "\n".join(lines) + "\n"


def _depth_first(children: dict[int, list[int]]) -> list[int]:
    order: list[int] = []
    stack = [0]
    while stack:
        joint = stack.pop()
        order.append(joint)
        stack.extend(reversed(children.get(joint, [])))
    return order
