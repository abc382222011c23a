"""Arms and legs: two bones, a hinge between them, and a direction for the hinge; closed form."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.kinematics.columns import columns, cross_columns, dot_columns, rows
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
    _direction: FloatArray  # (3, K, F), as the two below
    _length: FloatArray
    _wanted: FloatArray

    # Only worked out where they are asked for: a performance has no use for them.

    @property
    def ends(self) -> FloatArray:
        """Where the ends come to be, ``(..., K, 3)``: the targets, where they are reached."""
        reached = rows(self._direction * self._length)
        return self._roots + reached.reshape(*self.upper.shape[:-1], 3)

    @property
    def status(self) -> StatusArray:
        """A `SolveStatus` each, ``(..., K)``."""
        missed = (np.abs(self._length - self._wanted) > 1e-9).T.reshape(self.upper.shape[:-1])
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
        rest = skeleton.rest_rotations[lower]
        self.hinge: FloatArray = rotate(rest, np.array([axis for axis, _ in hinges]))
        """Hinge axes in the upper bones' frames, ``(K, 3)``."""
        low: FloatArray = np.array([bounds[0] for _, bounds in hinges])
        high: FloatArray = np.array([bounds[1] for _, bounds in hinges])
        axis_quaternions = np.concatenate([self.hinge, np.zeros((len(names), 1))], axis=-1)
        first = skeleton.rest_translations[lower]
        second = rotate(rest, skeleton.rest_translations[end])
        self.lengths: FloatArray = np.stack([np.sqrt(dot(first, first)), np.sqrt(dot(second, second))])
        """Of upper and lower bones, metres, ``(2, K)``."""
        along = self.hinge * dot(self.hinge, second)[:, None]
        c0, c1, c2 = first + along, second - along, cross(self.hinge, second)
        a, b, c = dot(c0, c0) + dot(c1, c1), 2.0 * dot(c0, c1), 2.0 * dot(c0, c2)
        m, middle = np.hypot(b, c), np.arctan2(c, b)
        # Straightest is nearest the middle; from there the limb bends to the side that has more room.
        straight = np.clip(middle, low, high)
        self.bend: FloatArray = np.where(high - straight >= straight - low, 1.0, -1.0)
        """1 for limbs that bend by positive hinge angles, -1 for those that bend by negative, ``(K,)``."""
        bent, folded = np.where(self.bend > 0, high, low), middle + self.bend * np.pi
        bent = np.where(self.bend > 0, np.minimum(bent, folded), np.maximum(bent, folded))
        self.reach: FloatArray = np.sqrt(a + m * np.cos(straight - middle))
        """The greatest distance from root to end, ``(K,)``, metres."""
        self.nearest: FloatArray = np.sqrt(a + m * np.cos(bent - middle))
        """The least distance, ``(K,)``, metres."""
        self._hard = softness == 0.0
        # Component by component, limb by limb, as `solve` has everything.
        self._rest, self._turned, self._hinge, self._c0, self._c1, self._c2 = (
            columns(one[None]) for one in (rest, multiply(axis_quaternions, rest), self.hinge, c0, c1, c2)
        )
        self._a, self._m, self._middle, self._side, self._low, self._high, self._least, self._most = (
            one[:, None] for one in (a, m, middle, self.bend, low, high, self.nearest, self.reach)
        )
        self._soft: FloatArray = self._most * softness

    def solve(self, roots: ArrayLike, targets: ArrayLike, hinge_directions: ArrayLike) -> LimbPose:
        """Bring the ends to targets.

        Args:
            roots: World positions of the upper joints, ``(..., K, 3)``, metres.
            targets: World positions for the end joints, ``(..., K, 3)``, metres.
            hinge_directions: Which way the hinge axes should point in the world, ``(..., K, 3)``; only what
                lies across root-to-target counts, and it must not vanish. `hinge_directions_from_poles`
                makes them of poles.
        """
        offset = np.asarray(targets, dtype=np.float64) - np.asarray(roots, dtype=np.float64)
        hint = np.broadcast_to(np.asarray(hinge_directions, dtype=np.float64), offset.shape)
        shape = offset.shape[:-1]
        # From here on component by component, limb by limb, frame by frame.
        offset, hint = columns(offset.reshape(-1, shape[-1], 3)), columns(hint.reshape(-1, shape[-1], 3))
        wanted = np.sqrt(dot_columns(offset, offset))
        distance = np.minimum(np.maximum(self._soften(wanted), self._least), self._most)
        fraction = np.minimum(np.maximum((distance * distance - self._a) / self._m, -1.0), 1.0)
        angle = self._middle + self._side * np.arccos(fraction)
        half = 0.5 * np.minimum(np.maximum(angle, self._low), self._high)
        cosine, sine = np.cos(half), np.sin(half)
        lower_local = cosine * self._rest + sine * self._turned
        # cos θ and sin θ from those of the half angle.
        local_end = self._c0 + (1.0 - 2.0 * sine * sine) * self._c1 + (2.0 * sine * cosine) * self._c2
        length = np.sqrt(dot_columns(local_end, local_end))
        # Two frames of direction and hinge, in the world and in the upper bone, whose turn is between them.
        ahead = np.stack([offset / np.maximum(wanted, 1e-12), local_end / length], axis=1)
        hints = np.stack([hint, np.broadcast_to(self._hinge, hint.shape)], axis=1)
        world, local = _frames(ahead, hints)
        turn = np.einsum("iv...,jv...->ij...", world, local)
        matrices = turn.reshape(9, *turn.shape[2:]).transpose(2, 1, 0)
        upper = from_matrix(matrices.reshape(*shape, 3, 3))
        found = rows(lower_local).reshape(*shape, 4)
        return LimbPose(upper, found, np.asarray(roots, dtype=np.float64), ahead[:, 0], length, wanted)

    def _soften(self, distance: FloatArray) -> FloatArray:
        """Distances mapped, C1, so that full reach is never met; unchanged before the soft zone."""
        if self._hard:
            return distance
        start = self._most - self._soft
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


def _frames(directions: FloatArray, hints: FloatArray) -> FloatArray:
    """Of directions and hints ``(3, 2, K, F)`` each two frames, ``(2, 3, 3, K, F)``.

    A frame's vectors are the direction, the hint made perpendicular, and their cross: ``frame[i, v]`` is
    component i of vector v.
    """
    normals = hints - directions * dot_columns(directions, hints)
    normals /= np.sqrt(dot_columns(normals, normals))
    vectors = np.stack([directions, normals, cross_columns(directions, normals)])
    return vectors.transpose(2, 1, 0, 3, 4)


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
