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
    from reina.instruments.drums.motion.kit_answers import KitAnswers, KitFrames
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


_HEEL_BEGINS: Final = np.array([HEEL_S, 0.4 * HEEL_S, 0.0]).reshape(3, 1, 1, 1)
_HEEL_TAKES: Final = np.array([0.6 * HEEL_S, 0.4 * HEEL_S, HEEL_S]).reshape(3, 1, 1, 1)
"""When a heel comes up, goes down by most and by the rest: so long before a stroke, for so long."""


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
        kicks = [[hit for hit in foot if hit.piece == "kick"] for foot in feet]
        self._strokes = _Strokes([*kicks, *feet])
        self._beats = np.zeros(0) if beats_s is None else beats_s
        hands = [hit.onset_s for hit in hits]
        self._span = (min(hands, default=0.0), max(hands, default=0.0))

    def evaluate(self, times_s: FloatArray, kit: KitFrames | None = None) -> FootFrames:
        """Both feet at times ``(F,)``; what the kit does then may be given."""
        closed = self._answers.hi_hat(times_s) if kit is None else kit.hi_hat
        near = self._strokes.around(times_s)
        down = self._strokes.depth(times_s, near[:, :2])
        heel = self._strokes.heel(times_s, near[:, 2:])
        if len(self._beats) > 1:
            heel = np.maximum(heel, self._tap(times_s) * self._strokes.idleness(times_s, near[:, 2:]))
        return FootFrames(
            pedal=np.stack([down[0], np.maximum(closed, down[1])], axis=1),
            heel=np.ascontiguousarray(heel.T),
            beater=np.maximum(down[0], down[1]),
        )

    def _tap(self, times_s: FloatArray) -> FloatArray:
        """The heel of an idle foot, up between the beats and down on them, ``(F,)``."""
        place = self._beats.searchsorted(times_s, side="right") - 1
        place = np.minimum(np.maximum(place, 0), len(self._beats) - 2)
        begin, end = self._beats[place], self._beats[place + 1]
        u = np.minimum(np.maximum((times_s - begin) / np.maximum(end - begin, 1e-6), 0.0), 1.0)
        playing = (times_s >= self._span[0]) & (times_s <= self._span[1])
        return BEAT_HEEL * np.sin(np.pi * u) ** 2 * playing


class _Strokes:
    """The strokes of R feet or pedals, evaluated together.

    Args:
        rows: Of each the hits, by time.
    """

    def __init__(self, rows: Sequence[Sequence[DrumHit]]) -> None:
        at_s = [np.array([hit.onset_s for hit in row]) for row in rows]
        self._starts = at_s
        # Every row lies between two silent strokes before and after all time.
        lengths = [0, *(len(at) + 2 for at in at_s)]
        self._offsets: IntArray = np.cumsum(lengths, dtype=np.intp)[:-1, None]
        self._at: FloatArray = np.concatenate([part for at in at_s for part in ([-np.inf], at, [np.inf])])
        loud = [part for row in rows for part in ([0.0], [hit.velocity for hit in row], [0.0])]
        gaps = [np.diff(at, prepend=-np.inf, append=np.inf) for at in at_s]
        before = np.concatenate([part for gap in gaps for part in ([np.inf], gap[:-1], [np.inf])])
        after = np.concatenate([part for gap in gaps for part in ([np.inf], gap[1:], [np.inf])])
        self._lands: FloatArray = self._at - np.minimum(EARLY_S, 0.3 * before)
        self._swing: FloatArray = np.minimum(SWING_S, SHARE * before)
        self._leaves: FloatArray = self._at + np.minimum(CONTACT_S, 0.1 * after)
        self._back: FloatArray = np.minimum(RETURN_S, SHARE * after)
        self._size: FloatArray = np.clip((np.concatenate(loud) - LOUD) / (1.0 - LOUD), 0.0, 1.0)

    def around(self, times_s: FloatArray) -> IntArray:
        """The strokes before and after each time, ``(2, R, F)``."""
        near = np.empty((2, len(self._starts), len(times_s)), dtype=np.intp)
        for row, starts in enumerate(self._starts):
            near[0, row] = starts.searchsorted(times_s)
        near[0] += self._offsets
        np.add(near[0], 1, out=near[1])
        return near

    def depth(self, times_s: FloatArray, near: IntArray) -> FloatArray:
        """How far a beater is on its way to the head, 0 to 1, ``(R, F)``."""
        leaves = self._leaves[near]
        to = 1.0 - (self._lands[near] - times_s) / self._swing[near]
        to = np.minimum(np.maximum(to, 0.0), 1.0) ** 2.2
        gone = minimum_jerk((times_s - leaves) / self._back[near])
        value = np.where(times_s <= leaves, to, 1.0 - gone)
        return np.maximum(value[0], value[1])

    def heel(self, times_s: FloatArray, near: IntArray) -> FloatArray:
        """How far a heel is up, 0 to 1, ``(R, F)``: for loud strokes."""
        since = times_s - self._at[near]
        up, down, settled = minimum_jerk((since + _HEEL_BEGINS) / _HEEL_TAKES)
        value = np.where(since >= 0.0, np.maximum(0.3 * (1.0 - settled), 0.0), 0.0)
        value = np.maximum(value, up * (1.0 - 0.7 * down) * (since < HEEL_S))
        value *= self._size[near]
        return np.maximum(value[0], value[1])

    def idleness(self, times_s: FloatArray, near: IntArray) -> FloatArray:
        """1 where no stroke is near, 0 at one, ``(R, F)``."""
        since = np.abs(times_s - self._at[near])
        return minimum_jerk((np.minimum(since[0], since[1]) - 0.5 * IDLE_S) / (0.5 * IDLE_S))
