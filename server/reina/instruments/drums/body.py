"""A drummer's body: sticks go where the strokes ask, arms follow by iteration, and the trunk helps."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from reina.instruments.drums.drum_part import drum_fingering
from reina.instruments.drums.motion.drummer_motion import DrummerMotion
from reina.instruments.drums.motion.kit_pose import HI_HAT, KitPose, kit_places, part_travel
from reina.instruments.drums.motion.looks import plan_looks
from reina.instruments.drums.motion.nods import nods
from reina.instruments.drums.stick_ways import OWN_SIDES, at_arms_length, from_elbows, nearest_m
from reina.instruments.player.body import LIMBS, PlayerBody
from reina.instruments.player.body_table import SIGNALS
from reina.instruments.player.held_pose import HeldPose
from reina.instruments.player.instrument_body import BodyFrames
from reina.instruments.player.trunk_reach import SHOULDERS, reach_out
from reina.instruments.player.trunk_reach import SIGNALS as REACHING
from reina.kinematics import TwoBoneLimbs
from reina.kinematics.sampled_curves import SampledCurves
from reina.kinematics.tool_arms import Tool, ToolArms, WristRange
from reina.rotations import conjugate, cross, multiply, rotate
from reina.skeleton import RigError, forward_kinematics

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.drums.hit import DrumHit
    from reina.instruments.drums.motion.kit_places import KitPlaces
    from reina.instruments.player.body import Standing
    from reina.instruments.player.engagement import Engagement
    from reina.instruments.player.instrument_body import BodyMotion
    from reina.rotations.arrays import FloatArray
    from reina.skeleton import Rig

SIDES = ("left", "right")
KIT = "drums"
"""The name of the kit's skeleton."""
STICKS = ("left_stick", "right_stick")
"""The names of the sticks' skeletons."""

DORSAL = np.array([[0.08, 1.0, -0.15], [-0.08, 1.0, -0.15]])
"""Where the backs of the hands look: up, a little out and back."""
ELBOWS = np.array([[0.45, -1.0, 0.0], [-0.45, -1.0, 0.0]])
"""Where elbows point where an arm is stretched as `STRETCHED` says: down and out."""
STRETCHED = np.array([[0.12, 0.0, 0.9], [-0.12, 0.0, 0.9]])
FOLDED_M, ASIDE = (0.3, 0.15), np.array([[1.2, 0.0, 0.0], [-1.2, 0.0, 0.0]])
"""A wrist nearer to its shoulder than the first sends the elbow aside, wholly so at the second less."""
WRIST_M = 0.34
"""About from the tip of a stick to the wrist behind it."""
RAISED_M, RAISED_OUT = (0.95, 0.25), 1.0
"""Where a tip is higher than the first, elbows point outward, so many times more at the second above that."""
ASIDE_M = (0.12, 0.2)
"""But only farther to their own side than the first, wholly so at the second beyond it."""
FLEXION_RAD = (np.radians(-52.0), np.radians(46.0))
DEVIATION_RAD = np.radians([[-27.0, 6.0], [-6.0, 27.0]])
"""How far wrists may be bent before a stick gives way."""

SEATED, SWAYING = 0.35, ("sway_side", "sway_fore", "sway_turn", "lean", "turn")
"""How much of what turns who stands is left for who sits."""
PLANNED_HZ = 10.0
"""How often a second it is worked out how the trunk stands."""
SAMPLED_HZ = 40.0
SMOOTHING_S = 0.8
"""The trunk follows where the hands are over this long."""
HEAD_TURNED_TO = 0.4
"""How much of the way to the middle of both hands the head turns beyond the trunk."""
HEAD: tuple[str, ...] = ("head_turn", "head_bow", "eyes_left", "eyes_up")
PLANNED = (*REACHING, "head_turn", "nod", "bounce", "look_left", "look_down", "eyes_left", "eyes_up")
"""What is worked out for the whole piece."""
NOD_RAD, BOUNCE_RAD, FIRST_S = 0.115, 0.028, 0.04
"""How far head and trunk go with the beat at most, and how much earlier the trunk does."""
LOOK_HEAD, LOOK_EYES = (0.5, 0.22), (0.35, 0.3)
"""Which part of the way to a piece head and eyes turn, aside and down."""
KIT_EYES_RAD = 0.16
"""How far the eyes look down to the kit otherwise."""
BAND_HEAD, BAND_UP_RAD = 0.8, 0.05
"""Which part of the way to the one who is looked at the head turns, and how far it comes up."""
HEEL_RAD, HELD_HEEL = 0.26, 0.4
"""How far a heel goes from down to up, and where on that way it is in the hold."""


class DrumsBody:
    """Solves whole poses of a drummer, the kit and the sticks.

    Args:
        engagement: Who plays a `DrumPart`; the hold has attachments `STICKS`, the kit zones and contacts
            ``leftPedal`` and ``rightPedal``.

    Raises:
        RigError: Something that playing needs is not in the rigs.
    """

    def __init__(self, engagement: Engagement) -> None:
        rig, kit = engagement.player_rig, engagement.instrument_rigs[KIT]
        held = HeldPose(rig, engagement.hold)
        beats = np.arange(int(np.ceil(engagement.score.tempo_map.beats(engagement.score.duration_s))) + 1)
        self._beats: FloatArray = engagement.score.tempo_map.seconds(beats.astype(np.float64))
        fingering, places = drum_fingering(engagement.played), kit_places(kit)
        self._nearest = nearest_m(fingering.hits, places)
        self._motion = DrummerMotion(
            fingering,
            places,
            beats_s=self._beats,
            hi_hat_travel=part_travel(kit, HI_HAT),
        )
        self._kit = KitPose(kit)
        self._body = PlayerBody(rig, held, signals=tuple(SHOULDERS), joint_turns=SHOULDERS)
        self._attached = self._attachments(engagement)
        self._arms = self._tool_arms(engagement, TwoBoneLimbs(rig, LIMBS[:2]))
        self._chest = self._body.trunk.index("upperChest" if "upperChest" in self._body.trunk else "chest")
        chest = held.world[rig.skeleton.index(self._body.trunk[self._chest])]
        ahead = STRETCHED / np.linalg.norm(STRETCHED, axis=1)[:, None]
        outward = ELBOWS * [RAISED_OUT, 0.0, 0.0]
        self._ahead: FloatArray = rotate(conjugate(chest), ahead)
        self._poles, self._outward = (
            rotate(conjugate(chest), way - ahead * np.einsum("ki,ki->k", way, ahead)[:, None])
            for way in (ELBOWS, outward)
        )
        self._feet = _Feet(rig, kit, held)
        sticks = [engagement.instrument_rigs[name].skeleton.rest_rotations for name in STICKS]
        self._still = np.concatenate([self._body.still, kit.skeleton.rest_rotations, *sticks]).astype(
            np.float32
        )
        self._gestures = self._plan_gestures(engagement, fingering.hits, places, held)

    def _attachments(self, engagement: Engagement) -> FloatArray:
        lost = [name for name in STICKS if name not in engagement.hold.attachments]
        if lost:
            raise RigError(f"the hold carries no {lost[0]!r}", location="attachments")
        return np.stack([engagement.hold.attachments[name].rotation for name in STICKS])

    def _tool_arms(self, engagement: Engagement, arms: TwoBoneLimbs) -> ToolArms:
        tools: list[Tool] = []
        for name, side in zip(STICKS, SIDES, strict=True):
            attached = engagement.hold.attachments[name]
            tip = engagement.instrument_rigs[name].effector(f"{side}StickTip").offset
            direction = rotate(attached.rotation, np.array([0.0, 0.0, 1.0]))
            tools.append(Tool(attached.position, direction, rotate(attached.rotation, tip)))
        return ToolArms(arms, tools, DORSAL, WristRange(FLEXION_RAD, DEVIATION_RAD))

    def _plan_trunk(self, duration_s: float, pivot: FloatArray) -> FloatArray:
        """How trunk and head follow the hands, over the whole piece, `SAMPLED_HZ` times a second."""
        count = int(np.ceil((duration_s + 2.0) * SAMPLED_HZ)) + 1
        sticks = self._motion.evaluate(np.arange(count) / SAMPLED_HZ).sticks
        tips = at_arms_length(sticks.tip[:, ::-1], self._nearest)
        directions = from_elbows(tips, sticks.direction[:, ::-1])
        wrists = self._arms.wrists(tips, directions)
        reach = int(0.5 * SMOOTHING_S * SAMPLED_HZ)
        window = np.hanning(2 * reach + 3)[1:-1]
        padded = np.pad(wrists.reshape(count, -1), ((reach, reach), (0, 0)), mode="edge")
        smooth = np.stack(
            [np.convolve(column, window / window.sum(), mode="valid") for column in padded.T], axis=1
        )
        wrists = smooth[:: int(SAMPLED_HZ / PLANNED_HZ)].reshape(-1, 2, 3)
        signals = {name: np.zeros(len(wrists)) for name in (*SIGNALS, *SHOULDERS)}
        turned = reach_out(self._body, wrists, pivot, signals)
        middle = wrists.mean(axis=1) - pivot
        head = HEAD_TURNED_TO * np.arctan2(middle[:, 0], np.maximum(middle[:, 2], 0.2))
        reached = SampledCurves(np.concatenate([turned, head[:, None]], axis=1), PLANNED_HZ)
        return reached.evaluate(np.arange(count) / SAMPLED_HZ)

    def _plan_gestures(
        self, engagement: Engagement, hits: Sequence[DrumHit], places: KitPlaces, held: HeldPose
    ) -> SampledCurves:
        """All that trunk, head and eyes do, over the whole piece, in the order of `PLANNED`."""
        score, rig = engagement.score, engagement.player_rig
        reached = self._plan_trunk(score.duration_s, held.positions[rig.skeleton.index("spine")])
        count = len(reached)
        at = np.arange(count) / SAMPLED_HZ
        seat = engagement.seat
        bars = score.metre_map.bar_lines(len(self._beats) - 1.0)
        looks = plan_looks(
            count,
            SAMPLED_HZ,
            hits,
            places,
            head=held.positions[rig.skeleton.index("head")],
            bars_s=score.tempo_map.seconds(bars),
            bearings_rad=[seat.bearing_rad(other) for other in engagement.others] or [0.0],
            seed=engagement.seed,
        )
        at_kit = 1.0 - looks.band
        beyond = looks.band_left - reached[:, REACHING.index("torso_turn")]
        reached[:, -1] *= at_kit * (1.0 - 0.5 * looks.share)
        planned = [
            nods(at, hits, self._beats),
            nods(at + FIRST_S, hits, self._beats),
            at_kit * LOOK_HEAD[0] * looks.left + looks.band * BAND_HEAD * beyond,
            at_kit * LOOK_HEAD[1] * looks.down - looks.band * BAND_UP_RAD,
            at_kit * LOOK_EYES[0] * looks.left + looks.band * (1.0 - BAND_HEAD) * beyond,
            -at_kit * (LOOK_EYES[1] * looks.down + (1.0 - looks.share) * KIT_EYES_RAD),
        ]
        return SampledCurves(np.concatenate([reached, np.stack(planned, axis=1)], axis=1), SAMPLED_HZ)

    def _seated(self, stance: FloatArray | None) -> FloatArray | None:
        """What is left of a way of standing for who sits: hips stay on the stool, feet on the pedals."""
        if stance is None:
            return None
        joints = len(self._body.trunk)
        kept = SEATED * stance[:, : joints + 1]
        kept[:, [0, joints]] = 0.0
        return kept

    def _elbows(self, standing: Standing, tips: FloatArray, directions: FloatArray) -> FloatArray:
        """Which way the elbows point, ``(F, 2, 3)``: as they hang before the chest, turned with the arms.

        A fixed way would be along an arm sooner or later, and the elbow would flip over.
        """
        own = tips[..., 0] * OWN_SIDES
        raised = np.minimum(np.maximum(tips[..., 1] - RAISED_M[0], 0.0) / RAISED_M[1], 1.0)
        raised = raised * np.minimum(np.maximum(own - ASIDE_M[0], 0.0) / ASIDE_M[1], 1.0)
        poles = self._poles + raised[..., None] * self._outward
        chest = standing.world[:, self._chest, None]
        poles, ahead = rotate(chest, poles), rotate(chest, self._ahead)
        arms = tips - WRIST_M * directions - standing.limbs[:, :2]
        length = np.sqrt(np.einsum("...i,...i->...", arms, arms))
        arms = arms / length[..., None]
        # The least turn that takes ahead to the arm.
        both = ahead + arms
        along = np.einsum("...i,...i->...", arms, poles) / np.maximum(
            np.einsum("...i,...i->...", arms, both), 0.05
        )
        folded = np.minimum(np.maximum((FOLDED_M[0] - length) / FOLDED_M[1], 0.0), 1.0)
        return poles - along[..., None] * both + folded[..., None] * ASIDE

    def solve(self, motion: BodyMotion) -> BodyFrames:
        """The poses of F frames."""
        times = motion.times_s
        gestures = dict(zip(PLANNED, self._gestures.evaluate(times).T, strict=True))
        # Who sits sways from the waist; feet are on their pedals.
        signals = {
            name: SEATED * signal if name in SWAYING else signal for name, signal in motion.signals.items()
        }
        sway, gaze = motion.amounts["sway"], motion.amounts["gaze"]
        gestures["torso_bow"] = gestures["torso_bow"] + BOUNCE_RAD * sway * gestures["bounce"]
        gestures["head_turn"] = gestures["head_turn"] + gaze * gestures["look_left"]
        gestures["head_bow"] = NOD_RAD * sway * gestures["nod"] + gaze * gestures["look_down"]
        gestures["eyes_left"] = gaze * gestures["eyes_left"]
        gestures["eyes_up"] = gaze * gestures["eyes_up"]
        for name in (*REACHING, *HEAD):
            signals[name] = signals[name] + gestures[name] if name in signals else gestures[name]
        standing = self._body.stand(signals, self._seated(motion.stance))
        drummed = self._motion.evaluate(times)
        tips = at_arms_length(drummed.sticks.tip[:, ::-1], self._nearest)
        directions = from_elbows(tips, drummed.sticks.direction[:, ::-1])
        poles = self._elbows(standing, tips, directions)
        sticks = self._arms.solve(standing.limbs[:, :2], tips, directions, poles)
        kit = self._kit.rotations(drummed)
        feet, feet_rotations = self._feet.solve(kit, drummed.feet.heel[:, ::-1])
        standing = replace(standing, feet=feet, feet_rotations=feet_rotations)
        moving = self._body.reach(standing, sticks.wrists, sticks.hands, elbows=sticks.hinges)

        frames, joints = len(times), len(self._body.still)
        rotations = np.empty((frames, *self._still.shape), dtype=np.float32)
        rotations[:] = self._still
        rotations[:, self._body.moving] = moving
        rotations[:, joints:-2] = kit
        held = multiply(sticks.hands, self._attached)
        rotations[:, -2:] = held * np.where(held[..., 3:] < 0.0, -1.0, 1.0)
        roots = np.zeros((frames, 4, 3))
        roots[:, 0] = standing.hips
        roots[:, 2:] = sticks.fulcrums
        return BodyFrames(rotations, roots, self._kit.parameters(drummed))


class _Feet:
    """The balls of the feet stay on the boards of the pedals; heels go up for what is loud."""

    def __init__(self, rig: Rig, kit: Rig, held: HeldPose) -> None:
        ankles = [rig.chain(leg).joints[-1] for leg in LIMBS[2:]]
        contacts = [kit.contact(f"{side}Pedal") for side in SIDES]
        self._boards = [contact.joint for contact in contacts]
        self._offsets: FloatArray = np.stack([contact.offset for contact in contacts])
        self._hinges: FloatArray = kit.skeleton.rest_translations[self._boards]
        self._rotations: FloatArray = held.world[ankles]
        _, boards = forward_kinematics(kit.skeleton, kit.skeleton.rest_rotations)
        balls = self._hinges + rotate(boards[self._boards], self._offsets)
        # About the foot's own side.
        ahead = rotate(self._rotations, np.array([0.0, 0.0, 1.0]))
        side = np.stack([ahead[:, 2], np.zeros(2), -ahead[:, 0]], axis=-1)
        axis = side / np.linalg.norm(side, axis=-1)[:, None]
        # A foot's rotation goes as cosine and sine of half the heel's angle, its lever as those of the whole.
        pure = np.concatenate([rotate(conjugate(self._rotations), axis), np.zeros((2, 1))], axis=1)
        self._raised: FloatArray = multiply(self._rotations, pure)
        self._lever: FloatArray = balls - held.positions[ankles]
        self._across: FloatArray = cross(axis, self._lever)
        self._turning: FloatArray = cross(self._across, axis)

    def solve(self, kit: FloatArray, heels: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Where the ankles are ``(F, 2, 3)``, metres, and the feet's rotations ``(F, 2, 4)``.

        Args:
            kit: The kit's local rotations ``(F, N, 4)``; the boards hang on its root, which stands still.
            heels: How far each heel is up, ``(F, 2)``: 0 down, 1 as far as it goes.
        """
        balls = self._hinges + rotate(kit[:, self._boards], self._offsets)
        half = 0.5 * HEEL_RAD * (heels - HELD_HEEL)[..., None]
        sine, cosine = np.sin(half), np.cos(half)
        rotations = cosine * self._rotations + sine * self._raised
        turned = 2.0 * sine * (cosine * self._across - sine * self._turning)
        return balls - self._lever - turned, rotations
