"""Reading JSON documents: every complaint names the path at which it stands."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any, TypeGuard

import numpy as np

from reina.skeleton.errors import RigError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from reina.rotations.arrays import FloatArray

_UNIT_TOLERANCE = 1e-3


class Node:
    """A value in a JSON document together with the path that leads to it."""

    def __init__(self, value: Any, path: str = "") -> None:
        self.value = value
        self.path = path

    def fail(self, detail: str) -> RigError:
        """The error to raise about this place."""
        return RigError(detail, location=self.path or "document")

    def __contains__(self, key: str) -> bool:
        return key in self._object()

    def __getitem__(self, key: str) -> Node:
        """A member that must be there."""
        if key not in self._object():
            raise self.fail(f"{key!r} is missing")
        return self._child(key)

    def get(self, key: str) -> Node | None:
        """A member that may be absent or null."""
        return self._child(key) if self._object().get(key) is not None else None

    def items(self, key: str) -> Iterator[Node]:
        """The elements of a list member; none where it is absent."""
        member = self.get(key)
        if member is not None:
            for index, element in enumerate(member._list()):
                yield Node(element, f"{member.path}/{index}")

    def members(self) -> Iterator[tuple[str, Node]]:
        """The members of an object with their names."""
        for key in self._object():
            yield key, self._child(key)

    def text(self) -> str:
        """A string."""
        if not isinstance(self.value, str):
            raise self.fail(f"here belongs a string, not {_kind(self.value)}")
        return self.value

    def number(self) -> float:
        """A finite number."""
        if isinstance(self.value, bool) or not isinstance(self.value, (int, float)):
            raise self.fail(f"here belongs a number, not {_kind(self.value)}")
        try:
            value = float(self.value)
        except OverflowError:
            value = math.inf
        if not math.isfinite(value):
            raise self.fail("here belongs a finite number")
        return value

    def numbers(self, count: int) -> FloatArray:
        """Exactly ``count`` finite numbers, ``(count,)``."""
        entries = self._list()
        if len(entries) != count:
            raise self.fail(f"here belongs a list of {count} numbers, not of {len(entries)}")
        # A rig has thousands; only what is no plain number is looked at more closely.
        return np.array(
            [
                entry
                if type(entry) is float and math.isfinite(entry)
                else Node(entry, f"{self.path}/{i}").number()
                for i, entry in enumerate(entries)
            ]
        )

    def quaternion(self) -> FloatArray:
        """A unit quaternion x, y, z, w ``(4,)``, scaled to full precision."""
        q = self.numbers(4)
        x, y, z, w = q.tolist()
        length = math.sqrt(x * x + y * y + z * z + w * w)
        if abs(length - 1.0) > _UNIT_TOLERANCE:
            raise self.fail(f"quaternions are unit (x, y, z, w); this one has length {length:.6g}")
        return q / length

    def _object(self) -> dict[str, Any]:
        if not _is_object(self.value):
            raise self.fail(f"here belongs an object, not {_kind(self.value)}")
        return self.value

    def _list(self) -> list[Any]:
        if not _is_list(self.value):
            raise self.fail(f"here belongs a list, not {_kind(self.value)}")
        return self.value

    def _child(self, key: str) -> Node:
        return Node(self.value[key], f"{self.path}/{key}" if self.path else key)


def read_document(path: Path) -> Node:
    """The JSON document in a file.

    Raises:
        RigError: There is no such file, or it is no JSON object.
    """
    try:
        value: Any = json.loads(path.read_bytes())
    except FileNotFoundError:
        raise RigError(f"there is no file {path.name} in the folder {path.parent.name!r}") from None
    except (ValueError, RecursionError) as error:
        raise RigError(f"this is not JSON: {error}", location=path.name) from None
    if not isinstance(value, dict):
        raise RigError(f"here belongs an object, not {_kind(value)}", location=path.name)
    return Node(value)


_KINDS: dict[type[object], str] = {
    dict: "an object",
    list: "a list",
    str: "a string",
    bool: "true or false",
    type(None): "null",
}


def _is_object(value: object) -> TypeGuard[dict[str, Any]]:
    return isinstance(value, dict)


def _is_list(value: object) -> TypeGuard[list[Any]]:
    return isinstance(value, list)


def _kind(value: object) -> str:
    return _KINDS.get(type(value), "a number")
