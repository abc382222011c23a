"""A brass player's body: the horn goes with the mouth, hands with the horn, fingers with the valves."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.instruments.brass.mute import Mute
from reina.instruments.brass.pressing_fingers import PressingFingers
from reina.instruments.brass.slide_finger import SLIDE_FINGERS, YIELDING_M, SlideFinger
from reina.instruments.player.body import LIMBS, PlayerBody
from reina.instruments.player.held_pose import HeldPose
from reina.instruments.player.instrument_body import BodyFrames
from reina.instruments.player.rows import joined, joined_rows
from reina.rotations import conjugate, dot, from_axis_angle, multiply, product, rotate
from reina.skeleton import RigError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.player.body_table import Vector
    from reina.instruments.player.engagement import Engagement
    from reina.instruments.player.instrument_body import BodyMotion, Float32Array
    from reina.kinematics import MotionCurves
    from reina.rotations.arrays import FloatArray, IntArray

INSTRUMENT_TURNS: dict[str, Vector] = {
    "breath": (-0.010, 0.0, 0.0),
    "sway_fore": (-0.008, 0.0, 0.0),
    "lean": (0.014, 0.0, 0.0),
    "effort": (-0.026, 0.0, 0.0),
}
"""Signal -> turn of the instrument about the lips, radians, as `body_table.TURNS`."""

HAND_SHIFTS: dict[str, Vector] = {"vibrato": (0.0, 0.0, 0.0008)}
"""Signal -> shift of the right hand along the instrument, metres, in the instrument's frame."""

VIBRATO_HZ = 5.4

LOWERED_RAD = 0.85
"""How far arms and instrument are turned down about the line of the shoulders in long rests."""

ELBOWS_OUT_RAD = np.array([0.7, -0.2])
"""How far the elbows then swing out about the line from shoulder to wrist, left and right."""


class BrassBody:
    """Solves whole poses of a player and a valved brass instrument.

    Args:
        engagement: Who plays: the player's rig has a contact ``lips``, the instrument's one joint, a contact
            ``mouthpiece`` and buttons. In the hold hands and feet keep their places.
        curves: What is planned: ``valve/n`` and ``lift/n``, ``slide/n``, ``vibrato``.
        valve_count: How many valves the instrument has.
        streamed: Names of the curves that are streamed.

    Raises:
        RigError: Something that playing needs is not in the rigs.
    """

    def __init__(
        self, engagement: Engagement, curves: MotionCurves, valve_count: int, streamed: tuple[str, ...]
    ) -> None:
        rig, horn = engagement.player_rig, engagement.instrument_rig
        held = HeldPose(rig, engagement.hold)
        # Hands keep their place in the instrument's frame, feet in the world.
        hands = np.array([rig.chain(arm).joints[-1] for arm in LIMBS[:2]], dtype=np.intp)
        hand_positions, hand_rotations = held.in_instrument(hands)
        self._held_places = np.stack([horn.contact("mouthpiece").offset, *hand_positions])
        self._fingers = PressingFingers(rig, horn, int(hands[1]), hand_positions[1], hand_rotations[1])
        to_hand = conjugate(hand_rotations[0])
        slides = {
            slide: SlideFinger(
                rig,
                chain,
                rotate(to_hand, horn.contact(ring).offset - hand_positions[0]),
                rotate(to_hand, part.travel),
                rotate(to_hand, YIELDING_M),
                held.rotations,
            )
            for slide, (chain, ring) in SLIDE_FINGERS.items()
            for part in horn.parts
            if part.parameter.endswith(f"/{slide}") and part.travel is not None and chain in rig.chains
        }
        self._slides = [(curves.names.index(slide), finger) for slide, finger in slides.items()]
        self._body = PlayerBody(
            rig,
            held,
            points=[rig.contact("lips")],
            signals=tuple(HAND_SHIFTS),
            turns=(INSTRUMENT_TURNS,),
            shifts=(HAND_SHIFTS,),
            fingers=np.concatenate(
                [self._fingers.chains.joints.ravel(), *(finger.joints for finger in slides.values())]
            ),
        )
        # The instrument rides on the head, its mouthpiece on the lips.
        self._head = self._body.trunk.index("head")
        head = held.world[rig.skeleton.index("head")]
        in_head = multiply(conjugate(head), held.instrument_rotation)
        # A product with what stays the same is linear: a matrix for rows of quaternions.
        self._head_to_instrument: FloatArray = multiply(np.eye(4), in_head)
        self._instrument_to_hands: FloatArray = np.concatenate(
            [multiply(np.eye(4), hand) for hand in hand_rotations], axis=1
        )

        pressed = [button.valve for button in horn.buttons]
        if max(pressed, default=0) > valve_count:
            raise RigError(
                f"{horn.name!r} has a button for valve {max(pressed)}; there are {valve_count} valves",
                location="buttons",
            )
        self._valve_rows: IntArray = curves.index([f"valve/{valve}" for valve in pressed])
        self._lift_rows: IntArray = curves.index([f"lift/{valve}" for valve in pressed])
        self._streamed_rows: IntArray = curves.index(streamed)
        self._vibrato = curves.names.index("vibrato")
        self._mute = Mute(engagement.score, engagement.played.line, engagement.registry, engagement.prefix)
        self.figure = (rig, horn, engagement.hold, curves.names)
        """What a pose depends on beside the motion; rigs and holds are equal to themselves alone."""
        # What moves is written first, then the instrument, then what holds still; then all is put in order.
        moving, joints = self._body.moving, len(self._body.still)
        still = np.setdiff1d(np.arange(joints), moving)
        self._still = self._body.still[still].astype(np.float32)
        self._order: IntArray = np.argsort(np.concatenate([moving, [joints], still]))

    def solve(self, motion: BodyMotion) -> BodyFrames:
        """The poses of F frames."""
        (rotations,), (roots,) = self.pose([motion])
        return BodyFrames(rotations, roots, self.parameters(motion))

    def parameters(self, motion: BodyMotion) -> FloatArray:
        """What it streams of the instrument, ``(F, P)``."""
        mute = self._mute.evaluate(motion.times_s, motion.shown)[:, None]
        return np.concatenate([motion.curves[self._streamed_rows].T, mute], axis=1)

    def pose(self, motions: Sequence[BodyMotion]) -> tuple[Float32Array, FloatArray]:
        """The poses of K bodies that are like this one, F frames each, solved as one of K F frames.

        Args:
            motions: One a body; all with a stance of as many rows, or none.

        Returns:
            Local rotations ``(K, F, J, 4)`` and root positions ``(K, F, 2, 3)``.
        """
        count, frames = len(motions), len(motions[0].times_s)
        curves = joined([motion.curves for motion in motions], axis=1)
        times = joined([motion.times_s for motion in motions])
        vibrato = curves[self._vibrato] * np.sin((2.0 * np.pi * VIBRATO_HZ) * times)
        signals = {
            **joined_rows([motion.signals for motion in motions]),
            "vibrato": vibrato * joined([motion.amounts["vibrato"] for motion in motions]),
        }
        stances = [motion.stance for motion in motions if motion.stance is not None]
        standing = self._body.stand(signals, joined(stances) if stances else None)
        shifts = standing.shifts[:, 0]
        instrument = product(standing.world[:, self._head], self._head_to_instrument)
        instrument = multiply(instrument, standing.turns[:, 0])
        # In the instrument's frame: its mouthpiece, and the hands that hold it.
        held = np.empty((count * frames, 3, 3))
        held[:] = self._held_places
        held[:, 2] += shifts
        held = rotate(instrument[:, None], held)
        held[:, 0] = standing.points[:, 0] - held[:, 0]
        held[:, 1:] += held[:, :1]
        elbows = standing.elbows
        lowered = joined([motion.lowered for motion in motions])
        down = np.flatnonzero(lowered)
        if len(down):
            instrument[down], held[down], elbows[down] = _lower(
                lowered[down], standing.limbs[down, :2], instrument[down], held[down], elbows[down]
            )
        valves = curves[self._valve_rows].T
        lifts = (curves[self._lift_rows] * joined([motion.amounts["finger_lift"] for motion in motions])).T
        fingers = self._fingers.solve(valves, lifts, shifts)
        moving = self._body.reach(
            standing,
            held[:, 1:],
            product(instrument, self._instrument_to_hands).reshape(count * frames, 2, 4),
            elbows=elbows,
            fingers=[
                fingers.reshape(count * frames, -1, 4),
                *(
                    joined([finger.solve(motion.curves[row]) for motion in motions])
                    for row, finger in self._slides
                ),
            ],
        )
        rotations = np.empty((count * frames, len(self._order), 4), dtype=np.float32)
        moved = moving.shape[1]
        rotations[:, :moved] = moving
        rotations[:, moved] = instrument * np.where(instrument[:, 3:] < 0.0, -1.0, 1.0)
        rotations[:, moved + 1 :] = self._still
        rotations = rotations.take(self._order, axis=1)
        roots = np.empty((count * frames, 2, 3))
        roots[:, 0], roots[:, 1] = standing.hips, held[:, 0]
        return rotations.reshape(count, frames, -1, 4), roots.reshape(count, frames, 2, 3)


def _lower(
    lowered: FloatArray, shoulders: FloatArray, instrument: FloatArray, held: FloatArray, elbows: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Turn instrument, hands and elbows down about the line of the shoulders: arms keep their shape."""
    left, right = shoulders[:, 0], shoulders[:, 1]
    axis = left - right
    axis = axis / np.sqrt(dot(axis, axis))[:, None]
    down = from_axis_angle(axis, LOWERED_RAD * lowered)
    pivot = (0.5 * (left + right))[:, None]
    held = pivot + rotate(down[:, None], held - pivot)
    arms = held[:, 1:] - shoulders
    arms = arms / np.sqrt(dot(arms, arms))[..., None]
    out = from_axis_angle(arms, ELBOWS_OUT_RAD * lowered[:, None])
    return multiply(down, instrument), held, rotate(multiply(out, down[:, None]), elbows)
