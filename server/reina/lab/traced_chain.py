"""A chain that remembers the angles that an iterative solver came by."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.kinematics import JointChain

if TYPE_CHECKING:
    from reina.kinematics.joint_chain import Stance
    from reina.rotations.arrays import FloatArray


class TracedChain(JointChain):
    """A chain for one run of an iterative solver on one target.

    A solver takes the stance of its whole table of angles before each round and after the last; within a
    round it asks for stances of copies. So the stances of that one table are the way that it went. Running
    it one round at a time would not tell the same: a pose has two sets of Euler angles, and which of them a
    round begins with decides which hinges it turns.

    Attributes:
        trace: Angles ``(N, 3)`` before each round and after the last.
    """

    trace: list[FloatArray]
    _table: FloatArray | None

    @classmethod
    def of(cls, chain: JointChain) -> TracedChain:
        """The same chain with an empty trace."""
        traced = cls(chain.links, chain.rest, chain.limits)
        traced.trace = []
        traced._table = None
        return traced

    def stance(self, angles: FloatArray) -> Stance:
        """As `JointChain.stance`; remembers the angles where they are the solver's own table."""
        if self._table is None:
            self._table = angles
        if angles is self._table:
            self.trace.append(np.array(angles[0]))
        return super().stance(angles)
