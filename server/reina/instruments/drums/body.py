"""A drummer's body: sticks go where the strokes ask, arms follow by iteration, and the trunk helps."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from reina.instruments.drums.drum_part import drum_fingering
from reina.instruments.drums.hand_grips import HandGrips
from reina.instruments.drums.motion.drummer_motion import DrummerMotion
from reina.instruments.drums.motion.hand_shapes import CHOKE, CROSS_STICK, HAND_SHAPES, OPEN_RAD, PLAY
from reina.instruments.drums.motion.kit_pose import HI_HAT, KitPose, kit_places, part_travel
from reina.instruments.drums.motion.looks import plan_looks
from reina.instruments.drums.motion.nods import nods
from reina.instruments.drums.stick_ways import OWN_SIDES, at_arms_length, from_elbows, nearest_m
from reina.instruments.player.body import LIMBS, PlayerBody
from reina.instruments.player.body_table import SIGNALS
from reina.instruments.player.held_pose import HeldPose
from reina.instruments.player.instrument_body import BodyFrames
from reina.instruments.player.trunk_reach import LIMITS, SHOULDERS, reach_further, reach_out
from reina.instruments.player.trunk_reach import SIGNALS as REACHING
from reina.kinematics import TwoBoneLimbs
from reina.kinematics.sampled_curves import SampledCurves
from reina.kinematics.tool_arms import Tool, ToolArms, ToolPose, WristRange
from reina.rotations import conjugate, cross, multiply, rotate
from reina.skeleton import RigError, forward_kinematics

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.drums.hit import DrumHit
    from reina.instruments.drums.motion.kit_places import KitPlaces
    from reina.instruments.drums.motion.stick_paths import StickFrames
    from reina.instruments.player.body import Standing
    from reina.instruments.player.engagement import Engagement
    from reina.instruments.player.instrument_body import BodyMotion
    from reina.rotations.arrays import FloatArray, IntArray
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

FIRM = np.zeros(len(HAND_SHAPES))
FIRM[CROSS_STICK], FIRM[CHOKE] = 1.0, 0.6
"""How far a hand stays as it is placed where its wrist would be bent too far, by what it does."""
YIELDING_POWER = 4
"""How fast a wrist no longer gives way as its hand comes to where it is placed."""

SEATED, SWAYING = 0.35, ("sway_side", "sway_fore", "sway_turn", "lean", "turn")
"""How much of what turns who stands is left for who sits."""
PLANNED_HZ = 10.0
"""How often a second it is worked out how the trunk stands."""
SAMPLED_HZ = 40.0
SMOOTHING_S = 0.8
"""The trunk follows where the hands are over this long."""
FURTHER_S, FURTHER_ROUNDS = 0.25, 3
"""Where that is too slow it comes round in half of this, worked out so often."""
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

BOTH = np.arange(2)


@dataclass(frozen=True, eq=False)
class _Hands:
    """Where the hands are asked to go in F frames, left and right, as `ToolArms.solve` takes it.

    `ends` is about where the wrists are, ``(F, 2, 3)``, metres.
    """

    ends: FloatArray
    points: FloatArray
    pointing: FloatArray
    rows: IntArray
    held: FloatArray
    dorsal: FloatArray | None
    yielding: FloatArray | None


class DrumsBody:
    """Solves whole poses of a drummer, the kit and the sticks.

    Args:
        engagement: Who plays a `DrumPart`; the hold has attachments `STICKS`, the kit zones and contacts
            ``leftPedal`` and ``rightPedal``.

    Raises:
        RigError: Something that playing needs is not in the rigs.
    """

    is_framewise = True
    """See `FramewiseBody`."""

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
            seed=engagement.seed + engagement.number,
        )
        self._kit = KitPose(kit)
        self._body = PlayerBody(rig, held, signals=tuple(SHOULDERS), joint_turns=SHOULDERS)
        tools = self._tools(engagement)
        self._arms = ToolArms(
            TwoBoneLimbs(rig, LIMBS[:2]), tools, DORSAL, WristRange(FLEXION_RAD, DEVIATION_RAD)
        )
        tips = [
            engagement.instrument_rigs[name].effector(f"{side}StickTip").offset
            for name, side in zip(STICKS, SIDES, strict=True)
        ]
        self._grips = HandGrips(rig, engagement.hold, STICKS, np.stack(tips))
        self._held = self._arms.seen_from(self._grips.points.reshape(-1, 2, 3)).reshape(-1, 3)
        self._facing = self._faces()
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

    def _tools(self, engagement: Engagement) -> list[Tool]:
        tools: list[Tool] = []
        for name, side in zip(STICKS, SIDES, strict=True):
            if name not in engagement.hold.attachments:
                raise RigError(f"the hold carries no {name!r}", location="attachments")
            attached = engagement.hold.attachments[name]
            tip = engagement.instrument_rigs[name].effector(f"{side}StickTip").offset
            direction = rotate(attached.rotation, np.array([0.0, 0.0, 1.0]))
            tools.append(Tool(attached.position, direction, rotate(attached.rotation, tip)))
        return tools

    def _faces(self) -> FloatArray:
        """The basis that arms turn, in parts of along, out and across of each shape, ``(S, 2, 3, 3)``."""
        along, out = self._grips.faces[..., 0, :], self._grips.faces[..., 1, :]
        out = out - along * (along * out).sum(axis=-1, keepdims=True)
        out = out / np.linalg.norm(out, axis=-1, keepdims=True)
        ways = (along, out, cross(along, out))
        return np.stack([self._arms.in_basis(way) for way in ways], axis=-1)

    def _hands(self, sticks: StickFrames) -> _Hands:
        """Where the hands are asked to go."""
        tips = at_arms_length(sticks.tip[:, ::-1], self._nearest)
        asked = sticks.direction[:, ::-1]
        directions = from_elbows(tips, asked)
        shares, hands = sticks.share[:, ::-1], sticks.hands
        if hands is None:
            rows, turned = self._grips.rows(BOTH * 0, shares), shares
        else:
            shapes = hands.shape[:, ::-1]
            rows, turned = self._grips.rows(shapes, shares), np.where(shapes == PLAY, shares, 0.0)
            directions = _mixed(directions, asked, hands.firm[:, ::-1])
        # The hand is as much lower than the stick as the fingers have let it turn.
        turned = OPEN_RAD * turned[..., None]
        back = DORSAL - directions * np.einsum("...i,...i->...", directions, DORSAL)[..., None]
        back = back / np.sqrt(np.einsum("...i,...i->...", back, back))[..., None]
        pointing = directions * np.cos(turned) - back * np.sin(turned)
        ends, held = tips - WRIST_M * directions, self._held.take(rows, axis=0)
        if hands is None:
            return _Hands(ends, tips, pointing, rows, held, None, None)
        along, out, facing = hands.along[:, ::-1], hands.out[:, ::-1], hands.facing[:, ::-1]
        firm, placed = hands.firm[:, ::-1], hands.placed[:, ::-1]
        out = out - along * np.einsum("...i,...i->...", along, out)[..., None]
        out = out / np.sqrt(np.einsum("...i,...i->...", out, out))[..., None]
        ways = np.stack([along, out, cross(along, out)], axis=-1)
        basis = np.matmul(ways, self._facing[facing, BOTH].swapaxes(-1, -2))
        pointing = _mixed(pointing, basis[..., 0], placed)
        dorsal = _mixed(np.broadcast_to(DORSAL, pointing.shape), basis[..., 1], placed)
        # On its way a hand that is placed still gives way.
        firm = np.maximum(firm, FIRM[facing] * placed**YIELDING_POWER)
        ends = ends + (self._arms.wrists(tips, pointing, held, dorsal) - ends) * placed[..., None]
        return _Hands(ends, tips, pointing, rows, held, dorsal, 1.0 - firm)

    def _plan_trunk(self, duration_s: float, pivot: FloatArray) -> FloatArray:
        """How trunk and head follow the hands, over the whole piece, `SAMPLED_HZ` times a second."""
        count = int(np.ceil((duration_s + 2.0) * SAMPLED_HZ)) + 1
        times = np.arange(count) / SAMPLED_HZ
        asked = self._hands(self._motion.evaluate(times).sticks)
        wrists = self._arms.wrists(asked.points, asked.pointing, asked.held, asked.dorsal)
        smooth = _smooth(wrists.reshape(count, -1), int(0.5 * SMOOTHING_S * SAMPLED_HZ))
        wrists = smooth[:: int(SAMPLED_HZ / PLANNED_HZ)].reshape(-1, 2, 3)
        signals = {name: np.zeros(len(wrists)) for name in (*SIGNALS, *SHOULDERS)}
        turned = reach_out(self._body, wrists, pivot, signals)
        middle = wrists.mean(axis=1) - pivot
        head = HEAD_TURNED_TO * np.arctan2(middle[:, 0], np.maximum(middle[:, 2], 0.2))
        reached = SampledCurves(np.concatenate([turned, head[:, None]], axis=1), PLANNED_HZ).evaluate(times)
        reached[:, :-1] = self._in_time(reached[:, :-1], asked, pivot)
        return reached

    def _in_time(self, reached: FloatArray, asked: _Hands, pivot: FloatArray) -> FloatArray:
        """A trunk that comes round in time for what is quick, ``(F, 5)``, `SAMPLED_HZ` times a second."""
        still = {name: np.zeros(len(reached)) for name in (*SIGNALS, *SHOULDERS)}
        further, result = np.zeros_like(reached), reached
        for _ in range(FURTHER_ROUNDS):
            standing = self._body.stand({**still, **dict(zip(REACHING, result.T, strict=True))})
            arms = self._solve_arms(standing, asked)
            further = further + reach_further(self._body, arms.wrists, pivot, still, result) - result
            result = np.minimum(np.maximum(reached + _eased(further), LIMITS[0]), LIMITS[1])
        return result

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

    def _elbows(self, standing: Standing, asked: _Hands) -> FloatArray:
        """Which way the elbows point, ``(F, 2, 3)``: as they hang before the chest, turned with the arms.

        A fixed way would be along an arm sooner or later, and the elbow would flip over.
        """
        tips = asked.points
        own = tips[..., 0] * OWN_SIDES
        raised = np.minimum(np.maximum(tips[..., 1] - RAISED_M[0], 0.0) / RAISED_M[1], 1.0)
        raised = raised * np.minimum(np.maximum(own - ASIDE_M[0], 0.0) / ASIDE_M[1], 1.0)
        poles = self._poles + raised[..., None] * self._outward
        chest = standing.world[:, self._chest, None]
        poles, ahead = rotate(chest, poles), rotate(chest, self._ahead)
        arms = asked.ends - standing.limbs[:, :2]
        length = np.sqrt(np.einsum("...i,...i->...", arms, arms))
        arms = arms / length[..., None]
        # The least turn that takes ahead to the arm.
        both = ahead + arms
        along = np.einsum("...i,...i->...", arms, poles) / np.maximum(
            np.einsum("...i,...i->...", arms, both), 0.05
        )
        folded = np.minimum(np.maximum((FOLDED_M[0] - length) / FOLDED_M[1], 0.0), 1.0)
        return poles - along[..., None] * both + folded[..., None] * ASIDE

    def _solve_arms(self, standing: Standing, asked: _Hands) -> ToolPose:
        return self._arms.solve(
            standing.limbs[:, :2],
            asked.points,
            asked.pointing,
            self._elbows(standing, asked),
            asked.held,
            asked.dorsal,
            asked.yielding,
        )

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
        asked = self._hands(drummed.sticks)
        sticks = self._solve_arms(standing, asked)
        kit = self._kit.rotations(drummed)
        feet, feet_rotations = self._feet.solve(kit, drummed.feet.heel[:, ::-1])
        standing = replace(standing, feet=feet, feet_rotations=feet_rotations)
        moving = self._body.reach(standing, sticks.wrists, sticks.hands, elbows=sticks.hinges)

        frames, joints = len(times), len(self._body.still)
        rotations = np.empty((frames, *self._still.shape), dtype=np.float32)
        rotations[:] = self._still
        rotations[:, self._body.moving] = moving
        rotations[:, joints:-2] = kit
        rotations[:, self._grips.fingers] = self._grips.turned.take(asked.rows, axis=0).reshape(frames, -1, 4)
        held = multiply(sticks.hands, self._grips.rotations.take(asked.rows, axis=0))
        rotations[:, -2:] = held * np.where(held[..., 3:] < 0.0, -1.0, 1.0)
        roots = np.zeros((frames, 4, 3))
        roots[:, 0] = standing.hips
        roots[:, 2:] = sticks.wrists + rotate(sticks.hands, self._grips.places.take(asked.rows, axis=0))
        return BodyFrames(rotations, roots, self._kit.parameters(drummed))


def _eased(turned: FloatArray) -> FloatArray:
    """What a trunk does beyond, ``(F, S)``, so that it has come where it is wanted and goes gently."""
    reach = int(0.5 * FURTHER_S * SAMPLED_HZ)
    eased = np.zeros_like(turned)
    for sign in (1.0, -1.0):
        farthest = np.pad(np.maximum(sign * turned, 0.0), ((reach, reach), (0, 0)))
        held = np.lib.stride_tricks.sliding_window_view(farthest, 2 * reach + 1, axis=0).max(axis=-1)
        eased += sign * _smooth(held, reach)
    return eased


def _smooth(rows: FloatArray, reach: int) -> FloatArray:
    """Rows ``(F, S)``, each as those within so many of it are in the mean."""
    window = np.hanning(2 * reach + 3)[1:-1]
    padded = np.pad(rows, ((reach, reach), (0, 0)), mode="edge")
    smooth: list[FloatArray] = [np.convolve(one, window / window.sum(), mode="valid") for one in padded.T]
    return np.stack(smooth, axis=1)


def _mixed(one: FloatArray, other: FloatArray, share: FloatArray) -> FloatArray:
    """Unit vectors between two, ``(F, 2, 3)``."""
    result = one + (other - one) * share[..., None]
    result = result / np.sqrt(np.einsum("...i,...i->...", result, result))[..., None]
    # Where nothing is mixed it is the same to the last bit, whatever else is in the block.
    return np.where(share[..., None] > 0.0, result, one)


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
