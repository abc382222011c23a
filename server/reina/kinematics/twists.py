"""Helper joints that share a turn about a bone, so that skin does not wring at one place."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.rotations import about_axis, conjugate, multiply, twist_angle

if TYPE_CHECKING:
    from reina.rotations.arrays import ArrayLike, FloatArray, IntArray
    from reina.skeleton import Rig


class TwistHelpers:
    """All twist helpers of a rig.

    Args:
        rig: The rig; its ``twists`` say which helper takes how much of which joint's turn.
    """

    def __init__(self, rig: Rig) -> None:
        self.joints: IntArray = np.array([twist.joint for twist in rig.twists], dtype=np.intp)
        """The helpers' indices, ``(T,)``."""
        self.sources: IntArray = np.array([twist.source for twist in rig.twists], dtype=np.intp)
        """The joints whose turn they read, ``(T,)``."""
        self._fractions: FloatArray = np.array([twist.fraction for twist in rig.twists])
        self._rest: FloatArray = rig.skeleton.rest_rotations[self.joints]
        self._source_inverse: FloatArray = conjugate(rig.skeleton.rest_rotations[self.sources])

    def solve(self, source_rotations: ArrayLike) -> FloatArray:
        """The helpers' local rotations ``(..., T, 4)`` for the sources' local rotations ``(..., T, 4)``."""
        from_rest = multiply(self._source_inverse, source_rotations)
        angle = twist_angle(from_rest, (1.0, 0.0, 0.0))
        return multiply(self._rest, about_axis(0, angle * self._fractions))
