"""Helper joints that share a turn about a bone, so that skin does not wring at one place."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from reina.kinematics.columns import columns, rows
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
        self._fractions: FloatArray = np.array([twist.fraction for twist in rig.twists])[:, None]
        # Of a source's turn from its rest only the parts x and w count, each a dot product with its rotation:
        # x y z w of rest⁻¹ q are linear in q. A helper's rotation is its rest turned about x.
        rest = rig.skeleton.rest_rotations
        units = multiply(conjugate(rest[self.sources])[:, None], np.eye(4))
        # Component by component, as `solve` has everything.
        self._read: FloatArray = np.ascontiguousarray(units[..., [0, 3]].transpose(2, 1, 0)[..., None])
        self._rest: FloatArray = columns(rest[self.joints][None])
        self._turned: FloatArray = columns(multiply(rest[self.joints], (1.0, 0.0, 0.0, 0.0))[None])

    def solve(self, source_rotations: ArrayLike) -> FloatArray:
        """The helpers' local rotations ``(..., T, 4)`` for the sources' local rotations ``(..., T, 4)``."""
        given = np.asarray(source_rotations, dtype=np.float64)
        q = columns(given.reshape(math.prod(given.shape[:-2]), *given.shape[-2:]))
        x: FloatArray = np.add.reduce(self._read[0] * q)
        w: FloatArray = np.add.reduce(self._read[1] * q)
        # Half the twist's angle, the short way round.
        half = np.arctan2(np.where(w < 0.0, -x, x), np.abs(w)) * self._fractions
        return rows(np.cos(half) * self._rest + np.sin(half) * self._turned).reshape(given.shape)
