"""What a trumpeter does besides fingering: breath, air, tongue, phrasing, vibrato, horn up and down.

Every gesture is planned once, as movements on the time axis; a performance only evaluates them. Values are
unit-free: what a full breath or a full lean looks like on a body is the performance's to say.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from reina.instruments.line import BREATH_S
from reina.instruments.brass.strokes import plan_strokes

if TYPE_CHECKING:
    from collections.abc import Iterable

    from reina.instruments.played import PlayedPart
    from reina.rotations.arrays import FloatArray

Curve: TypeAlias = "tuple[FloatArray, float]"
"""Movements ``(start_s, end_s, value)``, ``(M, 3)``, and the value before the first."""

LOWERING_REST_S = 6.0
"""In rests of at least this length the trumpet is taken down."""

LOWER_AFTER_S = 1.0
LOWER_S = 1.2
RAISE_S = 1.1
RAISED_BEFORE_S = 0.8
"""The trumpet is back at the lips this long before the next note."""

LEANING_PHRASE_S = 1.0
"""Nobody leans into less."""

SHORTEST_PHRASE_S = 2.0
"""No breath is taken before a phrase has lasted this long, unless the rest is long."""

LONG_REST_S = 1.2
"""A rest of this length ends a phrase however short it was."""

VIBRATO_NOTE_S = 0.7
"""Notes of at least this length are given vibrato."""

TONGUED_REST_S = 0.015
"""Notes of different pitch with less than this between them are slurred."""

MIDDLE_PITCH = 68.0
PITCH_SPAN = 16.0
"""Effort is 0 at the middle pitch (sounding) and 1 this many semitones above."""

EFFORT_WINDOW_S = 0.9

LARGEST_SLIDE_SHARE = 0.6
"""Part of the time between two onsets that the slide may take to move, at most."""


@dataclass(frozen=True, eq=False)
class Phrases:
    """P stretches between breaths, as columns: all of what sounds, in order."""

    start_s: FloatArray
    end_s: FloatArray
    loudness: FloatArray
    """Mean velocity."""
    rest_before_s: FloatArray
    rest_after_s: FloatArray


def plan_gestures(played: PlayedPart, *, seed: int = 0) -> dict[str, Curve]:
    """Plan everything that the trumpeter does.

    Args:
        played: The line and its fingering.
        seed: Varies what no score says: how far a phrase leans and to which side.

    Returns:
        Curves by name. ``valve/n`` and ``lift/n`` as `plan_strokes`; ``slide/3``; ``raised`` 1 with the
        horn at the lips; ``playing`` 1 in phrases and short rests; ``breath`` how full the chest is;
        ``inhale`` 1 while air is drawn; ``air`` how hard it blows; ``tongue`` 1 as a note is tongued;
        ``effort`` -1 low to 1 high; ``lean`` -1 back to 1 forward; ``turn`` to the left and right;
        ``vibrato`` 1 at its widest.
    """
    curves: dict[str, Curve] = {name: (table, 0.0) for name, table in plan_strokes(played).items()}
    phrases = _phrases(played)
    lowered_first = len(phrases.start_s) == 0 or phrases.start_s[0] > LOWERING_REST_S
    jitter = np.random.default_rng([seed, len(phrases.start_s)]).uniform(
        -1.0, 1.0, size=(len(phrases.start_s), 2)
    )
    curves |= {
        "slide/3": (_slide(played), 0.0),
        "raised": (_raised(phrases), 0.0 if lowered_first else 1.0),
        "playing": (_playing(phrases), 0.0),
        "breath": (_breath(phrases), 0.0),
        "inhale": (_inhale(phrases), 0.0),
        "air": (_air(played, phrases), 0.0),
        "tongue": (_tongue(played), 0.0),
        "effort": (_effort(played, phrases), 0.0),
        "lean": (_lean(phrases, jitter[:, 0]), 0.0),
        "turn": (_turn(phrases, jitter[:, 1]), 0.0),
        "vibrato": (_vibrato(played), 0.0),
    }
    return curves


def _phrases(played: PlayedPart) -> Phrases:
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


def _raised(phrases: Phrases) -> FloatArray:
    """Down in long rests, at the beginning where the first note is far, and after the last."""
    lower = phrases.rest_after_s >= LOWERING_REST_S
    raise_ = (phrases.rest_before_s >= LOWERING_REST_S) & (phrases.start_s > LOWERING_REST_S)
    down, up = phrases.end_s[lower] + LOWER_AFTER_S, phrases.start_s[raise_] - RAISED_BEFORE_S
    return _in_order([_movements(down, LOWER_S, 0.0), _movements(up - RAISE_S, RAISE_S, 1.0)])


def _playing(phrases: Phrases) -> FloatArray:
    """1 from shortly before a phrase to shortly after; rests under three seconds count as playing."""
    rests = phrases.rest_after_s >= 3.0
    starts = np.concatenate([[True], rests[:-1]]) if len(rests) else rests
    return _in_order(
        [
            _movements(phrases.start_s[starts] - 1.3, 1.2, 1.0),
            _movements(phrases.end_s[rests] + 0.2, 1.3, 0.0),
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
    return _in_order([_movements(begin, duration, depth), _movements(phrases.start_s, spent, 0.0)])


def _inhale(phrases: Phrases) -> FloatArray:
    begin, duration = _inhalations(phrases)
    shut = begin + 0.65 * duration
    return _in_order([_movements(begin, 0.4 * duration, 1.0), _movements(shut, 0.35 * duration, 0.0)])


def _air(played: PlayedPart, phrases: Phrases) -> FloatArray:
    """Rises to each note's loudness just before it, slackens in short rests, ends with the phrase."""
    sounding = played.fingering.playable
    onset, end = played.line.onset_s[sounding], played.line.end_s[sounding]
    attack = np.minimum(0.05, 0.4 * np.diff(onset, prepend=-np.inf))
    strength = 0.35 + 0.65 * played.line.velocity[sounding]
    slack = end[:-1][onset[1:] - end[:-1] > 0.2]
    slack = slack[~np.isin(slack, phrases.end_s)]
    return _in_order(
        [
            _movements(onset - attack, attack, strength),
            _movements(slack, 0.1, 0.2),
            _movements(phrases.end_s, 0.12, 0.0),
        ]
    )


def _tongue(played: PlayedPart) -> FloatArray:
    """A touch before each tongued note; double tonguing is too quick to be seen and left out."""
    line = played.line
    interval = np.diff(line.onset_s, prepend=-np.inf)
    rest = line.onset_s - np.concatenate([[-np.inf], line.end_s[:-1]])
    same = np.concatenate([[False], line.sounding_pitch[1:] == line.sounding_pitch[:-1]])
    following = np.concatenate([interval[1:], [np.inf]])
    room = np.minimum(interval, following) > 0.11
    tongued = played.fingering.playable & room & (same | (rest > TONGUED_REST_S))
    onset = line.onset_s[tongued]
    return _in_order([_movements(onset - 0.045, 0.035, 1.0), _movements(onset - 0.005, 0.05, 0.0)])


def _effort(played: PlayedPart, phrases: Phrases) -> FloatArray:
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
    height = np.clip((played.line.sounding_pitch[sounding] - MIDDLE_PITCH) / PITCH_SPAN, -1.0, 1.0)
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
    settle = _movements(phrases.end_s, np.minimum(0.45 * phrases.rest_after_s, 1.2), 0.0)
    return _in_order([rise, settle])


def _lean(phrases: Phrases, jitter: FloatArray) -> FloatArray:
    """Back with the breath, forward into the phrase and most so past its middle, settled at its end."""
    begin, duration = _inhalations(phrases)
    length = phrases.end_s - phrases.start_s
    reach = (0.35 + 0.65 * phrases.loudness) * (1.0 + 0.3 * jitter) * np.minimum(length / 2.5, 1.0)
    climax = phrases.start_s + 0.6 * length
    settled = phrases.end_s + np.minimum(0.2 * phrases.rest_after_s, 1.5)
    leans = length >= LEANING_PHRASE_S
    return _in_order(
        [
            _movements(begin, duration, -0.35 * np.minimum(duration / 0.5, 1.0))[leans],
            np.column_stack([phrases.start_s, climax, reach])[leans],
            np.column_stack([climax, settled, np.zeros(len(climax))])[leans],
        ]
    )


def _turn(phrases: Phrases, jitter: FloatArray) -> FloatArray:
    """A phrase is played a little to one side, slowly taken."""
    length = phrases.end_s - phrases.start_s
    side = jitter * np.minimum(length / 4.0, 1.0)
    return np.column_stack([phrases.start_s, phrases.end_s, side])[length >= LEANING_PHRASE_S]


def _vibrato(played: PlayedPart) -> FloatArray:
    line = played.line
    length = line.end_s - line.onset_s
    long = played.fingering.playable & (length >= VIBRATO_NOTE_S)
    onset, end, length = line.onset_s[long], line.end_s[long], length[long]
    rise = np.minimum(0.5, 0.35 * length)
    return _in_order(
        [_movements(onset + 0.3 * np.minimum(length, 1.2), rise, 1.0), _movements(end - 0.12, 0.12, 0.0)]
    )


def _slide(played: PlayedPart) -> FloatArray:
    """The third slide is out for the notes that ask for it, moved in the time before them."""
    line, slide = played.line, played.fingering.slide
    before = np.concatenate([[0.0], slide[:-1]])
    moves = slide != before
    interval = np.diff(line.onset_s, prepend=-np.inf)
    duration = np.minimum(0.14, LARGEST_SLIDE_SHARE * interval)[moves]
    return np.column_stack([line.onset_s[moves] - duration, line.onset_s[moves], slide[moves]])


def _movements(start_s: FloatArray, duration_s: FloatArray | float, value: FloatArray | float) -> FloatArray:
    """Movements ``(M, 3)`` from their starts and durations."""
    table = np.empty((len(start_s), 3))
    table[:, 0] = start_s
    table[:, 1] = start_s + duration_s
    table[:, 2] = value
    return table


def _in_order(tables: Iterable[FloatArray]) -> FloatArray:
    """Movements of several kinds in order of time, each cut where the next begins."""
    table = np.concatenate(list(tables))
    table = table[np.argsort(table[:, 0], kind="stable")]
    table[:-1, 1] = np.minimum(table[:-1, 1], table[1:, 0])
    return table
