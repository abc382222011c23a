"""A performance: what is on screen at any frame, as a pure function of score, rigs, show and time."""

from __future__ import annotations

import copy
from typing import TYPE_CHECKING

import numpy as np

from reina.kinematics import MotionCurves
from reina.performance import body_table, face
from reina.performance.amounts import Amounts
from reina.performance.face import Face
from reina.performance.frame import BLOCK_FRAMES, FrameBlock, FrameLayout, SkeletonLayout
from reina.performance.gesture_planners import GESTURE_PLANNERS
from reina.performance.idle_motion import IdleMotion
from reina.performance.mute import Mute, mute_parameter
from reina.performance.player_body import PlayerBody
from reina.performance.pose_keys import PoseKeys
from reina.performance.slide_finger import SLIDE_FINGERS
from reina.performance.stance_choice import StanceChoice
from reina.performance.stances import Stances

if TYPE_CHECKING:
    from reina.instruments import Instrument, PlayedPart
    from reina.instruments.trumpet.gestures import Curve
    from reina.keyframes import ParameterRegistry, ShowPlan
    from reina.music.score import Score
    from reina.rotations.arrays import FloatArray, IntArray
    from reina.skeleton import Hold, Rig

TAIL_S = 4.0
"""After the score's end the player settles for so long; then the last frame holds."""

VIBRATO_HZ = 5.4


class Performance:
    """A part played by a player on an instrument, under a show.

    Nothing is carried from frame to frame: `evaluate` gives the same bytes for a block whenever it is asked.

    Args:
        score: The score; its tempo and metre lead the body.
        played: What the instrument makes of a part.
        instrument: The instrument.
        player_rig: The player's rig.
        instrument_rig: The instrument's.
        hold: How the player holds it.
        show_plan: The show, planned over the same score.
        registry: The show's parameters, in the plan's order.
        fps: Frames a second.
        seed: Which of many equal ways of moving.

    Raises:
        RigError: The rigs lack something that playing needs.
    """

    def __init__(
        self,
        *,
        score: Score,
        played: PlayedPart,
        instrument: Instrument,
        player_rig: Rig,
        instrument_rig: Rig,
        hold: Hold,
        show_plan: ShowPlan,
        registry: ParameterRegistry,
        fps: int = 60,
        seed: int = 0,
    ) -> None:
        self.played = played
        """The part as it is played."""
        self._show_plan = show_plan
        self._stance_choice = StanceChoice(show_plan)
        self._stances = Stances(player_rig)
        self._amounts = Amounts(registry)
        self._pose_keys = PoseKeys(registry)
        self._idle = IdleMotion(score, seed)
        self._body = PlayerBody(player_rig, instrument_rig, hold)
        self._still = np.concatenate([self._body.held, instrument_rig.skeleton.rest_rotations]).astype(
            np.float32
        )
        self._face = Face(player_rig)
        self._mute = Mute(score, played.line, registry)
        self._end_s = score.duration_s + TAIL_S

        curves = GESTURE_PLANNERS[instrument.name](played, seed=seed)
        valves = [f"valve/{valve + 1}" for valve in range(instrument.valve_count)]
        lifts = [f"lift/{valve + 1}" for valve in range(instrument.valve_count)]
        prefix = f"{instrument.name}/"
        streamed = [parameter.path.removeprefix(prefix) for parameter in instrument.parameters]
        at_rest: dict[str, Curve] = {
            name: (np.zeros((0, 3)), 0.0)
            for name in (*valves, *lifts, *streamed, *_GESTURES)
            if name not in curves
        }
        self._curves = MotionCurves(curves | at_rest)
        self._valve_rows: IntArray = self._curves.index(valves)
        self._lift_rows: IntArray = self._curves.index(lifts)
        self._streamed_rows: IntArray = self._curves.index(streamed)
        self._slide_rows = {
            name: self._curves.names.index(name) for name in SLIDE_FINGERS if name in streamed
        }
        self._gesture_rows = dict(zip(_GESTURES, self._curves.index(_GESTURES).tolist(), strict=True))

        self.layout = FrameLayout(
            fps=fps,
            skeletons=(
                SkeletonLayout("player", player_rig.name, player_rig.skeleton.names),
                SkeletonLayout(instrument.name, instrument_rig.name, instrument_rig.skeleton.names),
            ),
            parameters=(
                *registry,
                *instrument.parameters,
                mute_parameter(instrument.name),
                *self._face.parameters,
            ),
        )
        """What every frame holds."""

    def with_show(self, show_plan: ShowPlan) -> Performance:
        """The same performance under another show over the same registry; everything else is shared."""
        other = copy.copy(self)
        other._show_plan = show_plan
        other._stance_choice = StanceChoice(show_plan)
        return other

    def evaluate(self, block: int) -> FrameBlock:
        """Frames 60·block to 60·block + 59.

        Raises:
            ValueError: The block is negative.
        """
        if block < 0:
            raise ValueError(f"blocks are counted from 0, not {block}")
        first = block * BLOCK_FRAMES
        return self.sample(np.arange(first, first + BLOCK_FRAMES) / self.layout.fps, first)

    def sample(self, song_time_s: FloatArray, first_frame: int = 0) -> FrameBlock:
        """The same function at any song times ``(F,)``, for exports and measurements.

        Floating point differs in its last bit between a block and a row, so what is streamed comes from
        `evaluate`.
        """
        shown, cuts = self._show_plan.evaluate(song_time_s)
        times = np.minimum(song_time_s, self._end_s)
        amounts = self._amounts.read(shown)
        curves = self._curves.evaluate(times)
        gestures = {name: curves[row] for name, row in self._gesture_rows.items()}
        valves = curves[self._valve_rows].T
        lifts = (curves[self._lift_rows] * amounts["finger_lift"]).T
        lowered = (1.0 - gestures["raised"]) * np.minimum(amounts["lower"], 1.0)
        slides = {name: curves[row] for name, row in self._slide_rows.items()}
        stood = self._stance_choice.weights(times) * amounts["stance/amount"][:, None]
        stance = self._stances.evaluate(times, stood)
        signals = self._body_signals(times, gestures, amounts, self._pose_keys.read(shown))
        pose = self._body.solve(signals, lowered, valves, lifts, slides, stance)

        rotations = np.empty((len(times), *self._still.shape), dtype=np.float32)
        rotations[:] = self._still
        rotations[:, self._body.moving] = pose.moving
        rotations[:, -1] = pose.instrument_rotations
        roots = np.empty((len(times), 2, 3), dtype=np.float32)
        roots[:, 0] = pose.root_positions
        roots[:, 1] = pose.instrument_positions
        weights = self._face.evaluate(self._face_signals(times, gestures, amounts, lowered))
        mute = self._mute.evaluate(times, shown)[:, None]
        parameters = np.concatenate(
            [shown, curves[self._streamed_rows].T, mute, weights], axis=1, dtype=np.float32
        )
        return FrameBlock(first_frame, self.layout.fps, song_time_s, rotations, roots, parameters, cuts)

    def _body_signals(
        self,
        times: FloatArray,
        gestures: dict[str, FloatArray],
        amounts: dict[str, FloatArray],
        keyed: dict[str, FloatArray],
    ) -> FloatArray:
        """Rows in the order of `body_table.SIGNALS`."""
        idle = self._idle
        resting = 1.0 - gestures["playing"]
        sway = idle.sway(times) * (amounts["sway"] * (0.55 + 0.45 * gestures["playing"]))
        gaze = idle.gaze(times) * amounts["gaze"]
        breath = gestures["breath"] + 0.45 * resting * idle.quiet_breath(times)
        vibrato = gestures["vibrato"] * np.sin((2.0 * np.pi * VIBRATO_HZ) * times)
        rows = {
            "breath": breath * amounts["breath"],
            "sway_side": sway[0],
            "sway_fore": sway[1],
            "sway_turn": sway[2],
            "lean": gestures["lean"] * amounts["lean"],
            "turn": gestures["turn"] * amounts["turn"],
            "effort": gestures["effort"] * amounts["lift"],
            "gaze_left": gaze[0],
            "gaze_up": gaze[1],
            "vibrato": vibrato * amounts["vibrato"],
            **keyed,
        }
        return _stack([rows[name] for name in body_table.SIGNALS])

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
        return _stack([rows[name] for name in face.SIGNALS])


def _stack(rows: list[FloatArray]) -> FloatArray:
    """As `numpy.stack`, which on many short rows takes several times as long."""
    return np.concatenate(rows).reshape(len(rows), -1)


_GESTURES: tuple[str, ...] = (
    "raised",
    "playing",
    "breath",
    "inhale",
    "air",
    "tongue",
    "effort",
    "lean",
    "turn",
    "vibrato",
)
"""Curves that a body and a face are moved by; those that an instrument does not plan are 0."""
