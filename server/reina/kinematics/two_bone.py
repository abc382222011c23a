"""Arms and legs: two bones, a hinge between them, and a direction for the hinge; closed form."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.kinematics.status import SolveStatus, StatusArray
from reina.rotations import cross, dot, from_matrix, multiply, rotate
from reina.skeleton import RigError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.rotations.arrays import ArrayLike, FloatArray, IntArray
    from reina.skeleton import Rig

_UNBOUNDED = (-np.pi, np.pi)


@dataclass(frozen=True, eq=False)
class LimbPose:
    """What `TwoBoneLimbs.solve` finds, for every frame and limb."""

    upper: FloatArray
    """The upper bone's rotation in the world, ``(..., K, 4)``."""
    lower_local: FloatArray
    """The lower bone's local rotation, rest included, ``(..., K, 4)``."""
    _roots: FloatArray
    _direction: FloatArray
    _length: FloatArray
    _wanted: FloatArray

    # Only worked out where they are asked for: a performance has no use for them.

    @property
    def ends(self) -> FloatArray:
        """Where the ends come to be, ``(..., K, 3)``: the targets, where they are reached."""
        return self._roots + self._direction * self._length[..., None]

    @property
    def status(self) -> StatusArray:
        """A `SolveStatus` each, ``(..., K)``."""
        missed = np.abs(self._length - self._wanted) > 1e-9
        return missed.astype(np.uint8) * np.uint8(SolveStatus.OUT_OF_REACH)


class TwoBoneLimbs:
    """K limbs, solved side by side.

    A limb is an upper bone that turns freely, a lower bone that turns about one axis (its rig's limits say
    which), and an end. With the hinge at angle θ the end lies in the upper bone's frame at c0 + c1 cos θ +
    c2 sin θ, so its squared distance is A + B cos θ + C sin θ, and θ = atan2(C, B) ± acos((d² - A) / |B,
    C|): no iteration, and the hinge turns about its own axis exactly, also where the bones do not lie in
    one plane.

    Args:
        rig: The player's rig.
        names: K chains of three joints: upper, lower, end.
        softness: Length of the zone before full reach in which the limb straightens ever more slowly
            instead of snapping straight, as a part of the reach; the end stays behind the target there. 0
            is a hard stop.

    Raises:
        RigError: A chain has not three joints, or its middle joint's limits name no single axis.
    """

    def __init__(self, rig: Rig, names: Sequence[str], softness: float = 0.0) -> None:
        chains = [rig.chain(name) for name in names]
        self.names = tuple(names)
        self.joints: IntArray = np.array([chain.joints for chain in chains], dtype=np.intp)
        """Indices ``(K, 3)``: upper, lower, end."""
        skeleton = rig.skeleton
        lower, end = self.joints[:, 1], self.joints[:, 2]
        hinges = [_hinge(rig, int(joint)) for joint in lower]
        self._rest: FloatArray = skeleton.rest_rotations[lower]
        self.hinge: FloatArray = rotate(self._rest, np.array([axis for axis, _ in hinges]))
        """Hinge axes in the upper bones' frames, ``(K, 3)``."""
        self._low: FloatArray = np.array([bounds[0] for _, bounds in hinges])
        self._high: FloatArray = np.array([bounds[1] for _, bounds in hinges])
        axis_quaternions = np.concatenate([self.hinge, np.zeros((len(names), 1))], axis=-1)
        self._turned: FloatArray = multiply(axis_quaternions, self._rest)
        first = skeleton.rest_translations[lower]
        second = rotate(self._rest, skeleton.rest_translations[end])
        self.lengths: FloatArray = np.stack([np.sqrt(dot(first, first)), np.sqrt(dot(second, second))])
        """Of upper and lower bones, metres, ``(2, K)``."""
        along = self.hinge * dot(self.hinge, second)[:, None]
        self._c0: FloatArray = first + along
        self._c1: FloatArray = second - along
        self._c2: FloatArray = cross(self.hinge, second)
        self._a: FloatArray = dot(self._c0, self._c0) + dot(self._c1, self._c1)
        b, c = 2.0 * dot(self._c0, self._c1), 2.0 * dot(self._c0, self._c2)
        self._m: FloatArray = np.hypot(b, c)
        self._middle: FloatArray = np.arctan2(c, b)
        # Straightest is nearest the middle; from there the limb bends to the side that has more room.
        straight = np.clip(self._middle, self._low, self._high)
        self._side: FloatArray = np.where(self._high - straight >= straight - self._low, 1.0, -1.0)
        self.bend: FloatArray = self._side
        """1 for limbs that bend by positive hinge angles, -1 for those that bend by negative, ``(K,)``."""
        bent = np.where(self._side > 0, self._high, self._low)
        folded = self._middle + self._side * np.pi
        bent = np.where(self._side > 0, np.minimum(bent, folded), np.maximum(bent, folded))
        self.reach: FloatArray = self._distance(straight)
        """The greatest distance from root to end, ``(K,)``, metres."""
        self.nearest: FloatArray = self._distance(bent)
        """The least distance, ``(K,)``, metres."""
        self._soft: FloatArray = self.reach * softness
        self._hard = softness == 0.0

    def solve(self, roots: ArrayLike, targets: ArrayLike, hinge_directions: ArrayLike) -> LimbPose:
        """Bring the ends to targets.

        Args:
            roots: World positions of the upper joints, ``(..., K, 3)``, metres.
            targets: World positions for the end joints, ``(..., K, 3)``, metres.
            hinge_directions: Which way the hinge axes should point in the world, ``(..., K, 3)``; only what
                lies across root-to-target counts, and it must not vanish. `hinge_directions_from_poles`
                makes them of poles.
        """
        begin = np.asarray(roots, dtype=np.float64)
        offset = np.asarray(targets, dtype=np.float64) - begin
        wanted = np.sqrt(np.einsum("...i,...i->...", offset, offset))
        distance = np.minimum(np.maximum(self._soften(wanted), self.nearest), self.reach)
        cosine = np.minimum(np.maximum((distance * distance - self._a) / self._m, -1.0), 1.0)
        angle = self._middle + self._side * np.arccos(cosine)
        angle = np.minimum(np.maximum(angle, self._low), self._high)
        local_end = self._c0 + np.cos(angle)[..., None] * self._c1 + np.sin(angle)[..., None] * self._c2
        half = 0.5 * angle[..., None]
        lower_local = np.cos(half) * self._rest + np.sin(half) * self._turned
        direction = offset / np.maximum(wanted, 1e-12)[..., None]
        length = np.sqrt(np.einsum("...i,...i->...", local_end, local_end))
        # Two frames of direction and hinge, in the world and in the upper bone, whose turn is between them.
        ahead, hint = np.empty((2, *direction.shape)), np.empty((2, *direction.shape))
        ahead[0], ahead[1] = direction, local_end / length[..., None]
        hint[0], hint[1] = hinge_directions, self.hinge
        world, local = _frame(ahead, hint)
        upper = from_matrix(np.matmul(world, local.swapaxes(-1, -2)))
        return LimbPose(upper, lower_local, begin, direction, length, wanted)

    def _distance(self, angle: FloatArray) -> FloatArray:
        return np.sqrt(self._a + self._m * np.cos(angle - self._middle))

    def _soften(self, distance: FloatArray) -> FloatArray:
        """Distances mapped, C1, so that full reach is never met; unchanged before the soft zone."""
        if self._hard:
            return distance
        start = self.reach - self._soft
        beyond = np.maximum(distance - start, 0.0) / self._soft
        return np.where(distance > start, start - self._soft * np.expm1(-beyond), distance)


def hinge_directions_from_poles(
    roots: ArrayLike, targets: ArrayLike, poles: ArrayLike, bend: ArrayLike = 1.0
) -> FloatArray:
    """Hinge directions ``(..., 3)`` that make elbows or knees point towards ``poles``.

    Args:
        roots: Upper joints, ``(..., 3)``.
        targets: Ends, ``(..., 3)``.
        poles: World positions that the elbows should point to, ``(..., 3)``.
        bend: 1 where the limb bends by positive hinge angles, -1 where by negative, ``(...)``.
    """
    root = np.asarray(roots, dtype=np.float64)
    across = cross(np.asarray(poles, dtype=np.float64) - root, np.asarray(targets, dtype=np.float64) - root)
    return across * np.asarray(bend, dtype=np.float64)[..., None]


def _frame(direction: FloatArray, hint: FloatArray) -> FloatArray:
    """Matrices ``(..., 3, 3)``: as columns the direction, the hint made perpendicular, and their cross."""
    normal = hint - direction * np.einsum("...i,...i->...", direction, hint)[..., None]
    normal = normal / np.sqrt(np.einsum("...i,...i->...", normal, normal))[..., None]
    frame = np.empty((*direction.shape, 3))
    frame[..., 0] = direction
    frame[..., 1] = normal
    frame[..., 2] = cross(direction, normal)
    return frame


def _hinge(rig: Rig, joint: int) -> tuple[FloatArray, tuple[float, float]]:
    """The axis that a joint turns about, in its own frame, with the bounds of its angle from rest."""
    limits = rig.limits.get(joint)
    name = rig.skeleton.names[joint]
    if limits is None:
        raise RigError(
            f"{name!r} is the hinge of a limb and needs limits that leave one axis", location="joints"
        )
    free = [axis for axis in range(3) if limits.minimum[axis] < limits.maximum[axis]]
    if len(free) != 1:
        axes = ", ".join("xyz"[axis] for axis in free) or "none"
        raise RigError(
            f"{name!r} is the hinge of a limb and must turn about one axis, not {axes}", location="joints"
        )
    low = max(limits.minimum[free[0]], _UNBOUNDED[0])
    high = min(limits.maximum[free[0]], _UNBOUNDED[1])
    return np.eye(3)[free[0]], (low, high)
