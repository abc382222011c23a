"""Where both sticks are at any times: tips, which way they point, and the hands that hold them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

from reina.instruments.drums.hit import HANDS
from reina.instruments.drums.motion.kit_answers import SWINGS
from reina.instruments.drums.motion.kit_places import UP
from reina.instruments.drums.motion.stick_plan import (
    CONTACT_RAD,
    FALL,
    GLIDE,
    GRIP_M,
    RISE,
    Grip,
    plan_sticks,
)
from reina.kinematics.motion_curves import minimum_jerk
from reina.rotations import exp, rotate

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.drums.drum_part import Choke
    from reina.instruments.drums.hit import DrumHit, Limb
    from reina.instruments.drums.motion.kit_answers import KitAnswers, KitFrames
    from reina.instruments.drums.motion.kit_places import KitPlaces
    from reina.instruments.drums.motion.stick_plan import StickPlan
    from reina.rotations.arrays import FloatArray, IntArray

HAND_SHARE: Final = 0.3
"""How much of the tip's height the hand goes up itself; the wrist does the rest."""

LEAD_S: Final = 0.02
"""The hand is so far ahead: it goes down while the tip still goes up, and the tip whips after it."""

STEEPEST: Final = 0.88
"""Sine of the steepest angle of a stick."""

FALL_POWER, RISE_POWER = 2.4, 2.2
"""A stroke falls with the time's power; it rises as the reverse."""

THROUGH_S: Final = (0.05, 0.13)
"""A stroke goes through a crash's edge for so long, and is back after the second time more."""

FOLLOW_M: Final = 0.12
"""Within this height the tip goes with a cymbal that still swings."""


@dataclass(frozen=True, eq=False)
class StickFrames:
    """Both sticks in F frames, in the kit's frame; index 0 is the stick on the player's right, 1 on the left.

    Attributes:
        tip: ``(F, 2, 3)`` metres.
        direction: ``(F, 2, 3)`` unit vectors from the hand to the tip.
        grip: ``(F, 2, 3)`` where the hands hold them.
    """

    tip: FloatArray
    direction: FloatArray
    grip: FloatArray


class StickPaths:
    """The sticks of a part; a pure function of times.

    Args:
        hits: By time; those of hands count.
        places: The kit as it stands, mirrored for a left-handed player.
        answers: What the kit does: tips land on cymbals where they are at that time.
        hi_hat_travel: (3,) from the open to the closed hi-hat, if its zones are those of the open one.
        chokes: Cymbals that a hand grips, by time.
    """

    def __init__(
        self,
        hits: Sequence[DrumHit],
        places: KitPlaces,
        answers: KitAnswers,
        *,
        hi_hat_travel: FloatArray | None = None,
        chokes: Sequence[Choke] = (),
    ) -> None:
        self._answers = answers
        travel = np.zeros(3) if hi_hat_travel is None else hi_hat_travel
        self._sticks = [
            _Stick(plan_sticks(_of_hand(limb, hits, chokes), places, side, tuple(SWINGS)), travel)
            for side, limb in enumerate(HANDS)
        ]

    def evaluate(self, times_s: FloatArray, kit: KitFrames | None = None) -> StickFrames:
        """Both sticks at times ``(F,)``; what the kit does then may be given."""
        kit = self._answers.evaluate(times_s) if kit is None else kit
        frames = [stick.evaluate(times_s, kit.tilt, kit.hi_hat) for stick in self._sticks]
        tip, direction = (np.stack(parts, axis=1) for parts in zip(*frames, strict=True))
        return StickFrames(tip, direction, tip - GRIP_M * direction)


def _of_hand(limb: Limb, hits: Sequence[DrumHit], chokes: Sequence[Choke]) -> list[DrumHit]:
    """What one hand does, by time."""
    own = [hit for hit in hits if hit.limb == limb]
    own += [Grip(choke.at_s, 0.0, choke.piece, "edge", limb, 0.0) for choke in chokes if choke.limb == limb]
    return sorted(own, key=lambda hit: hit.onset_s)


class _Stick:
    """One stick."""

    def __init__(self, plan: StickPlan, hi_hat_travel: FloatArray) -> None:
        stations = plan.stations
        self._point = np.stack([station.point for station in stations])
        self._normal = np.stack([station.normal for station in stations])
        heading = np.stack([station.heading for station in stations])
        self._azimuth = np.arctan2(heading[:, 0], heading[:, 2])
        struck = [station for station in stations if station is not stations[0]]
        self._beyond = (
            np.array([station.through for station in struck]).reshape(-1, 3) * plan.through[:, None]
        )
        self._arm = self._point - np.stack([station.pivot for station in stations])
        self._swings: IntArray = np.array([station.swings for station in stations])
        self._outward = np.stack([_level(arm) for arm in self._arm])
        self._drop = np.array([float(station.is_hi_hat) for station in stations])[:, None] * hi_hat_travel
        self._moves = plan.moves
        self._around = np.concatenate([plan.around, np.zeros((1, 3))])
        self._from = np.concatenate([[-np.inf], plan.heights[:, 0]])
        self._to = np.concatenate([[-np.inf], plan.heights[:, 1]])
        self._height = np.concatenate([[0.0], plan.heights[:, 2]])
        self._shape = np.concatenate([[GLIDE], plan.heights[:, 3]])
        self._strokes = plan.strokes_s

    def evaluate(
        self, times_s: FloatArray, tilt: FloatArray, closed: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Tip and direction ``(F, 3)``.

        Args:
            times_s: (F,) seconds.
            tilt: (F, C, 2) the cymbals'.
            closed: (F,) how far the hi-hat is closed.
        """
        station, done = self._where(times_s)
        after = np.minimum(station + 1, len(self._point) - 1)
        blend = done[:, None]
        height = self._heights(times_s)
        point = self._point[station] * (1.0 - blend) + self._point[after] * blend
        point = point + self._around[station] * (16.0 * (blend * (1.0 - blend)) ** 2)
        normal = self._normal[station] * (1.0 - blend) + self._normal[after] * blend
        normal = normal / np.linalg.norm(normal, axis=1, keepdims=True)
        turn = self._azimuth[after] - self._azimuth[station]
        azimuth = self._azimuth[station] + (np.mod(turn + np.pi, 2.0 * np.pi) - np.pi) * done
        heading = np.stack([np.sin(azimuth), np.zeros_like(azimuth), np.cos(azimuth)], axis=1)
        near = np.where(done > 0.5, after, station)
        close = np.maximum(1.0 - height / FOLLOW_M, 0.0)[:, None] * np.abs(2.0 * blend - 1.0)
        tip = point + height[:, None] * normal
        tip = tip + close * self._moved(near, tilt) + close * closed[:, None] * self._drop[near]
        tip = tip + self._past(times_s)
        # The hand goes up and down itself, ahead of the tip; the stick's angle makes up for the rest.
        lifted = HAND_SHARE * self._heights(times_s + LEAD_S)
        sine = (height - lifted) / GRIP_M - np.sin(CONTACT_RAD)
        sine = np.clip(sine, -STEEPEST, STEEPEST)
        cosine = np.sqrt(1.0 - sine * sine)
        back = (np.cos(CONTACT_RAD) - cosine) * GRIP_M * np.minimum(height / 0.05, 1.0)
        tip = tip - back[:, None] * heading
        return tip, heading * cosine[:, None] + sine[:, None] * UP

    def _where(self, times_s: FloatArray) -> tuple[IntArray, FloatArray]:
        """Which station the stick is at or leaves, and how far it is on its way to the next."""
        if not len(self._moves):
            return np.zeros(len(times_s), dtype=np.intp), np.zeros(len(times_s))
        move = np.searchsorted(self._moves[:, 0], times_s, side="right") - 1
        known = np.maximum(move, 0)
        start, end = self._moves[known, 0], self._moves[known, 1]
        done = minimum_jerk((times_s - start) / np.maximum(end - start, 1e-9))
        return np.maximum(move, 0), np.where(move >= 0, done, 0.0)

    def _heights(self, times_s: FloatArray) -> FloatArray:
        """How high the tip is above where it lands, metres."""
        place = np.searchsorted(self._from, times_s, side="right") - 1
        start, end = self._from[place], self._to[place]
        before, after = self._height[np.maximum(place - 1, 0)], self._height[place]
        with np.errstate(invalid="ignore"):
            u = np.where(np.isfinite(start), (times_s - start) / np.maximum(end - start, 1e-9), 1.0)
        u = np.clip(u, 0.0, 1.0)
        shape = self._shape[place]
        done = np.where(
            shape == RISE,
            1.0 - (1.0 - u) ** RISE_POWER,
            np.where(shape == FALL, u**FALL_POWER, minimum_jerk(u)),
        )
        return before + (after - before) * done

    def _moved(self, near: IntArray, tilt: FloatArray) -> FloatArray:
        """How far the piece's swing moves the point where the tip lands, ``(F, 3)``."""
        row = self._swings[near]
        angles = np.where(row[:, None] >= 0, tilt[np.arange(len(near)), np.maximum(row, 0)], 0.0)
        if not angles.any():
            return np.zeros((len(near), 3))
        turn = turned(self._outward[near], angles)
        return rotate(turn, self._arm[near]) - self._arm[near]

    def _past(self, times_s: FloatArray) -> FloatArray:
        """How far a stroke goes on beyond an edge, ``(F, 3)``."""
        if not self._beyond.any():
            return np.zeros((len(times_s), 3))
        place = np.searchsorted(self._strokes, times_s, side="right") - 1
        known = np.maximum(place, 0)
        since = times_s - self._strokes[known]
        until = np.full(len(times_s), np.inf)
        later = known + 1 < len(self._strokes)
        until[later] = self._strokes[known[later] + 1] - self._strokes[known[later]]
        there, back = THROUGH_S[0], THROUGH_S[1]
        away = minimum_jerk(since / there) * (1.0 - minimum_jerk((since - there) / back))
        room = np.clip((until - there - back) / 0.1, 0.0, 1.0)
        return np.where(place >= 0, away * room, 0.0)[:, None] * self._beyond[known]


def turned(outward: FloatArray, tilt: FloatArray) -> FloatArray:
    """The turn of a cymbal ``(..., 4)`` that dips where it is struck.

    Args:
        outward: (..., 3) level unit vectors from its middle to where it is struck.
        tilt: (..., 2) radians: down towards there, and to the side.
    """
    vector = outward * tilt[..., 1:]
    vector[..., 0] += outward[..., 2] * tilt[..., 0]  # about what is across, UP × outward
    vector[..., 2] -= outward[..., 0] * tilt[..., 0]
    return exp(vector)


def _level(arm: FloatArray) -> FloatArray:
    level = arm * (1.0, 0.0, 1.0)
    far = float(np.linalg.norm(level))
    return level / far if far > 1e-6 else np.zeros(3)
