"""One player of a cast: a part, its gestures, and a body that they move."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from reina.kinematics import MotionCurves
from reina.performance import body_table, face
from reina.performance.amounts import PLAYER_PARAMETERS, Amounts
from reina.performance.face import Face
from reina.performance.frame import Float32Array, SkeletonLayout
from reina.performance.gesture_planners import GESTURE_PLANNERS
from reina.performance.idle_motion import IdleMotion
from reina.performance.mute import Mute, mute_parameter
from reina.performance.player_body import PlayerBody
from reina.performance.pose_keys import POSE_PARAMETERS, PoseKeys
from reina.performance.seats import SEATS, Seat
from reina.performance.slide_finger import SLIDE_FINGERS
from reina.performance.stances import Stances
from reina.rotations import same_hemisphere

if TYPE_CHECKING:
    from reina.curves import Parameter, ParameterRegistry
    from reina.instruments import Instrument, PlayedPart
    from reina.instruments.trumpet.gestures import Curve
    from reina.music.score import Score
    from reina.rotations.arrays import FloatArray, IntArray
    from reina.skeleton import Hold, Rig

VIBRATO_HZ = 5.4


def player_prefix(number: int) -> str:
    """What the paths of a cast's player begin with, the first being 0: nothing, then ``players/2/``."""
    return f"players/{number + 1}/" if number else ""


def player_parameters(number: int) -> tuple[Parameter, ...]:
    """What a show may move of a cast's player, the first being 0."""
    prefix = player_prefix(number)
    return tuple(
        replace(parameter, path=prefix + parameter.path)
        for parameter in (*PLAYER_PARAMETERS, *POSE_PARAMETERS)
    )


def any_player_pattern(parameter: Parameter) -> str | None:
    """The paths that a first player's parameter has for each player of a cast, as a regular expression.

    None where it is no player's.
    """
    if all(parameter.path != own.path for own in player_parameters(0)):
        return None
    return f"^(players/([2-9]|[1-9][0-9]+)/)?{parameter.path}$"


@dataclass(frozen=True, eq=False)
class PerformerFrames:
    """F frames of one performer."""

    rotations: Float32Array
    """``(F, J, 4)``: the player's joints, then the instrument's, local, rest included."""
    root_positions: FloatArray
    """``(F, 2, 3)``, metres: the player's, the instrument's."""
    parameters: FloatArray
    """``(F, P)``: the values of `Performer.parameters`."""


class Performer:
    """A part as a player plays it on an instrument; a pure function of song time and of a show's values.

    Args:
        score: The score; its tempo and metre lead the body.
        played: What the instrument makes of a part.
        instrument: The instrument.
        player_rig: The player's rig.
        instrument_rig: The instrument's.
        hold: How the player holds it.
        registry: The show's parameters.
        number: The player's place in the cast, the first being 0.
        seat: Where the player stands.
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
        registry: ParameterRegistry,
        number: int = 0,
        seat: Seat = SEATS["middle"],
        seed: int = 0,
    ) -> None:
        self.played = played
        """The part as it is played."""
        self.instrument = instrument
        """What it is played on."""
        self.prefix = player_prefix(number)
        """What the paths of its parameters begin with."""
        self.seat = seat
        """Where the player stands."""
        self._stances = Stances(player_rig)
        self._amounts = Amounts(registry, self.prefix)
        self._pose_keys = PoseKeys(registry, self.prefix)
        self._idle = IdleMotion(score, seed)
        self._body = PlayerBody(player_rig, instrument_rig, hold)
        self._still = np.concatenate([self._body.held, instrument_rig.skeleton.rest_rotations]).astype(
            np.float32
        )
        self._root_rest: FloatArray = player_rig.skeleton.rest_rotations[0]
        self._face = Face(player_rig)
        self._mute = Mute(score, played.line, registry, self.prefix)

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

        self.skeletons = (
            SkeletonLayout(f"{self.prefix}player", player_rig.name, player_rig.skeleton.names, number),
            SkeletonLayout(
                f"{self.prefix}{instrument.name}", instrument_rig.name, instrument_rig.skeleton.names, number
            ),
        )
        """The player's and the instrument's."""
        own = (*instrument.parameters, mute_parameter(instrument.name), *self._face.parameters)
        self.parameters: tuple[Parameter, ...] = tuple(
            replace(parameter, path=self.prefix + parameter.path) for parameter in own
        )
        """What it gives to every frame beside the show."""

    def evaluate(self, times_s: FloatArray, shown: FloatArray, stance: FloatArray) -> PerformerFrames:
        """Frames at song times ``(F,)``.

        Args:
            times_s: Song times, seconds.
            shown: The show's values ``(F, P)``.
            stance: How much of each stance, ``(F, len(STANCES))``.
        """
        amounts = self._amounts.read(shown)
        curves = self._curves.evaluate(times_s)
        gestures = {name: curves[row] for name, row in self._gesture_rows.items()}
        valves = curves[self._valve_rows].T
        lifts = (curves[self._lift_rows] * amounts["finger_lift"]).T
        lowered = (1.0 - gestures["raised"]) * np.minimum(amounts["lower"], 1.0)
        slides = {name: curves[row] for name, row in self._slide_rows.items()}
        stood = self._stances.evaluate(times_s, stance * amounts["stance/amount"][:, None])
        signals = self._body_signals(times_s, gestures, amounts, self._pose_keys.read(shown))
        pose = self._body.solve(signals, lowered, valves, lifts, slides, stood)

        rotations = np.empty((len(times_s), *self._still.shape), dtype=np.float32)
        rotations[:] = self._still
        rotations[:, self._body.moving] = pose.moving
        rotations[:, -1] = pose.instrument_rotations
        roots = np.stack([pose.root_positions, pose.instrument_positions], axis=1)
        if not self.seat.is_middle:
            roots = self.seat.place(roots)
            root = self.seat.turn(rotations[:, 0].astype(np.float64))
            rotations[:, 0] = same_hemisphere(root, self._root_rest)
            horn = self.seat.turn(pose.instrument_rotations)
            rotations[:, -1] = horn * np.where(horn[:, 3:] < 0.0, -1.0, 1.0)
        weights = self._face.evaluate(self._face_signals(times_s, gestures, amounts, lowered))
        mute = self._mute.evaluate(times_s, shown)[:, None]
        parameters = np.concatenate([curves[self._streamed_rows].T, mute, weights], axis=1)
        return PerformerFrames(rotations, roots, parameters)

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
