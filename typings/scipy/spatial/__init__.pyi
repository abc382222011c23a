"""What Reina uses of scipy.spatial, which ships no types."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

class KDTree:
    def __init__(
        self, data: ArrayLike, *, compact_nodes: bool = True, balanced_tree: bool = True
    ) -> None: ...
    def query(
        self, x: ArrayLike, k: int = 1, *, distance_upper_bound: float = ...
    ) -> tuple[NDArray[np.float64], NDArray[np.intp]]: ...

class cKDTree(KDTree): ...  # noqa: N801
