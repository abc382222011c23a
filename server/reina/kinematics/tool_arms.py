"""Arms with a tool in hand: the tool is one more link, its tip goes where it is asked to, by iteration."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.kinematics.columns import LAST, NEXT, columns, cross_columns, dot_columns, rows
from reina.rotations import from_matrix

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.kinematics.two_bone import TwoBoneLimbs
    from reina.rotations.arrays import ArrayLike, FloatArray

ROUNDS = 4
"""How often wrist and tool are balanced at most; fixed, so that a pose is a function of its target alone."""

GAIN = 0.75
"""How much of what a wrist is bent too far is taken back in a round."""

SLACK = 0.985
"""An arm that is stretched further than this part of its reach pulls its tool along."""

FOLDED = 1.04
"""So does one that is folded to less than this many times its shortest."""

_ALONG = 1e-18
"""No vector across another is taken to be shorter, squared."""


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
        # All vectors are kept as rows of components, (3, K, F): on short blocks that is many times faster.
        self._bend: FloatArray = np.asarray(arms.bend)[:, None]
        self._reach: FloatArray = arms.reach[:, None]
        self._nearest: FloatArray = arms.nearest[:, None]
        upper, lower = (np.asarray(length)[:, None] for length in arms.lengths)
        self._squares: tuple[FloatArray, FloatArray] = (upper * upper, upper * upper - lower * lower)
        self._backs = _Backs(columns(np.asarray(dorsal, dtype=np.float64)[None]))
        # In the hand: columns direction, back of the hand across it, and their cross.
        held = np.empty((len(tools), 3, 3))
        for basis, tool in zip(held, tools, strict=True):
            back = np.array([0.0, 1.0, 0.0])
            back = back - tool.direction * (back @ tool.direction)
            basis[:, 0], basis[:, 1] = tool.direction, back / np.linalg.norm(back)
            basis[:, 2] = np.cross(basis[:, 0], basis[:, 1])
        self._to_basis: FloatArray = held.swapaxes(-1, -2)
        # From the tip to the wrist, and to the fulcrum, in that basis, (3, K, 1).
        self._wrist, self._fulcrum = (
            columns(np.stack([-(vector @ basis) for basis, vector in zip(held, vectors, strict=True)])[None])
            for vectors in ([tool.fulcrum + tool.tip for tool in tools], [tool.tip for tool in tools])
        )
        # The hand's axes in that basis, axis by axis, (3, 3, K, 1).
        self._axes: FloatArray = np.ascontiguousarray(held.transpose(1, 2, 0)[..., None])
        self._flexion = wrists.flexion
        self._deviation = wrists.deviation.T[..., None]

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
        pointing, pole = columns(directions), columns(poles)
        aim = columns(tips - shoulders)
        steep = dot_columns(pole, pole)
        wrist = self._wrist if held is None else columns(held)
        backs = self._backs if dorsal is None else _Backs(columns(dorsal))
        lever = wrist / dot_columns(wrist, wrist)
        giving = None if yielding is None else yielding.T
        for _ in range(ROUNDS):
            basis = _basis(pointing, backs)
            arm = _weighted(basis, wrist)
            forearm, nearer = self._forearms(aim + arm, pole, steep)
            across = np.add.reduce(basis * forearm, axis=1)
            x, y, z = np.add.reduce(self._axes * across, axis=1)
            up = GAIN * _beyond(np.arctan2(y, x), *self._flexion)
            aside = GAIN * _beyond(np.arctan2(z, np.sqrt(x * x + y * y)), *self._deviation)
            if giving is not None:
                up, aside, nearer = up * giving, aside * giving, nearer * giving
            moved = (up != 0.0) | (aside != 0.0) | nearer.any(axis=0)
            if not moved.any():
                break  # all further rounds would be the same
            # The turn (up about the hand's z, aside about its y) × pointing, in the basis.
            turn = up * self._axes[2] - aside * self._axes[1]
            # And that by which the wrist comes nearer: (nearer × arm) × pointing / |arm|².
            pull = dot_columns(pointing, nearer)
            turned = (
                pointing
                + turn[2] * basis[1]
                - turn[1] * basis[2]
                + pull * _weighted(basis, lever)
                - lever[0] * nearer
            )
            # Who has come to rest stays so, to the last bit, however many rounds others in the block take.
            pointing = np.where(moved, turned / np.sqrt(dot_columns(turned, turned)), pointing)
        else:
            basis = _basis(pointing, backs)
            arm = _weighted(basis, wrist)
        far = aim + arm
        distance = np.sqrt(dot_columns(far, far))
        lacking = np.maximum(distance - self._reach, 0.0) + np.maximum(self._nearest - distance, 0.0)
        hinges = cross_columns(pole, far) * self._bend
        hands = from_matrix(np.matmul(basis.transpose(3, 2, 1, 0), self._to_basis))
        return ToolPose(
            tips + rows(arm),
            hands,
            tips + rows(_weighted(basis, self._fulcrum)),
            rows(pointing),
            rows(hinges),
            np.ascontiguousarray(lacking.T),
        )

    def wrists(
        self,
        tips: FloatArray,
        directions: FloatArray,
        held: FloatArray | None = None,
        dorsal: FloatArray | None = None,
    ) -> FloatArray:
        """Where the wrists would be if no tool gave way, ``(F, K, 3)``, metres; arguments as `solve`."""
        backs = self._backs if dorsal is None else _Backs(columns(dorsal))
        wrist = self._wrist if held is None else columns(held)
        return tips + rows(_weighted(_basis(columns(directions), backs), wrist))

    def seen_from(self, points: FloatArray) -> FloatArray:
        """From points in the hands' frames ``(..., K, 3)`` to the wrists, as `solve` takes them, metres."""
        return -self.in_basis(points)

    def in_basis(self, vectors: FloatArray) -> FloatArray:
        """Vectors in the hands' frames ``(..., K, 3)`` along tool, back of the hand, and across both."""
        return np.matmul(self._to_basis, vectors[..., None])[..., 0]

    def _forearms(
        self, line: FloatArray, pole: FloatArray, steep: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Vectors along the forearms, and by how much each wrist must come nearer, as a vector.

        Args:
            line: From shoulders to wrists, ``(3, K, F)``.
            pole: Which way the elbows point, ``(3, K, F)``.
            steep: The squares of its lengths, ``(K, F)``.
        """
        distance = np.sqrt(dot_columns(line, line))
        along = line / np.maximum(distance, 1e-9)
        within = np.minimum(np.maximum(distance, FOLDED * self._nearest), SLACK * self._reach)
        ahead = (within * within + self._squares[1]) / (2.0 * within)
        height = np.sqrt(np.maximum(self._squares[0] - ahead * ahead, 0.0))
        leaning = dot_columns(pole, along)
        height /= np.sqrt(np.maximum(steep - leaning * leaning, _ALONG))
        forearm = (within - ahead + height * leaning) * along - height * pole
        return forearm, (distance - within) * along


class _Backs:
    """Which way the backs of the hands look, ``(3, K, F)``, and what `_basis` needs of it."""

    def __init__(self, dorsal: FloatArray) -> None:
        self.ways = dorsal
        self.next, self.last = dorsal[NEXT], dorsal[LAST]
        self.square: FloatArray = dot_columns(dorsal, dorsal)


def _basis(pointing: FloatArray, backs: _Backs) -> FloatArray:
    """World directions of the held basis, vector by vector, ``(3, 3, K, F)``."""
    basis = np.empty((3, *pointing.shape))
    leaning = dot_columns(pointing, backs.ways)
    basis[0] = pointing
    np.subtract(backs.ways, pointing * leaning, out=basis[1])
    # pointing × dorsal, since what was taken away lies along the first.
    product = pointing.take(NEXT, axis=0)
    product *= backs.last
    np.subtract(product, pointing.take(LAST, axis=0) * backs.next, out=basis[2])
    basis[1:] /= np.sqrt(np.maximum(backs.square - leaning * leaning, _ALONG))
    return basis


def _weighted(basis: FloatArray, weights: FloatArray) -> FloatArray:
    """Sums of a basis's vectors, ``(3, K, F)``."""
    return np.add.reduce(basis * weights[:, None])


def _beyond(value: FloatArray, low: FloatArray | float, high: FloatArray | float) -> FloatArray:
    """How far values lie outside of low … high, signed."""
    return np.minimum(value - low, 0.0) + np.maximum(value - high, 0.0)
