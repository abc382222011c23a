"""BVH files read: any channels in any order, and the oddities of files in the wild.

Keywords in any case, words and braces on any lines, names with spaces, position channels on any joint,
frames broken over lines. A fault is named with its line; what is odd but clear is read, with a warning.
Nothing is allocated by what a file announces: only what is there counts.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from reina.skeleton.bvh_frames import read_frames
from reina.skeleton.bvh_hierarchy import HierarchyJoint, read_hierarchy
from reina.skeleton.bvh_tokens import LARGEST, Tokens, decoded, shown
from reina.skeleton.clip_warning import ClipWarning
from reina.skeleton.joint_names import told_apart
from reina.skeleton.motion_clip import POSITIONS, MotionClip

if TYPE_CHECKING:
    from reina.rotations.arrays import FloatArray

MAX_POSES = 10_000_000
"""Joints times frames."""
USUAL_FRAME_TIME_S = 1.0 / 30.0
SHORTEST_FRAME_TIME_S = 1e-5
LONGEST_FRAME_TIME_S = 3600.0
MAX_WARNINGS = 20
"""Of one kind."""
_MAX_LISTED = 5

PositionMeaning = Literal["replace", "add"]


def read_bvh(data: bytes | str, *, positions: PositionMeaning = "replace") -> MotionClip:
    """The clip in a BVH file.

    Args:
        data: The file, as it is or decoded.
        positions: What a joint's position channels mean: ``replace``, its place in its parent's frame, as
            Blender and Assimp read them and most programs write them; ``add``, how far it is from its
            OFFSET, as the format's first description and three.js have it.

    Returns:
        The clip, in which positions always replace the OFFSET; without frames where the file has none.

    Raises:
        BvhError: The file is none or is broken; ``where`` names the line.
    """
    return _Reader(decoded(data) if isinstance(data, bytes) else data, positions).read()


class _Reader:
    def __init__(self, text: str, positions: PositionMeaning) -> None:
        self._tokens = Tokens(text)
        self._positions = positions
        self._joints: list[HierarchyJoint] = []
        self._warnings: list[ClipWarning] = []

    def read(self) -> MotionClip:
        self._joints = read_hierarchy(self._tokens)
        names = self._names()
        channels = tuple(joint.channels or () for joint in self._joints)
        offsets = np.array([joint.offset or (0.0, 0.0, 0.0) for joint in self._joints])
        values, frame_time_s = self._motion(sum(map(len, channels)))
        if self._positions == "add":
            self._add_offsets(values, offsets, channels)
        return MotionClip(
            names=names,
            parents=np.array([joint.parent for joint in self._joints], dtype=np.intp),
            offsets=offsets,
            end_sites=tuple(tuple(joint.end_sites) for joint in self._joints),
            channels=channels,
            values=values,
            frame_time_s=frame_time_s,
            warnings=tuple(self._warnings),
        )

    def _add_offsets(
        self, values: FloatArray, offsets: FloatArray, channels: tuple[tuple[str, ...], ...]
    ) -> None:
        column = 0
        for joint, offset, own in zip(self._joints, offsets.tolist(), channels, strict=True):
            for channel in own:
                if channel in POSITIONS:
                    values[:, column] += offset[POSITIONS.index(channel)]
                    if np.abs(values[:, column]).max(initial=0.0) > LARGEST:
                        self._tokens.fail(f"OFFSET and {channel} add up to more than {LARGEST:g}", joint.at)
                column += 1

    def _names(self) -> tuple[str, ...]:
        names, numbered = told_apart([joint.name for joint in self._joints])
        for name, places in list(numbered.items())[:MAX_WARNINGS]:
            later = ", ".join(shown(names[place]) for place in places[:_MAX_LISTED])
            more = f" and {len(places) - _MAX_LISTED} more" if len(places) > _MAX_LISTED else ""
            message = (
                f"{len(places) + 1} joints are called {shown(name)}; the later ones are now {later}{more}"
            )
            self._warn("repeated_name", message, self._joints[places[0]].at)
        if len(numbered) > MAX_WARNINGS:
            more = (
                f"{len(numbered) - MAX_WARNINGS} more names are those of several joints, which are numbered"
            )
            self._warn("repeated_name", more, self._joints[list(numbered.values())[MAX_WARNINGS][0]].at)
        return names

    def _motion(self, channels: int) -> tuple[FloatArray, float]:
        """Values ``(F, channels)`` and seconds a frame."""
        tokens = self._tokens
        word = "" if tokens.peek() is None else tokens.next()
        if word.lower() == "root":
            tokens.fail("there is a second ROOT; Reina reads files with one skeleton")
        if word and word.lower() != "motion":
            tokens.fail(f"after the hierarchy comes MOTION, not {shown(word)}")
        if tokens.peek() is None:
            self._warn("no_motion", "the file has no motion; it is read as a skeleton at rest", tokens.at)
            return np.zeros((0, channels)), USUAL_FRAME_TIME_S
        announced = self._labelled("frames")
        announced_at = tokens.begin
        if announced != int(announced) or announced < 0:
            tokens.fail(f"the number of frames is a whole number, not {announced:g}")
        frame_time_s, time_at = USUAL_FRAME_TIME_S, tokens.at
        if tokens.peek() is not None:
            frame_time_s, time_at = self._labelled("frame", "time"), tokens.begin
        values, warnings = read_frames(tokens, channels, int(announced), announced_at)
        self._warnings += warnings
        if len(values) * len(self._joints) > MAX_POSES:
            tokens.fail(
                f"{len(values)} frames of {len(self._joints)} joints are more than Reina reads", announced_at
            )
        return values, self._frame_time(frame_time_s, time_at, len(values))

    def _frame_time(self, told: float, at: int, frames: int) -> float:
        """Seconds a frame; what a file says that has no second frame to wait for need not be right."""
        if SHORTEST_FRAME_TIME_S <= told <= LONGEST_FRAME_TIME_S:
            return told
        if frames > 1 and told <= 0.0:
            self._tokens.fail(f"the frame time is positive, not {told:g}", at)
        span = f"lies between {SHORTEST_FRAME_TIME_S:g} and {LONGEST_FRAME_TIME_S:g} seconds"
        if frames > 1:
            self._tokens.fail(f"the frame time {span}, not at {told:g}", at)
        if frames == 1:
            self._warn("frame_time", f"the frame time {span}, not at {told:g}; a thirtieth is taken", at)
        return USUAL_FRAME_TIME_S

    def _labelled(self, *label: str) -> float:
        tokens = self._tokens
        for wanted in label:
            word = tokens.next()
            if word.lower() != wanted:
                tokens.fail(f"here belongs '{' '.join(label).title()}: ' with a number, not {shown(word)}")
        if tokens.peek() == ":":
            tokens.next()
        return tokens.number()

    def _warn(self, kind: str, message: str, at: int) -> None:
        self._warnings.append(ClipWarning(kind, self._tokens.line(at), message))
