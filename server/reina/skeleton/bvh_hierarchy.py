"""The part of a BVH file between HIERARCHY and MOTION: a tree of joints."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from reina.skeleton.bvh_tokens import shown
from reina.skeleton.motion_clip import POSITIONS, ROTATIONS

if TYPE_CHECKING:
    from reina.skeleton.bvh_tokens import Tokens

MAX_JOINTS = 2000
"""Of joints, and of end sites."""

_KEYWORDS = frozenset({"root", "joint", "end", "offset", "channels", "motion", "{", "}"})
_CHANNELS = {name.lower(): name for name in (*POSITIONS, *ROTATIONS)}


@dataclass
class HierarchyJoint:
    """A joint as the file has it.

    Attributes:
        name: As it is written.
        at: Where in the text the name stands.
        parent: Index of its parent; the root's is -1.
        offset: In its parent's frame, the file's unit; None where the file says none.
        channels: Names of its channels in the file's order; None where the file says nothing of them.
        end_sites: Where its end sites are in its frame.
    """

    name: str
    at: int
    parent: int
    offset: tuple[float, float, float] | None = None
    channels: tuple[str, ...] | None = None
    end_sites: list[tuple[float, float, float]] = field(default_factory=list[tuple[float, float, float]])


def read_hierarchy(tokens: Tokens) -> list[HierarchyJoint]:
    """The joints from the word HIERARCHY to the root's closing brace, parents before children.

    Raises:
        BvhError: What stands there is no hierarchy; ``where`` names the line.
    """
    if tokens.next().lower() != "hierarchy":
        tokens.fail("a BVH file begins with HIERARCHY")
    return _Reader(tokens).read()


class _Reader:
    def __init__(self, tokens: Tokens) -> None:
        self._tokens = tokens
        self._joints: list[HierarchyJoint] = []
        self._sites = 0

    def read(self) -> list[HierarchyJoint]:
        """The root with everything under it; a stack in place of recursion, for deep files."""
        tokens = self._tokens
        word = tokens.next()
        if word.lower() != "root":
            tokens.fail(f"here belongs ROOT with a name, not {shown(word)}")
        stack = [self._begin(-1)]
        while stack:
            word = tokens.next()
            joint = self._joints[stack[-1]]
            match word.lower():
                case "joint":
                    stack.append(self._begin(stack[-1]))
                case "end":
                    self._end_site(joint)
                case "offset":
                    if joint.offset is not None:
                        tokens.fail(f"{shown(joint.name)} has a second OFFSET")
                    joint.offset = self._offset()
                case "channels":
                    if joint.channels is not None:
                        tokens.fail(f"{shown(joint.name)} has CHANNELS twice")
                    joint.channels = self._channels()
                case "}":
                    stack.pop()
                case _:
                    tokens.fail(
                        f"{shown(word)} is not OFFSET, CHANNELS, JOINT, End Site or a closing brace, "
                        f"one of which belongs here, in the joint {shown(joint.name)}"
                    )
        return self._joints

    def _begin(self, parent: int) -> int:
        tokens = self._tokens
        if len(self._joints) >= MAX_JOINTS:
            tokens.fail(f"the file has more than {MAX_JOINTS} joints")
        keyword = tokens.begin
        name = tokens.name()
        if not name:
            tokens.fail("a joint needs a name", keyword)
        self._joints.append(HierarchyJoint(name, tokens.begin, parent))
        tokens.brace("{")
        return len(self._joints) - 1

    def _end_site(self, joint: HierarchyJoint) -> None:
        tokens = self._tokens
        self._sites += 1
        if self._sites > MAX_JOINTS:
            tokens.fail(f"the file has more than {MAX_JOINTS} end sites")
        tokens.name()
        tokens.brace("{")
        word = tokens.next()
        if word.lower() != "offset":
            tokens.fail(f"here belongs OFFSET with three numbers, not {shown(word)}")
        joint.end_sites.append(self._offset())
        tokens.brace("}")

    def _offset(self) -> tuple[float, float, float]:
        tokens, begin = self._tokens, self._tokens.begin
        numbers: list[float] = []
        for found in range(3):
            if (tokens.peek() or "}").lower() in _KEYWORDS:
                tokens.fail(f"here belongs OFFSET with three numbers, not {found}", begin)
            numbers.append(tokens.number())
        x, y, z = numbers
        return x, y, z

    def _channels(self) -> tuple[str, ...]:
        tokens, begin = self._tokens, self._tokens.begin
        count = tokens.number()
        found: list[str] = []
        while (word := tokens.peek()) is not None and word.lower() not in _KEYWORDS:
            tokens.next()
            if word.lower() not in _CHANNELS:
                tokens.fail(f"channel {shown(word)} is none of {', '.join(_CHANNELS.values())}")
            if _CHANNELS[word.lower()] in found:
                tokens.fail(f"a joint has the same channel twice, {shown(word)}")
            found.append(_CHANNELS[word.lower()])
        if len(found) != count:
            tokens.fail(
                f"CHANNELS gives their number and then their names, not {count:g} and {len(found)}", begin
            )
        return tuple(found)
