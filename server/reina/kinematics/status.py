"""What a solver says about its result."""

from __future__ import annotations

from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

StatusArray = NDArray[np.uint8]


class SolveStatus(IntEnum):
    """How a target was met; every result is defined whatever the status."""

    REACHED = 0
    """The end is at the target."""
    OUT_OF_REACH = 1
    """No pose within the limits brings the end so far or so near."""
    AT_LIMIT = 2
    """The distance could be met but a joint stopped at its limit, so the end is beside the target."""
    NOT_CONVERGED = 3
    """An iterative solver met its bound of iterations while the end was still beside the target."""
