"""A skeleton: a tree of joints with their rest pose."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from reina.skeleton.errors import RigError

if TYPE_CHECKING:
    from reina.rotations.arrays import FloatArray, IntArray

_UNIT_TOLERANCE = 1e-6


@dataclass(frozen=True, eq=False)
class Skeleton:
    """Joints, parents before children; the first is the root.

    Attributes:
        names: J names, all different.
        parents: Index of each joint's parent, ``(J,)``; the root's is -1.
        rest_translations: Each joint in its parent's frame, metres, ``(J, 3)``; the root's in the world.
        rest_rotations: Local rest rotations, unit quaternions, ``(J, 4)``.

    Raises:
        RigError: The joints form no tree in order, names repeat, or a rotation is not unit.
    """

    names: tuple[str, ...]
    parents: IntArray
    rest_translations: FloatArray
    rest_rotations: FloatArray
    _indices: dict[str, int] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        count = len(self.names)
        if count == 0:
            raise RigError("a skeleton needs at least one joint", location="joints")
        expected = {"parents": (count,), "rest_translations": (count, 3), "rest_rotations": (count, 4)}
        for name, shape in expected.items():
            found = getattr(self, name).shape
            if found != shape:
                raise RigError(f"{name} of {count} joints have shape {shape}, not {found}", location="joints")
        object.__setattr__(self, "_indices", {name: index for index, name in enumerate(self.names)})
        if len(self._indices) != count:
            twice = next(name for name in self.names if self.names.count(name) > 1)
            raise RigError(f"two joints are called {twice!r}; names must differ", location="joints")
        for index, parent in enumerate(self.parents.tolist()):
            if index == 0 and parent != -1:
                raise RigError(
                    "the first joint must be the root, without a parent", location="joints/0/parent"
                )
            if index > 0 and not 0 <= parent < index:
                raise RigError(
                    f"joint {self.names[index]!r} must have a parent that stands before it",
                    location=f"joints/{index}/parent",
                )
        lengths = np.sqrt(np.sum(self.rest_rotations**2, axis=-1))
        if not np.all(np.abs(lengths - 1.0) < _UNIT_TOLERANCE):
            index = int(np.argmax(np.abs(lengths - 1.0)))
            raise RigError(
                f"the rotation of {self.names[index]!r} has length {lengths[index]:.6g}, not 1",
                location=f"joints/{index}/rotation",
            )
        for array in (self.parents, self.rest_translations, self.rest_rotations):
            array.flags.writeable = False

    def __len__(self) -> int:
        return len(self.names)

    def __contains__(self, name: object) -> bool:
        return name in self._indices

    def index(self, name: str) -> int:
        """The index of a joint.

        Raises:
            RigError: There is none of that name; the message lists the names.
        """
        try:
            return self._indices[name]
        except KeyError:
            raise RigError(f"there is no joint {name!r}; the joints are {', '.join(self.names)}") from None

    def ancestors(self, joint: int) -> list[int]:
        """From the root down to the joint's parent."""
        path: list[int] = []
        parent = int(self.parents[joint])
        while parent >= 0:
            path.append(parent)
            parent = int(self.parents[parent])
        return path[::-1]

    @cached_property
    def levels(self) -> tuple[IntArray, ...]:
        """Joints by their distance from the root, the root's level first: what can be computed at once."""
        depth = [0] * len(self)
        for joint in range(1, len(self)):
            depth[joint] = depth[int(self.parents[joint])] + 1
        return tuple(np.flatnonzero(np.asarray(depth) == level) for level in range(max(depth) + 1))
