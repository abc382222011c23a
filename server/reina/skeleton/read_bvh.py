"""BVH files read: any channels in any order, and the oddities of files in the wild.

Keywords in any case, tabs, CRLF, blank lines, scientific notation, names with spaces, position channels on
any joint, frames broken over lines; a fault is named with its line.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NoReturn

import numpy as np

from reina.skeleton.errors import BvhError
from reina.skeleton.motion_clip import POSITIONS, ROTATIONS, MotionClip

MOST_JOINTS = 2000
MOST_VALUES = 50_000_000

_CHANNELS = {name.lower(): name for name in (*POSITIONS, *ROTATIONS)}


def read_bvh(data: bytes | str) -> MotionClip:
    """The clip in a BVH file.

    Raises:
        BvhError: The file is none or is broken; ``where`` names the line.
    """
    if isinstance(data, bytes):
        try:
            text = data.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = data.decode("latin-1")
    else:
        text = data
    return _Reader(text).read()


@dataclass
class _Hierarchy:
    names: list[str] = field(default_factory=list[str])
    parents: list[int] = field(default_factory=list[int])
    offsets: list[tuple[float, float, float]] = field(default_factory=list[tuple[float, float, float]])
    channels: list[tuple[str, ...]] = field(default_factory=list[tuple[str, ...]])
    end_sites: list[list[tuple[float, float, float]]] = field(
        default_factory=list[list[tuple[float, float, float]]]
    )


class _Reader:
    def __init__(self, text: str) -> None:
        self._lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
        self._next = 0

    def read(self) -> MotionClip:
        if self._words() != ["hierarchy"]:
            self._fail("a BVH file begins with HIERARCHY")
        tree = _Hierarchy()
        self._joint(tree, -1, self._line())
        words = self._words()
        if words[:1] == ["root"]:
            self._fail("there is a second ROOT; Reina reads files with one skeleton")
        if words != ["motion"]:
            self._fail("after the hierarchy comes MOTION")
        count = self._labelled("frames")
        if count != int(count) or count < 0:
            self._fail(f"the number of frames is a whole number, not {count:g}")
        frame_time_s = self._labelled("frame", "time")
        if not frame_time_s > 0.0:
            self._fail(f"the frame time is positive, not {frame_time_s:g}")
        values = self._values(int(count), sum(len(channels) for channels in tree.channels))
        return MotionClip(
            names=tuple(tree.names),
            parents=np.array(tree.parents, dtype=np.intp),
            offsets=np.array(tree.offsets),
            end_sites=tuple(tuple(sites) for sites in tree.end_sites),
            channels=tuple(tree.channels),
            values=values,
            frame_time_s=frame_time_s,
        )

    def _joint(self, tree: _Hierarchy, parent: int, heading: str) -> None:
        """The root or a joint with everything under it; a stack in place of recursion, for deep files."""
        stack = [self._begin(tree, parent, heading, "root")]
        while stack:
            line = self._line()
            words = line.lower().split()
            joint = stack[-1]
            if words[0] == "joint":
                stack.append(self._begin(tree, joint, line, "joint"))
            elif words[0] == "end":
                self._brace("{")
                tree.end_sites[joint].append(self._offset(self._line()))
                self._brace("}")
            elif words[0] == "offset":
                tree.offsets[joint] = self._offset(line)
            elif words[0] == "channels":
                tree.channels[joint] = self._channels(line)
            elif words == ["}"]:
                stack.pop()
            else:
                self._fail(f"{line.strip()!r} is not OFFSET, CHANNELS, JOINT, End Site or a closing brace")

    def _begin(self, tree: _Hierarchy, parent: int, heading: str, keyword: str) -> int:
        words = heading.split(maxsplit=1)
        if words[0].lower() != keyword:
            self._fail(f"here belongs {keyword.upper()} with a name, not {heading.strip()!r}")
        name = words[1].strip() if len(words) > 1 else ""
        brace = name.endswith("{")
        name = name.rstrip("{").strip()
        if not name:
            self._fail("a joint needs a name")
        if name in tree.names:
            self._fail(f"a second joint is called {name!r}")
        if len(tree.names) >= MOST_JOINTS:
            self._fail(f"the file has more than {MOST_JOINTS} joints")
        tree.names.append(name)
        tree.parents.append(parent)
        tree.offsets.append((0.0, 0.0, 0.0))
        tree.channels.append(())
        tree.end_sites.append([])
        if not brace:
            self._brace("{")
        return len(tree.names) - 1

    def _offset(self, line: str) -> tuple[float, float, float]:
        words = line.split()
        if words[0].lower() != "offset" or len(words) != 4:
            self._fail(f"here belongs OFFSET with three numbers, not {line.strip()!r}")
        x, y, z = (self._number(word) for word in words[1:])
        return x, y, z

    def _channels(self, line: str) -> tuple[str, ...]:
        words = line.split()
        if len(words) < 2 or not words[1].isdigit() or int(words[1]) != len(words) - 2:
            self._fail(f"CHANNELS gives their number and then their names, not {line.strip()!r}")
        unknown = [word for word in words[2:] if word.lower() not in _CHANNELS]
        if unknown:
            self._fail(f"channel {unknown[0]!r} is none of {', '.join(_CHANNELS.values())}")
        channels = tuple(_CHANNELS[word.lower()] for word in words[2:])
        if len(set(channels)) != len(channels):
            self._fail("a joint has the same channel twice")
        return channels

    def _labelled(self, *label: str) -> float:
        line = self._line()
        words = line.replace(":", " ").split()
        if [word.lower() for word in words[:-1]] != list(label):
            self._fail(f"here belongs '{' '.join(label).title()}: ' with a number, not {line.strip()!r}")
        return self._number(words[-1])

    def _values(self, frames: int, channels: int) -> np.ndarray:
        if frames * channels > MOST_VALUES:
            self._fail(f"{frames} frames of {channels} channels are more than Reina reads")
        begin = self._next
        try:
            values = np.array(" ".join(self._lines[begin:]).split(), dtype=np.float64)
        except ValueError:
            self._blame(begin)
        if values.size != frames * channels:
            for index in range(begin, len(self._lines)):
                found = len(self._lines[index].split())
                if found not in (0, channels):
                    self._next = index + 1
                    self._fail(f"a frame has {channels} values, this line {found}")
            found = values.size // max(channels, 1)
            raise BvhError(f"{frames} frames are announced, {found} are there", where=f"line {begin}")
        if not np.all(np.isfinite(values)):
            self._blame(begin)
        return values.reshape(frames, channels)

    def _blame(self, begin: int) -> NoReturn:
        """Find the line with what is no number."""
        for index in range(begin, len(self._lines)):
            self._next = index + 1
            for word in self._lines[index].split():
                self._number(word)
        raise AssertionError("every value is a number after all")

    def _number(self, word: str) -> float:
        try:
            value = float(word)
        except ValueError:
            self._fail(f"{word!r} is no number")
        if not np.isfinite(value):
            self._fail(f"{word} is no finite number")
        return value

    def _brace(self, brace: str) -> None:
        line = self._line().strip()
        if line != brace:
            self._fail(f"here belongs {brace!r}, not {line!r}")

    def _words(self) -> list[str]:
        return self._line().lower().split()

    def _line(self) -> str:
        """The next line that is not blank."""
        while self._next < len(self._lines):
            line = self._lines[self._next]
            self._next += 1
            if line.strip():
                return line
        raise BvhError("the file ends here, in the middle", where=f"line {len(self._lines)}")

    def _fail(self, detail: str) -> NoReturn:
        raise BvhError(detail, where=f"line {self._next}")
