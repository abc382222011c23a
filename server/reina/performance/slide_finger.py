"""The finger that moves a slide: it goes along as far as it reaches."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.kinematics import FingerChains, SolveStatus, clamp_to_limits
from reina.rotations import conjugate, dot, multiply, rotate, same_hemisphere

if TYPE_CHECKING:
    from reina.rotations.arrays import FloatArray, IntArray
    from reina.skeleton import Rig

SLIDE_FINGERS: dict[str, str] = {"slide/3": "leftRing"}
"""Which finger's chain moves which slide: the left ring finger is in the third slide's ring."""

_SAMPLES = 2049


class SlideFinger:
    """One finger of the hand that holds the instrument.

    Its pose in the hold need not be one that its solver would find (a ring is not held by the fingertip),
    so only the difference that the slide's way makes to the solver is added to it.

    Args:
        rig: The player's rig.
        chain: The finger's chain.
        travel: The slide's way from in to out, in the instrument's frame, ``(3,)``, metres.
        hand_rotation: The hand in the instrument's frame, ``(4,)``.
        held: All joints' local rotations in the hold, ``(J, 4)``.
    """

    def __init__(
        self, rig: Rig, chain: str, travel: FloatArray, hand_rotation: FloatArray, held: FloatArray
    ) -> None:
        self._chains = FingerChains(rig, [chain])
        self.joints: IntArray = self._chains.joints[0]
        """Indices ``(3,)``."""
        self._rest: FloatArray = rig.skeleton.rest_rotations[self.joints]
        self._limits = [rig.limits.get(joint) for joint in self.joints.tolist()]
        self.held: FloatArray = held[self.joints]
        """Local rotations in the hold, ``(3, 4)``."""
        self._travel: FloatArray = rotate(conjugate(hand_rotation), travel)
        # The solver begins at the pad's place; where it cannot reach that, at the nearest that it can.
        pad = self._chains.tips(self.held[None])
        nearest, _ = self._chains.solve(pad)
        self._begin: FloatArray = self._chains.tips(nearest)[0]
        self._from_begin: FloatArray = conjugate(nearest[0])
        ways = np.linspace(0.0, 1.0, _SAMPLES)
        _, status = self._chains.solve((self._begin + ways[:, None] * self._travel)[:, None])
        short = np.flatnonzero(status[:, 0] != SolveStatus.REACHED)
        self.reach = 1.0 if len(short) == 0 else float(ways[max(int(short[0]) - 1, 0)])
        """How far out the finger can follow, 0..1."""
        self._table: FloatArray = self._at(ways)

    def _at(self, slide: FloatArray) -> FloatArray:
        """The joints' rotations ``(F, 3, 4)`` for extensions ``(F,)``."""
        # Beyond its reach the finger is left behind gently: it comes to rest and does not stop.
        way = slide if self.reach in (0.0, 1.0) else self.reach * np.tanh(slide / self.reach)
        solved, _ = self._chains.solve((self._begin + way[:, None] * self._travel)[:, None])
        rotations = multiply(self.held, multiply(self._from_begin, solved[:, 0]))
        for place, limits in enumerate(self._limits):
            if limits is not None:
                rotations[:, place] = clamp_to_limits(rotations[:, place], self._rest[place], limits)
        return same_hemisphere(rotations, self.held)

    def solve(self, slide: FloatArray) -> FloatArray:
        """Local rotations, rest included, ``(F, 3, 4)`` for the slide's extension, 0 in, 1 out, ``(F,)``.

        One number decides them, so they are read from a table; between its rows a chord is as good as
        the arc: no joint comes out of its limits by more than 1e-9 rad.
        """
        if not slide.any() or self.reach == 0.0:
            return np.broadcast_to(self.held, (len(slide), 3, 4))
        place = np.minimum(np.maximum(slide, 0.0), 1.0) * (_SAMPLES - 1)
        row = np.minimum(place.astype(np.intp), _SAMPLES - 2)
        before = self._table[row]
        rotations = before + (place - row)[:, None, None] * (self._table[row + 1] - before)
        return rotations / np.sqrt(dot(rotations, rotations))[..., None]
