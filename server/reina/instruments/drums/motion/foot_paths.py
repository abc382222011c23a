"""What the feet do at any times: pedals down and up, heels lifted, the bass drum's beater."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

from reina.instruments.drums.motion.stick_plan import CONTACT_S, EARLY_S
from reina.kinematics.motion_curves import minimum_jerk

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.drums.hit import DrumHit
    from reina.instruments.drums.motion.kit_answers import KitAnswers
    from reina.rotations.arrays import FloatArray, IntArray

SWING_S: Final = 0.1
"""What the beater takes to the head, at most."""

RETURN_S: Final = 0.13
"""And back."""

SHARE: Final = 0.45
"""Neither takes more than this part of the time between two strokes."""

HEEL_S: Final = 0.22
"""The heel comes up so long before a stroke."""

LOUD: Final = 0.35
"""Strokes that are louder are played with the heel up."""

BEAT_HEEL: Final = 0.3
"""How much of a stroke's lift a foot keeps the time with that has nothing else to do."""

IDLE_S: Final = 0.9
"""A foot keeps the time where its strokes are this far."""


@dataclass(frozen=True, eq=False)
class FootFrames:
    """Both feet in F frames; index 0 is the right foot of a right-handed player.

    Attributes:
        pedal: ``(F, 2)`` how far each foot has its pedal down: 0 up, 1 down.
        heel: ``(F, 2)`` how far its heel is up: 0 down, 1 as far as for the loudest stroke.
        beater: ``(F,)`` the bass drum's: 0 back, 1 on the head.
    """

    pedal: FloatArray
    heel: FloatArray
    beater: FloatArray


class FootPaths:
    """The feet of a part; a pure function of times.

    Args:
        hits: By time; those of feet count, in a right-handed player's names.
        answers: What the kit does: the left foot goes with the hi-hat's pedal.
        beats_s: When the beats fall, seconds, ascending: feet that are idle keep the time by them.
    """

    def __init__(
        self, hits: Sequence[DrumHit], answers: KitAnswers, beats_s: FloatArray | None = None
    ) -> None:
        self._answers = answers
        feet = [[hit for hit in hits if hit.limb == limb] for limb in ("right_foot", "left_foot")]
        kicks = [_Pedal([hit for hit in foot if hit.piece == "kick"]) for foot in feet]
        self._kicks = kicks
        self._all = [_Pedal(foot) for foot in feet]
        self._beats = np.zeros(0) if beats_s is None else beats_s
        hands = [hit.onset_s for hit in hits]
        self._span = (min(hands, default=0.0), max(hands, default=0.0))

    def evaluate(self, times_s: FloatArray) -> FootFrames:
        """Both feet at times ``(F,)``."""
        down = [kick.depth(times_s) for kick in self._kicks]
        closed = self._answers.hi_hat(times_s)
        idle = [self._tap(times_s, pedal) for pedal in self._all]
        heel = [np.maximum(pedal.heel(times_s), tap) for pedal, tap in zip(self._all, idle, strict=True)]
        return FootFrames(
            pedal=np.stack([down[0], np.maximum(closed, down[1])], axis=1),
            heel=np.stack(heel, axis=1),
            beater=np.maximum(down[0], down[1]),
        )

    def _tap(self, times_s: FloatArray, pedal: _Pedal) -> FloatArray:
        """The heel of an idle foot, up between the beats and down on them."""
        if len(self._beats) < 2:
            return np.zeros(len(times_s))
        place = np.clip(np.searchsorted(self._beats, times_s, side="right") - 1, 0, len(self._beats) - 2)
        begin, end = self._beats[place], self._beats[place + 1]
        u = np.clip((times_s - begin) / np.maximum(end - begin, 1e-6), 0.0, 1.0)
        playing = (times_s >= self._span[0]) & (times_s <= self._span[1])
        return BEAT_HEEL * np.sin(np.pi * u) ** 2 * playing * pedal.idleness(times_s)


class _Pedal:
    """The strokes of one foot."""

    def __init__(self, hits: Sequence[DrumHit]) -> None:
        self._at = np.array([hit.onset_s for hit in hits])
        self._loud = np.array([hit.velocity for hit in hits])
        gaps = np.diff(self._at, prepend=-np.inf, append=np.inf)
        self._before, self._after = gaps[:-1], gaps[1:]

    def depth(self, times_s: FloatArray) -> FloatArray:
        """How far the beater is on its way to the head, 0 to 1."""
        if not len(self._at):
            return np.zeros(len(times_s))
        value = np.zeros(len(times_s))
        for nearest in self._around(times_s):
            at, before, after = self._at[nearest], self._before[nearest], self._after[nearest]
            lands = at - np.minimum(EARLY_S, 0.3 * before)
            swing = np.minimum(SWING_S, SHARE * before)
            leaves = at + np.minimum(CONTACT_S, 0.1 * after)
            back = np.minimum(RETURN_S, SHARE * after)
            to = np.clip(1.0 - (lands - times_s) / swing, 0.0, 1.0) ** 2.2
            gone = minimum_jerk((times_s - leaves) / back)
            value = np.maximum(value, np.where(times_s <= leaves, to, 1.0 - gone))
        return value

    def heel(self, times_s: FloatArray) -> FloatArray:
        """How far the heel is up, 0 to 1: for loud strokes."""
        if not len(self._at):
            return np.zeros(len(times_s))
        value = np.zeros(len(times_s))
        for nearest in self._around(times_s):
            at = self._at[nearest]
            size = np.clip((self._loud[nearest] - LOUD) / (1.0 - LOUD), 0.0, 1.0)
            up = minimum_jerk((times_s - at + HEEL_S) / (0.6 * HEEL_S))
            down = minimum_jerk((times_s - at + 0.4 * HEEL_S) / (0.4 * HEEL_S))
            value = np.maximum(value, size * up * (1.0 - 0.7 * down) * (times_s < at + HEEL_S))
            settle = 0.3 * (1.0 - minimum_jerk((times_s - at) / HEEL_S))
            value = np.maximum(value, np.where(times_s >= at, size * settle, 0.0))
        return value

    def idleness(self, times_s: FloatArray) -> FloatArray:
        """1 where no stroke is near, 0 at one."""
        if not len(self._at):
            return np.ones(len(times_s))
        near = np.minimum.reduce([np.abs(times_s - self._at[nearest]) for nearest in self._around(times_s)])
        return minimum_jerk((near - 0.5 * IDLE_S) / (0.5 * IDLE_S))

    def _around(self, times_s: FloatArray) -> list[IntArray]:
        after = np.searchsorted(self._at, times_s)
        last = len(self._at) - 1
        return [np.clip(after - 1, 0, last), np.clip(after, 0, last)]
