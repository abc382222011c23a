"""Helper joints that share a turn about a bone, so that skin does not wring at one place."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.rotations import conjugate, multiply

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
        # Of a source's turn from its rest only the parts x and w count, each a dot product with its rotation:
        # x y z w of rest⁻¹ q are linear in q. A helper's rotation is its rest turned about x.
        rest = rig.skeleton.rest_rotations
        units = multiply(conjugate(rest[self.sources])[:, None], np.eye(4))
        self._read: FloatArray = np.ascontiguousarray(units[..., [0, 3]])
        self._rest: FloatArray = rest[self.joints]
        self._turned: FloatArray = multiply(self._rest, (1.0, 0.0, 0.0, 0.0))

    def solve(self, source_rotations: ArrayLike) -> FloatArray:
        """The helpers' local rotations ``(..., T, 4)`` for the sources' local rotations ``(..., T, 4)``."""
        q = np.asarray(source_rotations, dtype=np.float64)
        read: FloatArray = np.einsum("...ti,tic->c...t", q, self._read)
        # Half the twist's angle, the short way round.
        sign = np.where(read[1] < 0.0, -1.0, 1.0)
        half = np.arctan2(read[0] * sign, np.abs(read[1]))
        half = (half * self._fractions)[..., None]
        return np.cos(half) * self._rest + np.sin(half) * self._turned
