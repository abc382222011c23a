"""Valve strokes: when each valve goes down and up, and when an idle finger lifts off its cap.

No measurement of the trumpet's valve stroke is published. From flute and saxophone, and from the time that
transcribed solos leave between fingerings: a press takes 25 to 35 ms, a release 30 to 40 ms, both are
finished just before the note that they are for, and in fast runs neither takes more than two fifths of the
time between two onsets. A valve stays down through repeated fingerings and through short rests; between
phrases it comes up.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.instruments.brass.fingering import brass_fingering
from reina.instruments.line import BREATH_S

if TYPE_CHECKING:
    from reina.instruments.played import PlayedPart
    from reina.rotations.arrays import BoolArray, FloatArray

PRESS_S = (0.035, 0.025)
"""Duration of a press at velocity 0 and at velocity 1."""

RELEASE_S = (0.040, 0.030)
"""Duration of a release at velocity 0 and at velocity 1."""

LONGEST_STROKE_S = 0.040
"""From a stroke's start to the onset that it is for, at most."""

LARGEST_SHARE = 0.4
"""Part of the time between two onsets that a stroke may take, at most."""

LEAD_S = (0.0005, 0.0045)
"""How long before the onset a finger is done, at least and at most: fingers do not land at one instant."""

AFTER_PHRASE_S = 0.02
"""How long after the end of a phrase its valves begin to come up."""

LIFT_AFTER_S = 0.35
"""A finger that is not needed for longer than this lifts off its cap meanwhile."""

LIFT_UP_S = 0.14
LIFT_DOWN_S = 0.11
LIFT_LATE_S = (0.02, 0.06)
"""How long after its valve a finger begins to lift."""

LIFT_EARLY_S = (0.01, 0.04)
"""How long before it is needed a finger is back on its cap."""

LIFT_HEIGHT = (0.5, 1.0)
"""How high it lifts."""


def plan_strokes(played: PlayedPart) -> dict[str, FloatArray]:
    """Plan all strokes of a part once.

    Args:
        played: The line and its fingering, M notes and V valves.

    Returns:
        For each valve ``valve/1`` and ``lift/1`` and so on: movements ``(start_s, end_s, value)`` as
        `MotionCurves` takes them, from 0. A valve is 0 up and 1 down; a lift is 0 on the cap and 1 off it.
    """
    line = played.line
    fingering = brass_fingering(played)
    down = fingering.valves & fingering.playable[:, None]
    curves: dict[str, FloatArray] = {}
    for valve in range(down.shape[1]):
        # Each finger has its own small unevenness, the same whenever the part is played.
        chance = np.random.default_rng([valve])
        lead_s = chance.uniform(*LEAD_S, size=len(line.onset_s))
        strokes = _strokes(line.onset_s, line.end_s, line.velocity, down[:, valve], lead_s)
        curves[f"valve/{valve + 1}"] = strokes
        curves[f"lift/{valve + 1}"] = _lifts(strokes, line.onset_s, line.end_s, chance)
    return curves


def _strokes(
    onset_s: FloatArray, end_s: FloatArray, velocity: FloatArray, down: BoolArray, lead_s: FloatArray
) -> FloatArray:
    """Movements of one valve, ``(S, 3)``."""
    if not down.any():
        return np.zeros((0, 3))
    before = np.concatenate([[False], down[:-1]])
    interval = np.diff(onset_s, prepend=-np.inf)
    rest = onset_s - np.concatenate([[-np.inf], end_s[:-1]])
    rises_in_rest = before & (rest >= BREATH_S)
    before = before & ~rises_in_rest

    # The stroke for a note ends `lead` before its onset; both shrink together where notes are dense.
    changes = before != down
    nominal = np.where(
        down,
        PRESS_S[0] + (PRESS_S[1] - PRESS_S[0]) * velocity,
        RELEASE_S[0] + (RELEASE_S[1] - RELEASE_S[0]) * velocity,
    )
    room = np.minimum(LONGEST_STROKE_S, LARGEST_SHARE * interval)
    scale = np.minimum(room / (nominal + lead_s), 1.0)
    begins, done = onset_s - (nominal + lead_s) * scale, onset_s - lead_s * scale
    strokes = np.column_stack([begins, done, down.astype(np.float64)])[changes]

    # Between phrases, and after the last note, the valve comes up by itself.
    ends = np.concatenate([end_s[:-1][rises_in_rest[1:]], end_s[-1:][down[-1:]]])
    rises = np.column_stack(
        [ends + AFTER_PHRASE_S, ends + AFTER_PHRASE_S + RELEASE_S[0], np.zeros(len(ends))]
    )
    movements = np.concatenate([strokes, rises])
    return movements[np.argsort(movements[:, 0], kind="stable")]


def _lifts(
    strokes: FloatArray, onset_s: FloatArray, end_s: FloatArray, chance: np.random.Generator
) -> FloatArray:
    """Movements of one idle finger off and back onto its cap, ``(L, 3)``."""
    if len(onset_s) == 0:
        return np.zeros((0, 3))
    up = strokes[:, 2] == 0.0
    begins = np.concatenate([[onset_s[0]], strokes[up, 1]])
    ends = np.concatenate([strokes[~up, 0], [end_s[-1]]])
    if len(strokes) and not up[-1]:
        ends = ends[:-1]  # still down after the last note
    idle = ends - begins > LIFT_AFTER_S
    begins, ends = begins[idle], ends[idle]
    begins = begins + chance.uniform(*LIFT_LATE_S, size=len(begins))
    ends = ends - chance.uniform(*LIFT_EARLY_S, size=len(ends))
    height = chance.uniform(*LIFT_HEIGHT, size=len(begins))
    lifts = np.empty((2 * len(begins), 3))
    lifts[::2] = np.column_stack([begins, begins + LIFT_UP_S, height])
    lifts[1::2] = np.column_stack([ends - LIFT_DOWN_S, ends, np.zeros(len(ends))])
    return lifts
