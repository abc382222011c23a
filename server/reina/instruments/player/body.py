"""A player's body: gestures turn the trunk, hands go where they are asked to, feet stay where they stand."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.instruments.player.body_table import EYES, SIGNALS, TRUNK, Vector, body_matrix
from reina.instruments.player.rows import stacked
from reina.instruments.player.trunk import Trunk
from reina.kinematics import TwistHelpers, TwoBoneLimbs
from reina.rotations import conjugate, exp, multiply, product, rotate, same_hemisphere
from reina.skeleton import Point, RigError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from reina.instruments.player.held_pose import HeldPose
    from reina.rotations.arrays import FloatArray, IntArray
    from reina.skeleton import Rig

LIMBS: tuple[str, ...] = ("leftArm", "rightArm", "leftLeg", "rightLeg")
SOFT_KNEE_M = 0.001
"""No leg comes nearer to being straight than this; the hips sink instead, beginning twice as far before."""


@dataclass(frozen=True, eq=False)
class Standing:
    """F frames of a body whose arms are still to be placed."""

    local: FloatArray
    """Local rotations, rest included, of trunk and eyes, ``(F, T, 4)``."""
    hips: FloatArray
    """The root, metres, ``(F, 3)``."""
    world: FloatArray
    """World rotations of the trunk's joints, ``(F, J, 4)``, in the order of `PlayerBody.trunk`."""
    limbs: FloatArray
    """Where arms and legs begin, ``(F, 4, 3)``, metres, in the order of `LIMBS`."""
    points: FloatArray
    """The points that the body was made with, ``(F, K, 3)``, metres."""
    elbows: FloatArray
    """Which way the elbows' hinges point, as the chest turns them, ``(F, 2, 3)``."""
    feet: FloatArray
    """Where the ankles are, metres, ``(F, 2, 3)`` or ``(2, 3)``."""
    feet_rotations: FloatArray
    """The feet's rotations in the world, ``(F, 2, 4)`` or ``(2, 4)``."""
    knees: FloatArray
    """Which way the knees' hinges point, ``(F, 2, 3)`` or ``(2, 3)``."""
    turns: FloatArray
    """What `body_matrix` turns beside the joints, ``(F, len(turns), 4)``."""
    shifts: FloatArray
    """What it shifts beside the hips, metres, ``(F, len(shifts), 3)``."""


class PlayerBody:
    """Solves a body in two steps: `stand` by the gestures, then `reach` with the hands.

    Args:
        rig: The player's rig: a VRM humanoid with arms and legs as ``two_bone`` chains.
        held: The playing position; in it the feet keep their places, and elbows and knees their ways.
        points: Places on the trunk whose way is asked for.
        signals: Signals beside `SIGNALS`, which `joint_turns`, `turns` and `shifts` name.
        joint_turns: As `body_matrix` takes them.
        turns: As `body_matrix` takes them.
        shifts: As `body_matrix` takes them.
        fingers: Joints that the instrument moves itself, ``(N,)``; what is not moved keeps its place in the
            hold.

    Raises:
        RigError: Something that playing needs is not in the rig.
    """

    def __init__(
        self,
        rig: Rig,
        held: HeldPose,
        *,
        points: Sequence[Point] = (),
        signals: Sequence[str] = (),
        joint_turns: Mapping[str, Mapping[str, Vector]] | None = None,
        turns: Sequence[Mapping[str, Vector]] = (),
        shifts: Sequence[Mapping[str, Vector]] = (),
        fingers: IntArray | None = None,
    ) -> None:
        skeleton = rig.skeleton
        world = held.world
        self.trunk = tuple(name for name in TRUNK if name in skeleton)
        """Joints that gestures turn, parents first."""
        eyes = [name for name in EYES if name in skeleton]
        self._limbs = TwoBoneLimbs(rig, LIMBS)
        joints = self._limbs.joints
        uppers = [
            Point(LIMBS[k], int(skeleton.parents[upper]), skeleton.rest_translations[upper])
            for k, upper in enumerate(joints[:, 0].tolist())
        ]
        # Which way elbows and knees point: as in the hold; elbows turn with the chest, knees do not.
        hinges = rotate(world[joints[:, 0]], self._limbs.hinge)
        self._knees = hinges[2:]
        chest = int(skeleton.parents[skeleton.index("neck" if "neck" in self.trunk else "head")])
        elbows = [Point("elbow", chest, elbow) for elbow in rotate(conjugate(world[chest]), hinges[:2])]
        self._trunk = Trunk(rig, self.trunk, [*uppers, *points], elbows)
        turned: IntArray = np.array([skeleton.index(name) for name in (*self.trunk, *eyes)], dtype=np.intp)
        self._held: FloatArray = held.rotations[turned]
        self._signals = (*SIGNALS, *signals)
        self._matrix = body_matrix(
            rig, [*self.trunk, *eyes], self._signals, joint_turns=joint_turns, turns=turns, shifts=shifts
        )
        self._hips = len(turned) + len(turns)
        """Which of the matrix's columns is the hips'."""
        self._eyes = slice(len(self.trunk), len(turned)) if eyes else None
        self._sight = _sight(rig, eyes)
        self._root = held.root

        feet = joints[2:, 2]
        self.arm_reach: FloatArray = self._limbs.reach[:2]
        """From shoulder to wrist at most, left and right, metres, ``(2,)``."""
        self._leg_reach: FloatArray = self._limbs.reach[2:] - SOFT_KNEE_M
        self._feet_rotations, self._feet_positions = world[feet], held.positions[feet]
        self._limb_parents = [
            self._carrier(rig, int(skeleton.parents[upper])) for upper in joints[:, 0].tolist()
        ]
        self._twists = TwistHelpers(rig)
        own = np.zeros(0, dtype=np.intp) if fingers is None else fingers
        self.moving: IntArray = np.concatenate([turned, *joints.T, own, self._twists.joints])
        """Indices of the joints that move, ``(M,)``."""
        place = {joint: index for index, joint in enumerate(self.moving.tolist())}
        lost = [joint for joint in self._twists.sources.tolist() if joint not in place]
        if lost:
            raise RigError(
                f"a twist follows {skeleton.names[lost[0]]!r}, which never moves", location="twists"
            )
        self._twist_sources = np.array(
            [place[joint] for joint in self._twists.sources.tolist()], dtype=np.intp
        )
        self._moving_rest: FloatArray = skeleton.rest_rotations[self.moving]
        self.still: FloatArray = same_hemisphere(held.rotations, skeleton.rest_rotations)
        """All joints' local rotations in the hold, ``(J, 4)``."""

    def _drop(self, legs: FloatArray, feet: FloatArray) -> FloatArray:
        """How far the hips must sink for both legs to reach their feet, ``(F,)``, metres.

        Args:
            legs: Where the legs begin, ``(F, 2, 3)``.
            feet: Where they end, ``(F, 2, 3)`` or ``(2, 3)``.
        """
        apart = legs - feet
        across = apart[..., 0] * apart[..., 0] + apart[..., 2] * apart[..., 2]
        needed = apart[..., 1] - np.sqrt(np.maximum(self._leg_reach * self._leg_reach - across, 0.0))
        needed = np.maximum(needed[:, 0], needed[:, 1])
        # max(needed, 0), its corner rounded by a parabola so that nothing starts with a jolt.
        corner = np.minimum(np.maximum(needed, -SOFT_KNEE_M), SOFT_KNEE_M) + SOFT_KNEE_M
        return corner * corner * (0.25 / SOFT_KNEE_M) + np.maximum(needed - SOFT_KNEE_M, 0.0)

    def _carrier(self, rig: Rig, joint: int) -> int:
        found = np.flatnonzero(self._trunk.joints == joint)
        if len(found) == 0:
            raise RigError(
                f"{rig.skeleton.names[joint]!r} must be one of {', '.join(TRUNK)}", location="joints"
            )
        return int(found[0])

    def stand(self, signals: Mapping[str, FloatArray], stance: FloatArray | None = None) -> Standing:
        """Turn trunk and eyes, and keep both feet within reach.

        Args:
            signals: By name, ``(F,)`` each: `SIGNALS`, and those that the body was made with.
            stance: What a way of standing turns the trunk by, under everything else, and shifts the hips,
                ``(F, trunk joints + 1, 3)``; six rows more where it takes the feet along; as
                `Stances.evaluate` gives it.
        """
        rows = stacked(signals, self._signals)
        moved = product(rows.T, self._matrix).reshape(rows.shape[1], -1, 3)
        hips = self._root + moved[:, self._hips]
        if stance is None:
            turns = exp(moved[:, : self._hips])
        else:
            # One exponential for both.
            turns = exp(np.concatenate([moved[:, : self._hips], stance[:, : len(self.trunk)]], axis=1))
            hips += stance[:, len(self.trunk)]
        count = len(self._held)
        if self._eyes is not None:
            turns[:, self._eyes] = _glance(moved[:, self._eyes.start], self._sight)[:, None]
        base = self._held
        if stance is not None:
            trunk = len(self.trunk)
            base = np.repeat(base[None], len(hips), axis=0)
            base[:, :trunk] = multiply(self._held[:trunk], turns[:, self._hips :])
        local = multiply(base, turns[:, :count])
        world, points, elbows = self._trunk.solve(local[:, : len(self.trunk)], hips)
        feet, feet_rotations, knees = self._feet_positions, self._feet_rotations, self._knees
        if stance is not None and stance.shape[1] > len(self.trunk) + 1:
            legs = stance[:, len(self.trunk) + 1 :]
            feet = feet + legs[:, :2]
            feet_rotations = multiply(exp(legs[:, 2:4]), feet_rotations)
            knees = knees + legs[:, 4:]
        drop = self._drop(points[:, 2:4], feet)
        hips[:, 1] -= drop
        points[..., 1] -= drop[:, None]
        return Standing(
            local=local,
            hips=hips,
            world=world,
            limbs=points[:, :4],
            points=points[:, 4:],
            elbows=elbows,
            feet=feet,
            feet_rotations=feet_rotations,
            knees=knees,
            turns=turns[:, count : self._hips],
            shifts=moved[:, self._hips + 1 :],
        )

    def reach(
        self,
        standing: Standing,
        hand_positions: FloatArray,
        hand_rotations: FloatArray,
        *,
        elbows: FloatArray | None = None,
        fingers: Sequence[FloatArray] = (),
    ) -> FloatArray:
        """Bring the hands to their places; the feet are at theirs.

        Args:
            standing: What `stand` gave.
            hand_positions: Left and right, in the world, metres, ``(F, 2, 3)``.
            hand_rotations: In the world, ``(F, 2, 4)``.
            elbows: Which way the elbows' hinges point, ``(F, 2, 3)``; as `standing` has it by default.
            fingers: Local rotations of the joints that the instrument moves itself, ``(F, n, 4)`` each, in
                the order of the body's `fingers`.

        Returns:
            Local rotations, rest included, of the joints `moving`, ``(F, M, 4)``; others hold still.
        """
        frames = len(standing.hips)
        targets = np.empty((frames, 4, 3))
        targets[:, :2] = hand_positions
        targets[:, 2:] = standing.feet
        hinges = np.empty((frames, 4, 3))
        hinges[:, :2] = standing.elbows if elbows is None else elbows
        hinges[:, 2:] = standing.knees
        limbs = self._limbs.solve(standing.limbs, targets, hinges)

        outer = np.empty((frames, 8, 4))  # world rotations: uppers, then ends
        outer[:, :4] = limbs.upper
        outer[:, 4:6] = hand_rotations
        outer[:, 6:] = standing.feet_rotations
        inner = np.empty((frames, 8, 4))  # what each of them hangs on
        inner[:, :4] = standing.world[:, self._limb_parents]
        inner[:, 4:] = multiply(limbs.upper, limbs.lower_local)
        ends = multiply(conjugate(inner), outer)

        turned = standing.local.shape[1]
        helpers = len(self.moving) - len(self._twist_sources)
        moving = np.empty((frames, len(self.moving), 4))
        moving[:, :turned] = standing.local
        moving[:, turned : turned + 4] = ends[:, :4]
        moving[:, turned + 4 : turned + 8] = limbs.lower_local
        moving[:, turned + 8 : turned + 12] = ends[:, 4:]
        begin = turned + 12
        for rotations in fingers:
            moving[:, begin : begin + rotations.shape[1]] = rotations
            begin += rotations.shape[1]
        moving[:, helpers:] = self._twists.solve(moving[:, self._twist_sources])
        return same_hemisphere(moving, self._moving_rest)


def _sight(rig: Rig, eyes: Sequence[str]) -> FloatArray:
    """How far the eyes turn about x and y, from and to, ``(2, 2)``, radians."""
    sight = np.array([[-np.pi, -np.pi], [np.pi, np.pi]])
    for name in eyes:
        limits = rig.limits.get(rig.skeleton.index(name))
        if limits is not None:
            sight[0] = np.maximum(sight[0], limits.minimum[:2])
            sight[1] = np.minimum(sight[1], limits.maximum[:2])
    return sight


def _glance(turn: FloatArray, sight: FloatArray) -> FloatArray:
    """Eyes turned to the side, then up or down: Ry Rx ``(F, 4)`` of turns ``(F, 3)``; they never roll."""
    half = 0.5 * np.minimum(np.maximum(turn[:, :2], sight[0]), sight[1])
    up, side = np.sin(half[:, 0]), np.sin(half[:, 1])
    level, ahead = np.cos(half[:, 0]), np.cos(half[:, 1])
    q = np.empty((len(turn), 4))
    q[:, 0], q[:, 1], q[:, 2], q[:, 3] = ahead * up, side * level, -side * up, ahead * level
    return q
