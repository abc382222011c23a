"""What a living body does by itself, as functions of time and a seed: sway, quiet breath, blinks, glances."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.kinematics import minimum_jerk

if TYPE_CHECKING:
    from reina.music.score import Score
    from reina.rotations.arrays import FloatArray

QUIET_BREATH_S = 4.3
SWAY_S = (2.6, 5.2)
"""A sway to and fro takes a whole number of bars, or beats, between these times."""

WANING = 0.5
"""By what part a sway is smaller at its least."""

EARLY_OR_LATE_RAD = 0.35
"""How far a sway is before or behind the metre, of the circle that its way to and fro is."""

BLINK_SLOT_S = 3.9
BLINK_S = 0.16
GAZE_SLOT_S = 2.3
GAZE_MOVE_S = 0.09
_TABLE = 512

_SLOWER = np.array([[3.7], [2.3]])
"""How many times slower than itself a sway waxes and wanes, and comes early and late."""

_PACES = np.array([[1.0], [0.5], [1.0]])
"""Of the sways to the side, fore and aft, and about."""


class IdleMotion:
    """Idle motion of one player.

    Args:
        score: Its tempo and metre lead the sway.
        seed: Which of many equal ways of blinking and looking about.
    """

    def __init__(self, score: Score, seed: int = 0) -> None:
        self._tempo = score.tempo_map
        self._beats_per_sway = _beats_per_sway(score)
        chance = np.random.default_rng([seed, 1])
        self._blink_at: FloatArray = chance.uniform(0.0, BLINK_SLOT_S - BLINK_S, size=_TABLE)
        self._gaze: FloatArray = chance.normal(scale=0.45, size=(_TABLE, 2)).clip(-1.0, 1.0)
        self._gaze[chance.random(_TABLE) < 0.4] = 0.0
        self._offset: float = float(chance.uniform(0.0, 2.0 * np.pi))
        self._leads: FloatArray = np.array([[0.0], [self._offset], [0.9]])

    def sway(self, times_s: FloatArray) -> FloatArray:
        """To the side, fore and aft, and about: -1..1, ``(3, F)``, in time with the metre.

        Nobody sways like a pendulum: it waxes and wanes, and comes now a little early and now a little late.
        """
        phase = (2.0 * np.pi / self._beats_per_sway) * self._tempo.beats(times_s)
        slow = np.sin(phase / _SLOWER + self._offset)
        phase = phase + EARLY_OR_LATE_RAD * slow[1]
        extent = 1.0 - WANING * (0.5 + 0.5 * slow[0])
        return extent * np.sin(phase * _PACES + self._leads)

    def quiet_breath(self, times_s: FloatArray) -> FloatArray:
        """How full the chest is while nothing is played, 0..1, ``(F,)``."""
        return 0.5 - 0.5 * np.cos((2.0 * np.pi / QUIET_BREATH_S) * times_s)

    def blink(self, times_s: FloatArray) -> FloatArray:
        """How far the eyes are shut, 0..1, ``(F,)``: down in a third of the time, up in the rest."""
        slot = np.floor(times_s / BLINK_SLOT_S)
        at = self._blink_at[slot.astype(np.int64) % _TABLE]
        u = (times_s - slot * BLINK_SLOT_S - at) / BLINK_S
        return np.where(u < 1.0 / 3.0, minimum_jerk(3.0 * u), 1.0 - minimum_jerk(1.5 * u - 0.5))

    def gaze(self, times_s: FloatArray) -> FloatArray:
        """Where the eyes look: left and up, -1..1, ``(2, F)``; they jump, and rest in between."""
        slot = np.floor(times_s / GAZE_SLOT_S)
        index = slot.astype(np.int64)
        moved = minimum_jerk((times_s - slot * GAZE_SLOT_S) / GAZE_MOVE_S)
        before, after = self._gaze[(index - 1) % _TABLE], self._gaze[index % _TABLE]
        return (before + (after - before) * moved[:, None]).T


def _beats_per_sway(score: Score) -> float:
    """Two bars, halved or doubled until a sway takes a comfortable time at the score's mean tempo."""
    end_beats = float(np.max(score.notes.onset_beats + score.notes.duration_beats, initial=1.0))
    seconds_per_beat = score.duration_s / end_beats if score.duration_s > 0.0 else 0.5
    lines = score.metre_map.bar_lines(end_beats + 16.0)
    bar_beats = float(np.median(np.diff(lines))) if len(lines) > 1 else 4.0
    beats = 2.0 * bar_beats
    while beats * seconds_per_beat > SWAY_S[1]:
        beats /= 2.0
    while beats * seconds_per_beat < SWAY_S[0]:
        beats *= 2.0
    return beats
