"""What Reina uses of scipy.optimize, which ships no types."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

class OptimizeResult:
    x: NDArray[np.float64]
    cost: float
    fun: NDArray[np.float64]
    success: bool

def least_squares(
    fun: Callable[[NDArray[np.float64]], ArrayLike],
    x0: ArrayLike,
    *,
    bounds: tuple[ArrayLike, ArrayLike] = ...,
    max_nfev: int | None = None,
    xtol: float | None = 1e-8,
    ftol: float | None = 1e-8,
    gtol: float | None = 1e-8,
    **settings: Any,
) -> OptimizeResult: ...
