"""The whole player: gestures turn the trunk, the horn goes with the mouth, hands with the horn, feet stay."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.kinematics import TwistHelpers, TwoBoneLimbs
from reina.performance.body_table import EYES, TRUNK, body_matrix
from reina.performance.hands_on_instrument import PressingFingers
from reina.performance.slide_finger import SLIDE_FINGERS, YIELDING_M, SlideFinger
from reina.performance.trunk import Trunk
from reina.rotations import (
    conjugate,
    dot,
    exp,
    from_axis_angle,
    multiply,
    rotate,
    same_hemisphere,
)
from reina.skeleton import Point, RigError, forward_kinematics

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from reina.rotations.arrays import FloatArray, IntArray
    from reina.skeleton import Hold, Rig

LIMBS: tuple[str, ...] = ("leftArm", "rightArm", "leftLeg", "rightLeg")
SOFT_KNEE_M = 0.001
"""No leg comes nearer to being straight than this; the hips sink instead, beginning twice as far before."""

LOWERED_RAD = 0.85
"""How far arms and instrument are turned down about the line of the shoulders in long rests."""

ELBOWS_OUT_RAD = np.array([0.7, -0.2])
"""How far the elbows then swing out about the line from shoulder to wrist, left and right."""


@dataclass(frozen=True, eq=False)
class Pose:
    """F frames of player and instrument."""

    moving: FloatArray
    """Local rotations, rest included, of the joints `PlayerBody.moving`, ``(F, M, 4)``; others hold still."""
    root_positions: FloatArray
    """The player's hips, metres, ``(F, 3)``."""
    instrument_rotations: FloatArray
    """``(F, 4)``."""
    instrument_positions: FloatArray
    """Metres, ``(F, 3)``."""
    reached: bool
    """Whether every hand, foot and finger is where it is meant to be."""


class PlayerBody:
    """Solves whole poses.

    Args:
        rig: The player's rig: a VRM humanoid with arms and legs as ``two_bone`` chains and a contact
            ``lips``.
        instrument_rig: One joint, a contact ``mouthpiece``, buttons.
        hold: The playing position; in it hands and feet keep their places.

    Raises:
        RigError: Something that playing needs is not in the rigs.
    """

    def __init__(self, rig: Rig, instrument_rig: Rig, hold: Hold) -> None:
        skeleton = rig.skeleton
        self.rig, self.hold = rig, hold
        rotations = hold.rotations(rig)
        root = skeleton.rest_translations[0] if hold.hips_position is None else hold.hips_position
        positions, world = forward_kinematics(skeleton, rotations, root)
        trunk = [name for name in TRUNK if name in skeleton]
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
        chest = int(skeleton.parents[skeleton.index("neck" if "neck" in trunk else "head")])
        elbows = [Point("elbow", chest, elbow) for elbow in rotate(conjugate(world[chest]), hinges[:2])]
        self._trunk = Trunk(rig, trunk, [*uppers, rig.contact("lips")], elbows)
        self._turned: IntArray = np.array([skeleton.index(name) for name in (*trunk, *eyes)], dtype=np.intp)
        self._held: FloatArray = rotations[self._turned]
        self._matrix = body_matrix(rig, [*trunk, *eyes])
        self._eyes = slice(len(trunk), len(trunk) + len(eyes)) if eyes else None
        self._sight = _sight(rig, eyes)
        self._root = root
        self._head = trunk.index("head")

        # The instrument rides on the head, its mouthpiece on the lips.
        I_world, X_world = hold.instrument_rotation, hold.instrument_position
        head = skeleton.index("head")
        self._instrument_in_head = multiply(conjugate(world[head]), I_world)
        mouthpiece = instrument_rig.contact("mouthpiece").offset

        # Hands keep their place in the instrument's frame, feet in the world.
        hands, feet = joints[:2, 2], joints[2:, 2]
        self._hand_rotations = multiply(conjugate(I_world), world[hands])
        hand_positions = rotate(conjugate(I_world), positions[hands] - X_world)
        self._held_places = np.stack([mouthpiece, *hand_positions])
        self._leg_reach: FloatArray = self._limbs.reach[2:] - SOFT_KNEE_M
        self._feet_rotations, self._feet_positions = world[feet], positions[feet]
        self._limb_parents = [
            self._carrier(rig, int(skeleton.parents[upper])) for upper in joints[:, 0].tolist()
        ]

        right = int(hands[1])
        self._fingers = PressingFingers(
            rig, instrument_rig, right, hand_positions[1], self._hand_rotations[1]
        )
        to_hand = conjugate(self._hand_rotations[0])
        self._slides = {
            slide: SlideFinger(
                rig,
                chain,
                rotate(to_hand, instrument_rig.contact(ring).offset - hand_positions[0]),
                rotate(to_hand, part.travel),
                rotate(to_hand, YIELDING_M),
                rotations,
            )
            for slide, (chain, ring) in SLIDE_FINGERS.items()
            for part in instrument_rig.parts
            if part.parameter.endswith(f"/{slide}") and part.travel is not None and chain in rig.chains
        }
        self._twists = TwistHelpers(rig)
        self.held: FloatArray = same_hemisphere(rotations, skeleton.rest_rotations)
        """All joints' local rotations in the hold, ``(J, 4)``."""
        fingers = self._fingers.chains.joints
        self.moving: IntArray = np.concatenate(
            [
                self._turned,
                *joints.T,
                fingers.ravel(),
                *(finger.joints for finger in self._slides.values()),
                self._twists.joints,
            ]
        )
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

    def _drop(self, legs: FloatArray) -> FloatArray:
        """How far the hips must sink for both legs to reach their feet, ``(F,)``, metres.

        Args:
            legs: Where the legs begin, ``(F, 2, 3)``.
        """
        apart = legs - self._feet_positions
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

    def solve(
        self,
        signals: FloatArray,
        lowered: FloatArray,
        valves: FloatArray,
        lifts: FloatArray,
        slides: Mapping[str, FloatArray],
        stance: FloatArray | None = None,
    ) -> Pose:
        """Poses for a block.

        Args:
            signals: ``(len(body_table.SIGNALS), F)``.
            lowered: How far the instrument is taken down, 0..1, ``(F,)``.
            valves: How far down each valve is, ``(F, V)``.
            lifts: How far each valve's finger is off its cap, ``(F, V)``.
            slides: How far out each slide of `SLIDE_FINGERS` is, 0..1, ``(F,)``; one that is missing is in.
            stance: What a way of standing turns the trunk by, under everything else, and shifts the hips,
                ``(F, trunk joints + 1, 3)``, as `Stances.evaluate` gives it.
        """
        moved = (signals.T @ self._matrix).reshape(signals.shape[1], -1, 3)
        hips = self._root + moved[:, -2]
        if stance is None:
            turns = exp(moved[:, :-2])
        else:
            # One exponential for both.
            turns = exp(np.concatenate([moved[:, :-2], stance[:, :-1]], axis=1))
            hips += stance[:, -1]
        count = len(self._held)
        if self._eyes is not None:
            turns[:, self._eyes] = _glance(moved[:, self._eyes.start], self._sight)[:, None]
        base = self._held
        if stance is not None:
            trunk = stance.shape[1] - 1
            base = np.repeat(base[None], len(hips), axis=0)
            base[:, :trunk] = multiply(self._held[:trunk], turns[:, count + 1 :])
        local = multiply(base, turns[:, :count])
        shifts = moved[:, -1]
        world, points, elbows = self._trunk.solve(local[:, : len(self._trunk.joints)], hips)
        drop = self._drop(points[:, 2:4])
        hips[:, 1] -= drop
        points[..., 1] -= drop[:, None]

        instrument = multiply(multiply(world[:, self._head], self._instrument_in_head), turns[:, count])
        # In the instrument's frame: its mouthpiece, and the hands that hold it.
        frames = len(hips)
        held = np.empty((frames, 3, 3))
        held[:] = self._held_places
        held[:, 2] += shifts
        held = rotate(instrument[:, None], held)
        held[:, 0] = points[:, 4] - held[:, 0]
        held[:, 1:] += held[:, :1]
        if lowered.any():
            instrument, held, elbows = _lower(lowered, points, instrument, held, elbows)

        targets = np.empty((frames, 4, 3))
        targets[:, :2] = held[:, 1:]
        targets[:, 2:] = self._feet_positions
        hinges = np.empty((frames, 4, 3))
        hinges[:, :2] = elbows
        hinges[:, 2:] = self._knees
        limbs = self._limbs.solve(points[:, :4], targets, hinges)

        outer = np.empty((frames, 8, 4))  # world rotations: uppers, then ends
        outer[:, :4] = limbs.upper
        outer[:, 4:6] = multiply(instrument[:, None], self._hand_rotations)
        outer[:, 6:] = self._feet_rotations
        inner = np.empty((frames, 8, 4))  # what each of them hangs on
        inner[:, :4] = world[:, self._limb_parents]
        inner[:, 4:] = multiply(limbs.upper, limbs.lower_local)
        ends = multiply(conjugate(inner), outer)

        used = self._fingers.valves
        fingers, status = self._fingers.solve(valves[:, used], lifts[:, used], shifts)

        turned = local.shape[1]
        helpers = len(self.moving) - len(self._twist_sources)
        moving = np.empty((frames, len(self.moving), 4))
        moving[:, :turned] = local
        moving[:, turned : turned + 4] = ends[:, :4]
        moving[:, turned + 4 : turned + 8] = limbs.lower_local
        moving[:, turned + 8 : turned + 12] = ends[:, 4:]
        pressing = turned + 12 + len(used) * 3
        moving[:, turned + 12 : pressing] = fingers.reshape(frames, -1, 4)
        for index, (name, finger) in enumerate(self._slides.items()):
            out = slides.get(name)
            begin = pressing + 3 * index
            moving[:, begin : begin + 3] = finger.held if out is None else finger.solve(out)
        moving[:, helpers:] = self._twists.solve(moving[:, self._twist_sources])
        return Pose(
            moving=same_hemisphere(moving, self._moving_rest),
            root_positions=hips,
            instrument_rotations=instrument * np.where(instrument[:, 3:] < 0.0, -1.0, 1.0),
            instrument_positions=held[:, 0],
            reached=not (limbs.status.any() or status.any()),
        )


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
    return np.stack([ahead * up, side * level, -side * up, ahead * level], axis=-1)


def _lower(
    lowered: FloatArray, points: FloatArray, instrument: FloatArray, held: FloatArray, elbows: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Turn instrument, hands and elbows down about the line of the shoulders: arms keep their shape."""
    left, right = points[:, 0], points[:, 1]
    axis = left - right
    axis = axis / np.sqrt(dot(axis, axis))[:, None]
    down = from_axis_angle(axis, LOWERED_RAD * lowered)
    pivot = (0.5 * (left + right))[:, None]
    held = pivot + rotate(down[:, None], held - pivot)
    arms = held[:, 1:] - points[:, :2]
    arms = arms / np.sqrt(dot(arms, arms))[..., None]
    out = from_axis_angle(arms, ELBOWS_OUT_RAD * lowered[:, None])
    return multiply(down, instrument), held, rotate(multiply(out, down[:, None]), elbows)
