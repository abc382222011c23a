"""The finger that moves a slide: what lies in the slide's ring goes along as far as the finger reaches."""

from __future__ import annotations

import hashlib
import pickle
from typing import TYPE_CHECKING

import numpy as np

from reina.kinematics import ChainSolution, JointChain, SolveStatus, solve_damped_least_squares
from reina.skeleton import RigError

if TYPE_CHECKING:
    from reina.rotations.arrays import FloatArray, IntArray
    from reina.skeleton import Rig

SLIDE_FINGERS: dict[str, tuple[str, str]] = {"slide/3": ("leftRing", "ring")}
"""Which finger's chain moves which slide, and the instrument's contact that it does it by."""

YIELDING_M = np.array([0.005, 0.0, -0.003])
"""In the instrument's frame, by how much the finger draws back out of the ring and falls behind it, as far as
the ring's width lets it, by the middle of the way: straighter, it would else lie in the slide's own tubes."""

_SAMPLES = 129
_TOLERANCE_M = 1e-6
_ROUNDS = 60
_MOST_KEPT = 64
_KEPT: dict[bytes, ChainSolution] = {}
"""What was worked out for a player, an instrument and a leading hand: it takes half the time of planning."""


class SlideFinger:
    """One finger of the hand that holds the instrument.

    A ring is not held by the fingertip, so no closed form serves: of the finger's axis the point that is
    nearest the ring's middle in the hold goes with the ring, by damped least squares, and what is beyond it
    keeps its bend.

    Args:
        rig: The player's rig.
        chain: The finger's chain.
        ring: The middle of the ring in the hand's frame, ``(3,)``, metres.
        travel: The slide's way from in to out in the hand's frame, ``(3,)``, metres.
        yielding: `YIELDING_M` in the hand's frame.
        held: All joints' local rotations in the hold, ``(J, 4)``.

    Raises:
        RigError: The chain has no effector at its end.
    """

    def __init__(
        self,
        rig: Rig,
        chain: str,
        ring: FloatArray,
        travel: FloatArray,
        yielding: FloatArray,
        held: FloatArray,
    ) -> None:
        found = rig.chain(chain)
        if found.effector is None:
            raise RigError(f"{chain!r} is no finger: it needs an effector", location="chains")
        skeleton = rig.skeleton
        self.joints: IntArray = np.array(found.joints, dtype=np.intp)
        """Indices ``(N,)``."""
        self.held: FloatArray = held[self.joints]
        """Local rotations in the hold, ``(N, 4)``."""
        links = np.concatenate(
            [skeleton.rest_translations[self.joints], rig.effector(found.effector).offset[None]]
        )
        limits = tuple(rig.limits.get(joint) for joint in found.joints)
        whole = JointChain(links, skeleton.rest_rotations[self.joints], limits)
        bone, part = _nearest(whole.stance(whole.angles(self.held[None])).positions[0], ring)
        self._moved = slice(0, bone + 1)
        self._chain = JointChain(
            [*links[: bone + 1], part * links[bone + 1]], whole.rest[self._moved], limits[self._moved]
        )
        begin = self._chain.angles(self.held[None, self._moved])
        point = self._chain.stance(begin).positions[0, -1]
        ways = np.linspace(0.0, 1.0, _SAMPLES)
        targets = point + ways[:, None] * travel + np.minimum(2.0 * ways, 1.0)[:, None] * yielding
        solution = _solved(self._chain, targets, self.held[self._moved])
        short = np.flatnonzero(solution.status != SolveStatus.REACHED)
        self.reach = 1.0 if len(short) == 0 else float(ways[max(int(short[0]) - 1, 0)])
        """How far out the finger can follow, 0..1."""
        self._angles: FloatArray = self._chain.angles(solution.rotations)
        self._angles[0] = begin

    def solve(self, slide: FloatArray) -> FloatArray:
        """Local rotations, rest included, ``(F, N, 4)`` for the slide's extension, 0 in, 1 out, ``(F,)``.

        One number decides them, so they are read from a table, angle by angle: between two rows within the
        limits lie none that break them.
        """
        rotations = np.empty((len(slide), *self.held.shape))
        rotations[:] = self.held
        moved = np.flatnonzero(slide)
        if len(moved) == 0 or self.reach == 0.0:
            return rotations
        # Beyond its reach the finger is left behind gently: it comes to rest and does not stop.
        way = slide[moved]
        if self.reach < 1.0:
            way = self.reach * np.tanh(way / self.reach)
        place = np.minimum(np.maximum(way, 0.0), 1.0) * (_SAMPLES - 1)
        row = np.minimum(place.astype(np.intp), _SAMPLES - 2)
        before = self._angles[row]
        angles = before + (place - row)[:, None, None] * (self._angles[row + 1] - before)
        rotations[moved, self._moved] = self._chain.rotations(angles)
        return rotations


def _solved(chain: JointChain, targets: FloatArray, held: FloatArray) -> ChainSolution:
    """The chain led along the targets; of one hold always the same, so it is worked out once and kept."""
    asked = hashlib.sha256(pickle.dumps((chain, targets, held))).digest()
    solution = _KEPT.get(asked)
    if solution is None:
        solution = solve_damped_least_squares(
            chain, targets, held, tolerance_m=_TOLERANCE_M, iterations=_ROUNDS
        )
        if len(_KEPT) >= _MOST_KEPT:
            _KEPT.clear()
        _KEPT[asked] = solution
    return solution


def _nearest(points: FloatArray, place: FloatArray) -> tuple[int, float]:
    """Of bones between points ``(N + 1, 3)`` which comes nearest to a place, and at what part of it."""
    bones = points[1:] - points[:-1]
    parts = np.sum((place - points[:-1]) * bones, axis=-1) / np.sum(bones * bones, axis=-1)
    parts = np.minimum(np.maximum(parts, 0.05), 1.0)
    gaps = np.sum((points[:-1] + parts[:, None] * bones - place) ** 2, axis=-1)
    bone = int(np.argmin(gaps))
    return bone, float(parts[bone])
