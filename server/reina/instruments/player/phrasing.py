"""Phrasing: where a player breathes, how a phrase is leaned into, and how high it lies.

Planned once, as movements on the time axis. Values are unit-free: what a full breath or a full lean
looks like on a body is the body's to say.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.instruments.line import BREATH_S

if TYPE_CHECKING:
    from collections.abc import Iterable

    from reina.instruments.played import PlayedPart
    from reina.kinematics import Curve
    from reina.rotations.arrays import FloatArray

LEANING_PHRASE_S = 1.0
"""Nobody leans into less."""

SHORTEST_PHRASE_S = 2.0
"""No breath is taken before a phrase has lasted this long, unless the rest is long."""

LONG_REST_S = 1.2
"""A rest of this length ends a phrase however short it was."""

EFFORT_WINDOW_S = 0.9

PITCH_SPAN = 16.0
"""Effort is 0 at the middle pitch (sounding) and 1 this many semitones above."""


@dataclass(frozen=True, eq=False)
class Phrases:
    """P stretches between breaths, as columns: all of what sounds, in order."""

    start_s: FloatArray
    end_s: FloatArray
    loudness: FloatArray
    """Mean velocity."""
    rest_before_s: FloatArray
    rest_after_s: FloatArray


def plan_phrasing(
    played: PlayedPart, phrases: Phrases, *, middle_pitch: float, seed: int = 0
) -> dict[str, Curve]:
    """Plan how a player moves with the phrases.

    Args:
        played: The line.
        phrases: Its phrases.
        middle_pitch: The pitch that asks for neither much nor little effort, MIDI number as it sounds.
        seed: Varies what no score says: how far a phrase leans and to which side.

    Returns:
        Curves by name: ``playing`` 1 in phrases and short rests; ``effort`` -1 low to 1 high; ``lean`` -1
        back to 1 forward; ``turn`` to the left and right.
    """
    count = len(phrases.start_s)
    jitter = np.random.default_rng([seed, count]).uniform(-1.0, 1.0, size=(count, 2))
    return {
        "playing": (_playing(phrases), 0.0),
        "effort": (_effort(played, phrases, middle_pitch), 0.0),
        "lean": (_lean(phrases, jitter[:, 0]), 0.0),
        "turn": (_turn(phrases, jitter[:, 1]), 0.0),
    }


def plan_breath(phrases: Phrases) -> dict[str, Curve]:
    """Plan how whoever blows breathes.

    Returns:
        Curves by name: ``breath`` how full the chest is; ``inhale`` 1 while air is drawn.
    """
    return {"breath": (_breath(phrases), 0.0), "inhale": (_inhale(phrases), 0.0)}


def phrases_of(played: PlayedPart) -> Phrases:
    """What sounds, from breath to breath."""
    sounding = played.fingering.playable
    onset, end = played.line.onset_s[sounding], played.line.end_s[sounding]
    if len(onset) == 0:
        empty = np.zeros(0)
        return Phrases(empty, empty, empty, empty, empty)
    rests = np.concatenate([[np.inf], onset[1:] - end[:-1]])
    first = rests >= LONG_REST_S
    begun = onset[0]
    for note in np.flatnonzero(rests >= BREATH_S).tolist():
        first[note] |= onset[note] - begun >= SHORTEST_PHRASE_S
        if first[note]:
            begun = onset[note]
    last = np.concatenate([first[1:], [True]])
    number = np.cumsum(first) - 1
    loudness = np.bincount(number, played.line.velocity[sounding]) / np.bincount(number)
    return Phrases(
        start_s=onset[first],
        end_s=end[last],
        loudness=loudness,
        rest_before_s=rests[first],
        rest_after_s=np.concatenate([rests[first][1:], [np.inf]]),
    )


def _playing(phrases: Phrases) -> FloatArray:
    """1 from shortly before a phrase to shortly after; rests under three seconds count as playing."""
    rests = phrases.rest_after_s >= 3.0
    starts = np.concatenate([[True], rests[:-1]]) if len(rests) else rests
    return in_order(
        [
            movements(phrases.start_s[starts] - 1.3, 1.2, 1.0),
            movements(phrases.end_s[rests] + 0.2, 1.3, 0.0),
        ]
    )


def _inhalations(phrases: Phrases) -> tuple[FloatArray, FloatArray]:
    """When air is drawn before each phrase: begin and duration."""
    duration = np.clip(0.75 * phrases.rest_before_s, 0.18, 0.9)
    return phrases.start_s - 0.03 - duration, duration


def _breath(phrases: Phrases) -> FloatArray:
    """Filled before a phrase by as much as it will take, spent along it."""
    begin, duration = _inhalations(phrases)
    length = phrases.end_s - phrases.start_s
    depth = np.clip(0.45 + length / 9.0, 0.5, 1.0)
    spent = np.minimum(np.maximum(length, 0.5), length + 0.2 * np.minimum(phrases.rest_after_s, 1.0))
    return in_order([movements(begin, duration, depth), movements(phrases.start_s, spent, 0.0)])


def _inhale(phrases: Phrases) -> FloatArray:
    begin, duration = _inhalations(phrases)
    shut = begin + 0.65 * duration
    return in_order([movements(begin, 0.4 * duration, 1.0), movements(shut, 0.35 * duration, 0.0)])


def _effort(played: PlayedPart, phrases: Phrases, middle_pitch: float) -> FloatArray:
    """The pitch, as slowly as a body follows it: means over windows of about a second within each phrase."""
    if len(phrases.start_s) == 0:
        return np.zeros((0, 3))
    sounding = played.fingering.playable
    onset, end = played.line.onset_s[sounding], played.line.end_s[sounding]
    weight = np.maximum(end - onset, 1e-3)
    length = phrases.end_s - phrases.start_s
    windows = np.maximum(np.round(length / EFFORT_WINDOW_S), 1).astype(np.int64)
    phrase = np.searchsorted(phrases.start_s, onset, side="right") - 1
    share = (onset - phrases.start_s[phrase]) / np.maximum(length[phrase], 1e-9)
    first = np.concatenate([[0], np.cumsum(windows)[:-1]])
    window = first[phrase] + np.minimum((share * windows[phrase]).astype(np.int64), windows[phrase] - 1)
    height = np.clip((played.line.sounding_pitch[sounding] - middle_pitch) / PITCH_SPAN, -1.0, 1.0)
    count = int(windows.sum())
    total = np.bincount(window, weight, minlength=count)
    filled = total > 0.0
    mean = np.bincount(window, weight * height, minlength=count)[filled] / total[filled]
    of_phrase = np.repeat(np.arange(len(windows)), windows)[filled]
    place = (np.arange(count) - first.repeat(windows))[filled] + 0.5
    step = (length / windows)[of_phrase]
    centre = phrases.start_s[of_phrase] + place * step
    opening = np.concatenate([[True], of_phrase[1:] != of_phrase[:-1]])
    before = np.minimum(0.45 * phrases.rest_before_s, 0.6)[of_phrase]
    begin = np.where(opening, phrases.start_s[of_phrase] - before, np.concatenate([[0.0], centre[:-1]]))
    finish = np.where(opening, np.minimum(phrases.start_s[of_phrase] + 0.3 * step, centre), centre)
    rise = np.column_stack([begin, finish, mean])
    settle = movements(phrases.end_s, np.minimum(0.45 * phrases.rest_after_s, 1.2), 0.0)
    return in_order([rise, settle])


def _lean(phrases: Phrases, jitter: FloatArray) -> FloatArray:
    """Back with the breath, forward into the phrase and most so past its middle, settled at its end."""
    begin, duration = _inhalations(phrases)
    length = phrases.end_s - phrases.start_s
    reach = (0.35 + 0.65 * phrases.loudness) * (1.0 + 0.3 * jitter) * np.minimum(length / 2.5, 1.0)
    climax = phrases.start_s + 0.6 * length
    settled = phrases.end_s + np.minimum(0.2 * phrases.rest_after_s, 1.5)
    leans = length >= LEANING_PHRASE_S
    return in_order(
        [
            movements(begin, duration, -0.35 * np.minimum(duration / 0.5, 1.0))[leans],
            np.column_stack([phrases.start_s, climax, reach])[leans],
            np.column_stack([climax, settled, np.zeros(len(climax))])[leans],
        ]
    )


def _turn(phrases: Phrases, jitter: FloatArray) -> FloatArray:
    """A phrase is played a little to one side, slowly taken."""
    length = phrases.end_s - phrases.start_s
    side = jitter * np.minimum(length / 4.0, 1.0)
    return np.column_stack([phrases.start_s, phrases.end_s, side])[length >= LEANING_PHRASE_S]


def movements(start_s: FloatArray, duration_s: FloatArray | float, value: FloatArray | float) -> FloatArray:
    """Movements ``(M, 3)`` from their starts and durations."""
    table = np.empty((len(start_s), 3))
    table[:, 0] = start_s
    table[:, 1] = start_s + duration_s
    table[:, 2] = value
    return table


def in_order(tables: Iterable[FloatArray]) -> FloatArray:
    """Movements of several kinds in order of time, each cut where the next begins."""
    table = np.concatenate(list(tables))
    table = table[np.argsort(table[:, 0], kind="stable")]
    table[:-1, 1] = np.minimum(table[:-1, 1], table[1:, 0])
    return table
