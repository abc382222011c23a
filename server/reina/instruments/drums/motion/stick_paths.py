"""Where both sticks are at any times: tips, which way they point, and the hands that hold them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

from reina.instruments.drums.hit import HANDS
from reina.instruments.drums.motion.hand_shapes import CHOKE, CROSS_STICK, JAWS_SHARE, OPEN_RAD, PLAY, TWIRL
from reina.instruments.drums.motion.kit_answers import SWINGS
from reina.instruments.drums.motion.kit_places import UP
from reina.instruments.drums.motion.stick_plan import (
    CONTACT_RAD,
    CROSS_STICK_LIFT_M,
    FALL,
    GLIDE,
    GRIP_M,
    RISE,
    SAME_PLACE_M,
    TWIRL_S,
    Grip,
    Twirl,
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
    from reina.instruments.drums.motion.stick_plan import Station, StickPlan
    from reina.rotations.arrays import FloatArray, IntArray

    _Hand = tuple[IntArray, FloatArray, FloatArray, IntArray, FloatArray, FloatArray]
    """Of one hand what `HandFrames` has of both."""

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

FINGERS_RAD: Final = 0.36
"""How far the fingers alone turn a stick at most; they do nearly all of a small stroke, and the wrist does
what is left of a large one."""

FINGERS_FIRST: Final = 0.85
"""Their part where a stroke begins."""

LEVEL_M: Final = 0.12
"""A stick comes to lie as a rim shot wants it within this height."""

STILL_M: Final = 0.03
"""So near to the surface the hand does not go up or down by itself in a rim shot, and fingers close on a
cymbal's edge."""

BENEATH_M: Final = np.array([0.12, -0.05, -0.20])
"""It comes to the head, and goes from it, beneath the other arm: so far from the straight way at its middle;
on the player's left."""

OVER_HEAD_M: Final = 0.075
"""A stick that is turned end for end on its way to a head or from it goes up so far to be clear of it."""

EARLIER: Final = 0.15
LATER: Final = 0.85
"""In which part of the time between two pieces a hand goes over from playing to a cross-stick, and back."""

TURNED: Final = 0.6
"""And for how much of it the stick is turned end for end."""


@dataclass(frozen=True, eq=False)
class StickFrames:
    """Both sticks in F frames, in the kit's frame; index 0 is the stick on the player's right, 1 on the left.

    Attributes:
        tip: ``(F, 2, 3)`` metres.
        direction: ``(F, 2, 3)`` unit vectors from the hand to the tip.
        grip: ``(F, 2, 3)`` where the hands hold them.
        share: ``(F, 2)`` how far along what each hand does with its stick it is.
        hands: What the hands do beside playing; None where both play in all of the frames.
    """

    tip: FloatArray
    direction: FloatArray
    grip: FloatArray
    share: FloatArray
    hands: HandFrames | None


@dataclass(frozen=True, eq=False)
class HandFrames:
    """What both hands do in F frames beside playing, as `StickFrames`.

    Attributes:
        shape: ``(F, 2)`` of `HAND_SHAPES` what each hand does with its stick.
        firm: ``(F, 2)`` how far the stick lies just as `StickFrames.direction` says, 0 to 1.
        placed: ``(F, 2)`` how far the hand goes by `along` and `out` instead, 0 to 1.
        facing: ``(F, 2)`` of `HAND_SHAPES` what is along and out in the hand.
        along: ``(F, 2, 3)`` which way a placed hand goes along what it touches.
        out: ``(F, 2, 3)`` and out of that, across it.
    """

    shape: IntArray
    firm: FloatArray
    placed: FloatArray
    facing: IntArray
    along: FloatArray
    out: FloatArray


class StickPaths:
    """The sticks of a part; a pure function of times.

    Args:
        hits: By time; those of hands count.
        places: The kit as it stands, mirrored for a left-handed player.
        answers: What the kit does: tips land on cymbals where they are at that time.
        hi_hat_travel: (3,) from the open to the closed hi-hat, if its zones are those of the open one.
        chokes: Cymbals that a hand grips, by time.
        twirls: When each hand begins to twirl its stick, seconds, the player's right first.
    """

    def __init__(
        self,
        hits: Sequence[DrumHit],
        places: KitPlaces,
        answers: KitAnswers,
        *,
        hi_hat_travel: FloatArray | None = None,
        chokes: Sequence[Choke] = (),
        twirls: tuple[Sequence[float], Sequence[float]] = ((), ()),
    ) -> None:
        self._answers = answers
        travel = np.zeros(3) if hi_hat_travel is None else hi_hat_travel
        self._sticks = [
            _Stick(
                plan_sticks(_of_hand(limb, hits, chokes, twirls[side]), places, side, tuple(SWINGS)), travel
            )
            for side, limb in enumerate(HANDS)
        ]

    def evaluate(self, times_s: FloatArray, kit: KitFrames | None = None) -> StickFrames:
        """Both sticks at times ``(F,)``; what the kit does then may be given."""
        kit = self._answers.evaluate(times_s) if kit is None else kit
        frames = [stick.evaluate(times_s, kit.tilt, kit.hi_hat) for stick in self._sticks]
        tip = np.stack([frame[0] for frame in frames], axis=1)
        direction = np.stack([frame[1] for frame in frames], axis=1)
        share = np.stack([frame[2] for frame in frames], axis=1)
        if all(hand is None for *_, hand in frames):
            return StickFrames(tip, direction, tip - GRIP_M * direction, share, None)
        both = [_playing(len(times_s)) if hand is None else hand for *_, hand in frames]
        hands = HandFrames(
            shape=np.stack([hand[0] for hand in both], axis=1),
            firm=np.stack([hand[1] for hand in both], axis=1),
            placed=np.stack([hand[2] for hand in both], axis=1),
            facing=np.stack([hand[3] for hand in both], axis=1),
            along=np.stack([hand[4] for hand in both], axis=1),
            out=np.stack([hand[5] for hand in both], axis=1),
        )
        # A hand that chokes holds the edge itself.
        length = GRIP_M * (1.0 - hands.placed * (hands.facing == CHOKE))
        return StickFrames(tip, direction, tip - length[..., None] * direction, share, hands)


def _playing(count: int) -> _Hand:
    """A hand that only plays, in so many frames."""
    none, still = np.zeros(count), np.full(count, PLAY, dtype=np.intp)
    ahead = np.tile(np.array([0.0, 0.0, 1.0]), (count, 1))
    return still, none, none, still, ahead, np.tile(UP, (count, 1))


def _of_hand(
    limb: Limb, hits: Sequence[DrumHit], chokes: Sequence[Choke], twirls_s: Sequence[float]
) -> list[DrumHit]:
    """What one hand does, by time."""
    own = [hit for hit in hits if hit.limb == limb]
    own += [Grip(choke.at_s, 0.0, choke.piece, "edge", limb, 0.0) for choke in chokes if choke.limb == limb]
    own += [Twirl(at_s, 0.0, "", "", limb, 0.0) for at_s in twirls_s]
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
        self._outward = np.stack(
            [_outward(station, arm) for station, arm in zip(stations, self._arm, strict=True)]
        )
        placings = [station.placing for station in stations]
        self._slope = np.array([np.sin(CONTACT_RAD) if one is None else one.slope for one in placings])
        self._is_rim_shot = np.array([one is not None and one.shape == PLAY for one in placings])
        self._does: IntArray = np.array(
            [PLAY if one is None else one.shape for one in placings], dtype=np.intp
        )
        self._lever = np.array([0.0 if one is None else one.lever_m for one in placings])
        level = [(heading[0] * 0.0, UP)] * len(stations)
        ways = [
            both if one is None or one.along is None or one.out is None else (one.along, one.out)
            for one, both in zip(placings, level, strict=True)
        ]
        self._along, self._out = (np.stack(parts) for parts in zip(*ways, strict=True))
        own_side = 1.0 if stations[0].heading[0] < 0.0 else -1.0
        self._beneath = BENEATH_M * (own_side, 1.0, 1.0)
        away = np.linalg.norm(np.diff(self._point, axis=0, append=self._point[-1:]), axis=1)
        self._apart = (away > SAME_PLACE_M) | (self._does != np.append(self._does[1:], self._does[-1]))
        self._special = self._is_rim_shot | (self._does > 0)
        self._twirls = plan.twirls_s
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
    ) -> tuple[FloatArray, FloatArray, FloatArray, _Hand | None]:
        """Tip and direction ``(F, 3)``, how open the hand is ``(F,)``, and what `HandFrames` has, or None.

        Args:
            times_s: (F,) seconds.
            tilt: (F, C, 2) the cymbals'.
            closed: (F,) how far the hi-hat is closed.
        """
        station, done, part = self._where(times_s)
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
        slope = self._slope[station] * (1.0 - done) + self._slope[after] * done
        # The hand goes up and down itself, ahead of the tip; the stick's angle makes up for the rest.
        lifted = HAND_SHARE * self._heights(times_s + LEAD_S)
        placed = firm = np.zeros(len(times_s))
        turned_rad = 0.0
        is_special = self._special[station] | self._special[after]
        is_plain = not is_special.any()
        if not is_plain:
            placed = (self._does[station] > 0) * (1.0 - done) + (self._does[after] > 0) * done
            rim = self._is_rim_shot[station] * (1.0 - done) + self._is_rim_shot[after] * done
            firm = rim * np.maximum(1.0 - height / LEVEL_M, 0.0)
            lifted = lifted * (1.0 - rim * np.maximum(1.0 - height / STILL_M, 0.0))
            # A hand that lies on a head lifts the shaft first, and itself only after that.
            lever = self._lever[station] * (1.0 - done) + self._lever[after] * done
            lifts = np.minimum(height, CROSS_STICK_LIFT_M) * np.minimum(lever / 0.1, 1.0)
            height = height - lifts
            is_other = self._does[station] != self._does[after]
            leaves, comes = (is_other & (self._lever[one] > 0.0) for one in (station, after))
            late = leaves * 4.0 + comes * 6.75 * (1.0 - done)
            height = height + OVER_HEAD_M * late * done * (1.0 - done)
            # Most of the bow is where the head is.
            bow = 6.75 * done * (1.0 - done) * (leaves * (1.0 - done) + comes * done)
            point = point + bow[:, None] * self._beneath
            turned_rad = lifts / np.maximum(lever, 0.1)
        tip = point + height[:, None] * normal
        tip = tip + close * self._moved(near, tilt) + close * closed[:, None] * self._drop[near]
        tip = tip + self._past(times_s)
        sine = (height - lifted) / GRIP_M - slope
        sine = np.clip(sine, -STEEPEST, STEEPEST)
        cosine = np.sqrt(1.0 - sine * sine)
        back = (np.cos(CONTACT_RAD) - cosine) * GRIP_M * np.minimum(height / 0.05, 1.0) * (1.0 - placed)
        tip = tip - back[:, None] * heading
        direction = heading * cosine[:, None] + sine[:, None] * UP
        # Fingers let the stick turn at once, and the wrist what is more.
        risen = np.maximum(np.arcsin(sine) + np.arcsin(slope), 0.0)
        share = (1.0 - np.exp(risen * (-FINGERS_FIRST / FINGERS_RAD))) * (FINGERS_RAD / OPEN_RAD)
        if is_plain:
            return tip, direction, share, None
        shape, share = self._grip(times_s, station, after, part, share, height)
        facing = np.where(
            (self._does[after] > 0) & ((self._does[station] == 0) | (done > 0.5)), after, station
        )
        # Between two places a hand is let go.
        both = (self._does[after] > 0) & (self._does[station] > 0)
        placed = placed * np.where(both & self._apart[station], np.abs(2.0 * done - 1.0), 1.0)
        along, out = self._along[facing], self._out[facing]
        up, level = np.sin(turned_rad)[:, None], np.cos(turned_rad)[:, None]
        along, out = along * level + out * up, out * level - along * up
        # A hand at a cymbal's edge turns with it.
        angles = self._tilted(facing, tilt)
        if angles.any():
            turn = turned(self._outward[facing], angles)
            along, out = rotate(turn, along), rotate(turn, out)
        return tip, direction, share, (shape, firm, placed, self._does[facing], along, out)

    def _grip(
        self,
        times_s: FloatArray,
        station: IntArray,
        after: IntArray,
        part: FloatArray,
        open_: FloatArray,
        height: FloatArray,
    ) -> tuple[IntArray, FloatArray]:
        """What the hand does with the stick, and how far along it is, ``(F,)`` each."""
        before, next_ = self._does[station], self._does[after]
        # A stick is turned end for end away from the head, where there is most room for it.
        free = np.where(before == CROSS_STICK, LATER, np.where(next_ == CROSS_STICK, EARLIER, 0.5))
        span = np.where(
            (before == CROSS_STICK) == (part < free), TURNED, np.where(part < free, free, 1.0 - free)
        )
        kept = minimum_jerk(np.minimum(np.abs(part - free) / span, 1.0))
        kept = np.where(before == next_, 1.0, kept)
        shape = np.where(part < free, before, next_)
        held = np.maximum(1.0 - height / STILL_M, 0.0)
        share = kept * np.where(shape == PLAY, open_, 1.0)
        share = np.where(shape == CHOKE, kept * (JAWS_SHARE + (1.0 - JAWS_SHARE) * held), share)
        if len(self._twirls):
            place = np.maximum(np.searchsorted(self._twirls, times_s, side="right") - 1, 0)
            run = np.clip((times_s - self._twirls[place]) / TWIRL_S, 0.0, 1.0)
            share = np.where(shape == TWIRL, run, share)
        return shape, share

    def _where(self, times_s: FloatArray) -> tuple[IntArray, FloatArray, FloatArray]:
        """Which station the stick is at or leaves, how far it is on its way to the next, and in its time."""
        if not len(self._moves):
            return np.zeros(len(times_s), dtype=np.intp), np.zeros(len(times_s)), np.zeros(len(times_s))
        move = np.searchsorted(self._moves[:, 0], times_s, side="right") - 1
        known = np.maximum(move, 0)
        start, end = self._moves[known, 0], self._moves[known, 1]
        part = np.where(move >= 0, (times_s - start) / np.maximum(end - start, 1e-9), 0.0)
        return np.maximum(move, 0), minimum_jerk(part), part

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
        angles = self._tilted(near, tilt)
        if not angles.any():
            return np.zeros((len(near), 3))
        turn = turned(self._outward[near], angles)
        return rotate(turn, self._arm[near]) - self._arm[near]

    def _tilted(self, near: IntArray, tilt: FloatArray) -> FloatArray:
        """How stations' cymbals are tilted, ``(F, 2)``."""
        row = self._swings[near]
        return np.where(row[:, None] >= 0, tilt[np.arange(len(near)), np.maximum(row, 0)], 0.0)

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


def _outward(station: Station, arm: FloatArray) -> FloatArray:
    given = None if station.placing is None else station.placing.outward
    return _level(arm) if given is None else given


def _level(arm: FloatArray) -> FloatArray:
    level = arm * (1.0, 0.0, 1.0)
    far = float(np.linalg.norm(level))
    return level / far if far > 1e-6 else np.zeros(3)
