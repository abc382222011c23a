"""How many bytes an object holds, estimated without walking through all of it."""

from __future__ import annotations

import sys
from contextlib import suppress
from itertools import islice
from types import BuiltinFunctionType, FunctionType, MethodType, ModuleType
from typing import TYPE_CHECKING, Any, cast

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator

SAMPLED = 48
"""Of a longer collection so many, spread over it, stand for all."""
DEEPEST = 40
"""Nothing that is held nests so deeply; beyond it nothing is counted."""
LEAVES = (type(None), type, range, ModuleType, BuiltinFunctionType)
NUMBER_BYTES = 28
ATTRIBUTE_BYTES = 16
"""What an attribute takes where its object keeps it."""


def weight_of(held: object, shared: Iterable[object] = ()) -> int:
    """About how many bytes an object keeps in memory, by what it refers to.

    Arrays count with their bytes, texts with their characters, and what lies in several places once. Of long
    collections some entries are looked at and stand for the others, so that a show of half a million
    keyframes is weighed as quickly as a short one. Modules and classes weigh nothing.

    Args:
        held: The object.
        shared: What is not counted: it is there anyway.
    """
    return _Scales(id(each) for each in shared).weigh(held, 0)


class _Scales:
    def __init__(self, seen: Iterable[int]) -> None:
        self._seen = set(seen)

    def weigh(self, held: object, depth: int) -> int:
        if depth > DEEPEST or isinstance(held, LEAVES):
            return 0
        if isinstance(held, (int, float, complex)):
            return NUMBER_BYTES
        if id(held) in self._seen:
            return 0
        self._seen.add(id(held))
        if isinstance(held, (str, bytes, bytearray)):
            return sys.getsizeof(held)
        if isinstance(held, memoryview):
            # Arrays of one buffer each have a view of their own.
            return self._once(held.obj, held.nbytes)
        if isinstance(held, np.ndarray):
            return self._array(cast("np.ndarray[Any, Any]", held), depth)
        if isinstance(held, dict):
            entries = cast("dict[object, object]", held)
            pairs = (part for pair in entries.items() for part in pair)
            return sys.getsizeof(entries) + self._many(pairs, 2 * len(entries), depth)
        if isinstance(held, (list, tuple, set, frozenset)):
            several = cast("Collection[object]", held)
            return sys.getsizeof(several) + self._many(several, len(several), depth)
        return self._object(held, depth)

    def _once(self, held: object, size: int) -> int:
        if id(held) in self._seen:
            return 0
        self._seen.add(id(held))
        return size

    def _array(self, array: np.ndarray[Any, Any], depth: int) -> int:
        # Of a mapped file it is the map, which numpy's own types do not say.
        base = cast("object", array.base)
        if type(base) is memoryview:
            return sys.getsizeof(array) + self.weigh(cast("object", base), depth + 1)
        if base is not None and not isinstance(base, np.ndarray):
            return self.weigh(base, depth + 1) or array.nbytes
        if base is not None:
            # A view keeps the whole alive.
            return sys.getsizeof(array) + self.weigh(cast("np.ndarray[Any, Any]", base), depth + 1)
        return array.nbytes + 112

    def _many(self, parts: Iterable[object], count: int, depth: int) -> int:
        if count <= 2 * SAMPLED:
            return sum(self.weigh(part, depth + 1) for part in parts)
        # Keys of a dict stand beside values: an odd step meets both.
        step = (count // SAMPLED) | 1
        looked_at = list(islice(parts, 0, None, step))
        return sum(self.weigh(part, depth + 1) for part in looked_at) * count // len(looked_at)

    def _object(self, held: object, depth: int) -> int:
        parts = list(_fields(held))
        own = sys.getsizeof(held, 64) + ATTRIBUTE_BYTES * len(parts)
        return own + sum(self.weigh(part, depth + 1) for part in parts)


def _fields(held: object) -> Iterator[object]:
    """What an object refers to: its attributes, or what a function has of the one that it was made in."""
    if isinstance(held, MethodType):
        yield held.__self__
        return
    if isinstance(held, FunctionType):
        for cell in held.__closure__ or ():
            with suppress(ValueError):  # nothing is in it yet
                yield cell.cell_contents
        return
    attributes: object = getattr(held, "__dict__", None)
    if isinstance(attributes, dict):
        yield from cast("dict[str, object]", attributes).values()
    for kind in type(held).__mro__:
        slots: object = kind.__dict__.get("__slots__", ())
        for name in (slots,) if isinstance(slots, str) else cast("Iterable[str]", slots):
            if name not in {"__dict__", "__weakref__"}:
                yield getattr(held, name, None)
