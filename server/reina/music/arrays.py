"""Arrays that nobody changes by accident."""

from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
NarrowIntArray = NDArray[np.signedinteger[Any]]
"""Of whatever width holds its numbers."""
BoolArray = NDArray[np.bool_]

T = TypeVar("T", bound=np.generic)


def read_only(values: NDArray[T]) -> NDArray[T]:
    """Return `values`, copied if they belong to somebody else, as an array that refuses to be written to."""
    array = values.copy() if values.flags.writeable and values.base is not None else values
    array.flags.writeable = False
    return array
