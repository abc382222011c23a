"""Columns of few different values, as fingerings and their reasons are."""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, Generic, TypeVar, cast, overload

import numpy as np
from numpy.typing import NDArray

from reina.music.arrays import read_only

T = TypeVar("T")


class CodedColumn(Sequence[T], Generic[T]):
    """A sequence that holds each value once, and of each of its entries a number of one byte or two.

    Args:
        values: The different values.
        codes: (N,) unsigned integers, of each entry the place of its value.
    """

    def __init__(self, values: tuple[T, ...], codes: NDArray[np.unsignedinteger[Any]]) -> None:
        self._values = values
        self._codes = codes

    def __len__(self) -> int:
        return len(self._codes)

    @overload
    def __getitem__(self, index: int) -> T: ...

    @overload
    def __getitem__(self, index: slice) -> "CodedColumn[T]": ...

    def __getitem__(self, index: int | slice) -> "T | CodedColumn[T]":
        if isinstance(index, slice):
            return CodedColumn(self._values, self._codes[index])
        return self._values[int(self._codes[index])]

    def __iter__(self) -> Iterator[T]:
        return map(self._values.__getitem__, self._codes.tolist())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and tuple(self) == tuple(cast("Sequence[object]", other))

    def __hash__(self) -> int:
        return hash(tuple(self))


def coded(entries: Iterable[T]) -> CodedColumn[T]:
    """Return a column of these entries, which can be hashed."""
    places: dict[T, int] = {}
    codes = [places.setdefault(entry, len(places)) for entry in entries]
    return CodedColumn(tuple(places), read_only(np.array(codes, dtype=np.min_scalar_type(len(places)))))
