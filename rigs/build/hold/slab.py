"""A flat thing that a hand lies on or takes hold of: a drum's head, a cymbal's edge."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass
class Slab:
    """A plane by a `point` of its upper side and its unit `normal`, solid below.

    With `inward` it begins at the point and reaches that way only, and is so `thick`.
    """

    point: Array
    normal: Array
    inward: Array | None = None
    thick: float = np.inf

    def clearance(self, points: Array) -> Array:
        """Distance (P,) from each point (P, 3) to its surface, negative inside."""
        offset = points - self.point
        height: Array = offset @ self.normal
        if self.inward is None:
            return height
        above = np.maximum(height, -self.thick - height)
        before = -(offset @ self.inward)
        outside: Array = np.hypot(np.maximum(above, 0.0), np.maximum(before, 0.0))
        return outside + np.minimum(np.maximum(above, before), 0.0)

    def on(self, point: Array) -> Array:
        """The point of the upper side over or under one."""
        return point - self.normal * float((point - self.point) @ self.normal)
