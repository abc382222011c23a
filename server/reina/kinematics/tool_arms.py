"""Arms with a tool in hand: the tool is one more link, its tip goes where it is asked to, by iteration."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.rotations import cross, from_matrix

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.kinematics.two_bone import TwoBoneLimbs
    from reina.rotations.arrays import ArrayLike, FloatArray

ROUNDS = 4
"""How often wrist and tool are balanced; fixed, so that a pose is a function of its target alone."""

GAIN = 0.75
"""How much of what a wrist is bent too far is taken back in a round."""

SLACK = 0.985
"""An arm that is stretched further than this part of its reach pulls its tool along."""

FOLDED = 1.04
"""So does one that is folded to less than this many times its shortest."""


@dataclass(frozen=True, eq=False)
class Tool:
    """A tool in a hand.

    Attributes:
        fulcrum: Where it is held, in the hand's frame, metres, ``(3,)``.
        direction: Which way it points, in the hand's frame, ``(3,)``, unit.
        tip: What of it is to be at its place, from the fulcrum on, in the hand's frame, metres, ``(3,)``.
    """

    fulcrum: FloatArray
    direction: FloatArray
    tip: FloatArray


@dataclass(frozen=True, eq=False)
class WristRange:
    """How far wrists may be bent before the tool gives way, radians.

    Attributes:
        flexion: About the hand's z axis, from and to.
        deviation: About its y axis, from and to, of each arm ``(K, 2)``.
    """

    flexion: tuple[float, float]
    deviation: FloatArray


@dataclass(frozen=True, eq=False)
class ToolPose:
    """Where hands and tools are, ``(F, K, ...)``."""

    wrists: FloatArray
    """Metres, ``(F, K, 3)``."""
    hands: FloatArray
    """The hands' rotations in the world, ``(F, K, 4)``."""
    fulcrums: FloatArray
    """Where the tools are held, metres, ``(F, K, 3)``."""
    directions: FloatArray
    """From there to the tips, unit, ``(F, K, 3)``."""
    hinges: FloatArray
    """Which way the elbows' hinges point, ``(F, K, 3)``, as `TwoBoneLimbs.solve` takes them."""
    lacking: FloatArray
    """How far the wrists are from where an arm can bring them, metres, ``(F, K)``; 0 where it can."""


class ToolArms:
    """K arms, each with a tool.

    A chain of shoulder, elbow, wrist and tip, solved as forward and backward reaching does (FABRIK, Aristidou
    and Lasenby 2011), from the tip that is given: the tool lies as it is asked to, the wrist follows from
    it, the elbow from wrist and shoulder in closed form; then what the wrist is bent beyond its range turns
    the tool about its tip, and so does an arm that would be stretched. After a fixed number of such rounds
    the tip is exactly at its place, and what gave way is the tool's direction.

    Args:
        arms: K limbs of upper arm, forearm and hand.
        tools: What each hand holds.
        dorsal: Which way the backs of the hands look where the tools lie flat, in the world, ``(K, 3)``.
        wrists: How far wrists bend.
    """

    def __init__(
        self, arms: TwoBoneLimbs, tools: Sequence[Tool], dorsal: ArrayLike, wrists: WristRange
    ) -> None:
        self._bend: FloatArray = np.asarray(arms.bend)[:, None]
        self._reach: FloatArray = arms.reach
        self._nearest: FloatArray = arms.nearest
        self._upper, self._lower = arms.lengths
        self._dorsal = np.asarray(dorsal, dtype=np.float64)
        # In the hand: columns direction, back of the hand across it, and their cross.
        held = np.empty((len(tools), 3, 3))
        for basis, tool in zip(held, tools, strict=True):
            back = np.array([0.0, 1.0, 0.0])
            back = back - tool.direction * (back @ tool.direction)
            basis[:, 0], basis[:, 1] = tool.direction, back / np.linalg.norm(back)
            basis[:, 2] = np.cross(basis[:, 0], basis[:, 1])
        self._to_basis: FloatArray = held.swapaxes(-1, -2)
        # From the tip to the wrist, and to the fulcrum, in that basis.
        self._wrist, self._fulcrum = (
            np.stack([-(basis @ vector) for basis, vector in zip(self._to_basis, vectors, strict=True)])[
                ..., None
            ]
            for vectors in ([tool.fulcrum + tool.tip for tool in tools], [tool.tip for tool in tools])
        )
        self._flexion = wrists.flexion
        self._deviation = wrists.deviation

    def solve(
        self,
        shoulders: FloatArray,
        tips: FloatArray,
        directions: FloatArray,
        poles: FloatArray,
        held: FloatArray | None = None,
        dorsal: FloatArray | None = None,
        yielding: FloatArray | None = None,
    ) -> ToolPose:
        """Bring the tips to their places.

        Args:
            shoulders: Where the arms begin, ``(F, K, 3)``, metres.
            tips: Where the tips are to be, ``(F, K, 3)``, metres.
            directions: Which way the tools are asked to point, from the hand on, ``(F, K, 3)``, unit.
            poles: Which way the elbows point, ``(F, K, 3)``; only what lies across shoulder-to-wrist counts.
            held: What is to be at `tips` instead of the tools' tips, as `seen_from` gives it; hands then
                turn as if the tools were held as ever.
            dorsal: Which way the backs of the hands look, ``(F, K, 3)``; as ever by default.
            yielding: How far the tools give way where arms cannot, 0 to 1, ``(F, K)``; 1 by default.
        """
        pointing = directions
        wrist = self._wrist if held is None else held[..., None]
        back_way = self._dorsal if dorsal is None else dorsal
        for _ in range(ROUNDS):
            basis = self._basis(pointing, back_way)
            wrists = tips + np.matmul(basis, wrist)[..., 0]
            forearms, stretched = self._forearms(shoulders, wrists, poles)
            hands = np.matmul(basis, self._to_basis)
            in_hand = np.matmul(hands.swapaxes(-1, -2), forearms[..., None])[..., 0]
            flexion = np.arctan2(in_hand[..., 1], in_hand[..., 0])
            deviation = np.arctan2(in_hand[..., 2], np.hypot(in_hand[..., 0], in_hand[..., 1]))
            up = GAIN * _beyond(flexion, *self._flexion)[..., None]
            aside = GAIN * _beyond(deviation, self._deviation[:, 0], self._deviation[:, 1])[..., None]
            arm = wrists - tips
            back = cross(stretched, arm) / np.einsum("...i,...i->...", arm, arm)[..., None]
            turn = up * hands[..., 2] - aside * hands[..., 1] + back
            if yielding is not None:
                turn = turn * yielding[..., None]
            pointing = pointing + cross(turn, pointing)
            pointing = pointing / np.sqrt(np.einsum("...i,...i->...", pointing, pointing))[..., None]
        basis = self._basis(pointing, back_way)
        wrists = tips + np.matmul(basis, wrist)[..., 0]
        far = wrists - shoulders
        distance = np.sqrt(np.einsum("...i,...i->...", far, far))
        lacking = np.maximum(distance - self._reach, 0.0) + np.maximum(self._nearest - distance, 0.0)
        hinges = cross(poles, far) * self._bend
        hands = from_matrix(np.matmul(basis, self._to_basis))
        fulcrums = tips + np.matmul(basis, self._fulcrum)[..., 0]
        return ToolPose(wrists, hands, fulcrums, pointing, hinges, lacking)

    def wrists(
        self,
        tips: FloatArray,
        directions: FloatArray,
        held: FloatArray | None = None,
        dorsal: FloatArray | None = None,
    ) -> FloatArray:
        """Where the wrists would be if no tool gave way, ``(F, K, 3)``, metres; arguments as `solve`."""
        basis = self._basis(directions, self._dorsal if dorsal is None else dorsal)
        return tips + np.matmul(basis, self._wrist if held is None else held[..., None])[..., 0]

    def seen_from(self, points: FloatArray) -> FloatArray:
        """From points in the hands' frames ``(..., K, 3)`` to the wrists, as `solve` takes them, metres."""
        return -self.in_basis(points)

    def in_basis(self, vectors: FloatArray) -> FloatArray:
        """Vectors in the hands' frames ``(..., K, 3)`` along tool, back of the hand, and across both."""
        return np.matmul(self._to_basis, vectors[..., None])[..., 0]

    @property
    def dorsal(self) -> FloatArray:
        """Which way the backs of the hands look as ever, ``(K, 3)``."""
        return self._dorsal

    def _basis(self, pointing: FloatArray, dorsal: FloatArray) -> FloatArray:
        """World directions of the held basis, as columns, ``(F, K, 3, 3)``."""
        basis = np.empty((*pointing.shape, 3))
        back = dorsal - pointing * np.einsum("...i,...i->...", pointing, dorsal)[..., None]
        back = back / np.sqrt(np.einsum("...i,...i->...", back, back))[..., None]
        basis[..., 0], basis[..., 1], basis[..., 2] = pointing, back, cross(pointing, back)
        return basis

    def _forearms(
        self, shoulders: FloatArray, wrists: FloatArray, poles: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Unit vectors from elbows to wrists, and by how much each wrist must come nearer, as a vector."""
        line = wrists - shoulders
        distance = np.sqrt(np.einsum("...i,...i->...", line, line))
        along = line / np.maximum(distance, 1e-9)[..., None]
        within = np.minimum(np.maximum(distance, FOLDED * self._nearest), SLACK * self._reach)
        pole = poles - along * np.einsum("...i,...i->...", along, poles)[..., None]
        pole = pole / np.sqrt(np.einsum("...i,...i->...", pole, pole))[..., None]
        ahead = (within * within + self._upper**2 - self._lower**2) / (2.0 * within)
        height = np.sqrt(np.maximum(self._upper**2 - ahead * ahead, 0.0))
        forearm = (within - ahead)[..., None] * along - height[..., None] * pole
        nearer = (distance - within)[..., None] * along
        return forearm / self._lower[..., None], nearer


def _beyond(value: FloatArray, low: FloatArray | float, high: FloatArray | float) -> FloatArray:
    """How far values lie outside of low … high, signed."""
    return np.minimum(value - low, 0.0) + np.maximum(value - high, 0.0)
