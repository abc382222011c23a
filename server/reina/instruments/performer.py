"""One player of a cast: a part, its gestures, and a body that they move."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.instruments.parameters import streamed_parameters
from reina.instruments.player import face
from reina.instruments.player.amounts import Amounts
from reina.instruments.player.face import Face
from reina.instruments.player.glances import CURVES, GlanceAmount, add_glances
from reina.instruments.player.held_pose import HeldPose
from reina.instruments.player.idle_motion import IdleMotion
from reina.instruments.player.instrument_body import BodyMotion, Float32Array
from reina.instruments.player.pose_keys import PoseKeys
from reina.instruments.player.rows import stacked
from reina.instruments.player.skeleton_layout import SkeletonLayout
from reina.instruments.player.stances import Stances
from reina.kinematics import MotionCurves
from reina.rotations import same_hemisphere
from reina.skeleton import reaches

if TYPE_CHECKING:
    from reina.curves import Parameter
    from reina.instruments.instrument import Instrument
    from reina.instruments.player.engagement import Engagement
    from reina.instruments.player.instrument_body import BodyFrames
    from reina.kinematics import Curve
    from reina.rotations.arrays import FloatArray

GESTURES: tuple[str, ...] = (
    "raised",
    "playing",
    "breath",
    "inhale",
    "air",
    "tongue",
    "effort",
    "lean",
    "turn",
)
"""Curves that move every player's trunk and face; those that an instrument does not plan are 0."""


@dataclass(frozen=True, eq=False)
class Motion:
    """What moves one performer in F frames."""

    body: BodyMotion
    """What moves the body."""
    face: FloatArray
    """Signals by the rows of `face.SIGNALS`, ``(len(SIGNALS), F)``."""


@dataclass(frozen=True, eq=False)
class PerformerFrames:
    """F frames of one performer."""

    rotations: Float32Array
    """``(F, J, 4)``: the player's joints, then the instrument's, local, rest included."""
    root_positions: FloatArray
    """``(F, S, 3)``, metres: of each of `Performer.skeletons`."""
    parameters: FloatArray
    """``(F, P)``: the values of `Performer.parameters`."""


class Performer:
    """A part as a player plays it on an instrument; a pure function of song time and of a show's values.

    Args:
        instrument: What is played.
        engagement: Who plays what, on which rigs, and where.

    Raises:
        RigError: The rigs lack something that playing needs.
    """

    def __init__(self, instrument: Instrument, engagement: Engagement) -> None:
        registry = engagement.registry
        player_rig, rigs = engagement.player_rig, engagement.instrument_rigs
        self.played = engagement.played
        """The part as it is played."""
        self.instrument = instrument
        """What it is played on."""
        self.prefix = engagement.prefix
        """What the paths of its parameters begin with."""
        self.seat = engagement.seat
        """Where the player stands."""
        self._stances = Stances(
            player_rig,
            tuple(engagement.stances.values()),
            HeldPose(player_rig, engagement.hold) if engagement.stances else None,
        )
        self._amounts = Amounts(registry, self.prefix)
        self._pose_keys = PoseKeys(registry, self.prefix)
        self._idle = IdleMotion(engagement.score, engagement.seed)
        self._face = Face(player_rig)

        planned = instrument.plan_gestures(self.played, seed=engagement.seed)
        still: dict[str, Curve] = {name: (np.zeros((0, 3)), 0.0) for name in GESTURES if name not in planned}
        self._curves = MotionCurves(planned | still | dict(engagement.glances))
        self._glance_rows = self._curves.index(CURVES if engagement.glances else ())
        self._glance_amount = GlanceAmount(registry, self.prefix)
        self._gesture_rows = dict(zip(GESTURES, self._curves.index(GESTURES).tolist(), strict=True))
        self.body = instrument.body(engagement, self._curves)
        """What turns the curves into poses."""

        in_frame = {"player": player_rig, **rigs}
        self.skeletons = tuple(
            SkeletonLayout(
                self.prefix + name,
                rig.name,
                rig.skeleton.names,
                engagement.number,
                tuple(reaches(rig).tolist()),
            )
            for name, rig in in_frame.items()
        )
        """The player's and the instrument's."""
        joints = np.cumsum([0, *(len(rig.skeleton.names) for rig in in_frame.values())])
        self._roots = joints[:-1]
        self._roots_rest: FloatArray = np.stack([rig.skeleton.rest_rotations[0] for rig in in_frame.values()])
        self.parameters: tuple[Parameter, ...] = streamed_parameters(
            engagement.number, instrument, player_rig
        )
        """What it gives to every frame beside the show."""

    def move(self, times_s: FloatArray, shown: FloatArray, stance: FloatArray) -> Motion:
        """What moves body and face at song times ``(F,)``.

        Args:
            times_s: Song times, seconds.
            shown: The show's values ``(F, P)``.
            stance: How much of each stance, ``(F, N)``.
        """
        amounts = self._amounts.read(shown)
        curves = self._curves.evaluate(times_s)
        gestures = {name: curves[row] for name, row in self._gesture_rows.items()}
        keyed = self._pose_keys.read(shown)
        glances = curves[self._glance_rows]
        if glances.any():
            keyed = add_glances(keyed, glances, self._glance_amount.read(shown))
        lowered = (1.0 - gestures["raised"]) * np.minimum(amounts["lower"], 1.0)
        body = BodyMotion(
            times_s=times_s,
            shown=shown,
            curves=curves,
            amounts=amounts,
            signals=self._body_signals(times_s, gestures, amounts, keyed),
            lowered=lowered,
            stance=self._stances.evaluate(times_s, stance * amounts["stance/amount"][:, None]),
        )
        return Motion(body, self._face_signals(times_s, gestures, amounts, lowered))

    def finish(self, posed: BodyFrames, motion: Motion) -> PerformerFrames:
        """The frames of a posed body: brought to its seat, with the face."""
        rotations, positions = posed.rotations, posed.root_positions
        if not self.seat.is_middle:
            positions = self.seat.place(positions)
            turned = self.seat.turn(rotations[:, self._roots].astype(np.float64))
            rotations[:, self._roots] = same_hemisphere(turned, self._roots_rest)
        weights = self._face.evaluate(motion.face)
        return PerformerFrames(rotations, positions, np.concatenate([posed.parameters, weights], axis=1))

    def _body_signals(
        self,
        times: FloatArray,
        gestures: dict[str, FloatArray],
        amounts: dict[str, FloatArray],
        keyed: dict[str, FloatArray],
    ) -> dict[str, FloatArray]:
        """By the names of `body_table.SIGNALS`."""
        idle = self._idle
        resting = 1.0 - gestures["playing"]
        sway = idle.sway(times) * (amounts["sway"] * (0.55 + 0.45 * gestures["playing"]))
        gaze = idle.gaze(times) * amounts["gaze"]
        breath = gestures["breath"] + 0.45 * resting * idle.quiet_breath(times)
        return {
            "breath": breath * amounts["breath"],
            "sway_side": sway[0],
            "sway_fore": sway[1],
            "sway_turn": sway[2],
            "lean": gestures["lean"] * amounts["lean"],
            "turn": gestures["turn"] * amounts["turn"],
            "effort": gestures["effort"] * amounts["lift"],
            "gaze_left": gaze[0],
            "gaze_up": gaze[1],
            **keyed,
        }

    def _face_signals(
        self,
        times: FloatArray,
        gestures: dict[str, FloatArray],
        amounts: dict[str, FloatArray],
        lowered: FloatArray,
    ) -> FloatArray:
        """Rows in the order of `face.SIGNALS`."""
        amount = amounts["face"]
        effort = gestures["effort"] * gestures["playing"]
        rows = {
            "raised": gestures["raised"] * amount,
            "air": gestures["air"] * amount,
            "effort": effort * amount,
            "inhale": gestures["inhale"] * amounts["breath"],
            "tongue": gestures["tongue"] * amounts["tongue"],
            "cheeks": gestures["air"] * (1.0 + 0.2 * effort) * amounts["cheeks"],
            "content": lowered * amount,
            "blink": self._idle.blink(times) * np.minimum(amounts["blink"], 1.0),
        }
        return stacked(rows, face.SIGNALS)
