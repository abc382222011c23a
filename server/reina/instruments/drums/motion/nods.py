"""How a drummer's head and trunk keep the time: a nod on the beat, more so where it is loud."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from reina.kinematics.motion_curves import minimum_jerk

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.drums.hit import DrumHit
    from reina.rotations.arrays import FloatArray

SHORTEST_S: Final = 0.42
"""Beats that are shorter are nodded to one by one no more: every second one is, or every fourth."""

SOFTEST, LOUDEST = 0.4, 1.0
"""How far the nod goes for the softest and for the loudest playing."""

OFFBEAT: Final = 0.6
"""And how much of that on beats that neither snare nor cymbal accents."""

RESTING: Final = 0.5
"""How far it goes while nothing is struck."""

ON_BEAT_S: Final = 0.07
"""A stroke this near to a beat is on it."""

LEVEL_S: Final = 1.5
"""Over how long it is judged how loud the playing is."""

BEFORE_BEATS, AFTER_BEATS = 3, 2
"""The nod begins so many beats before the first stroke and ends so many after the last."""

SETTLE: Final = 0.4
"""What is taken off, so that a head that nods is not bowed the more for it."""


def nods(times_s: FloatArray, hits: Sequence[DrumHit], beats_s: FloatArray) -> FloatArray:
    """How far the nod is down, ``(F,)``: lowest on the beats, up between them; about -0.4 to 0.6.

    Args:
        times_s: Seconds, ``(F,)``.
        hits: By time.
        beats_s: When the beats fall, seconds, ascending.
    """
    if len(beats_s) < 2 or not hits:
        return np.zeros(len(times_s))
    usual = float(np.median(np.diff(beats_s)))
    step = 1 if usual >= SHORTEST_S else 2 if 2.0 * usual >= SHORTEST_S else 4
    beats = beats_s[::step]
    size = _sizes(beats, hits)
    # Each beat's own hump, from the middle before it to the middle after it, where it is 0.
    middles = 0.5 * (beats[1:] + beats[:-1])
    place = np.searchsorted(middles, times_s)
    since = times_s - beats[place]
    gaps = np.diff(beats, prepend=2.0 * beats[0] - beats[1], append=2.0 * beats[-1] - beats[-2])
    span = np.where(since < 0.0, gaps[place], gaps[place + 1])
    phase = np.clip(since / np.maximum(span, 1e-6), -0.5, 0.5)
    hump = (0.5 + 0.5 * np.cos(2.0 * np.pi * phase)) ** 2
    level = np.interp(times_s, beats, size)
    return hump * size[place] - SETTLE * level


def loudness(times_s: FloatArray, hits: Sequence[DrumHit]) -> FloatArray:
    """How loud the playing is about times ``(F,)``: 0 where nothing is struck, at most 1."""
    if not hits:
        return np.zeros(len(times_s))
    at = np.array([hit.onset_s for hit in hits])
    loud = np.concatenate([[0.0], np.cumsum([hit.velocity**2 for hit in hits])])
    count = np.arange(len(hits) + 1)
    first, last = (np.searchsorted(at, times_s + side * LEVEL_S) for side in (-1.0, 1.0))
    struck = count[last] - count[first]
    return np.sqrt((loud[last] - loud[first]) / np.maximum(struck, 1))


def _sizes(beats: FloatArray, hits: Sequence[DrumHit]) -> FloatArray:
    """How far the nod goes on each beat."""
    level = loudness(beats, hits)
    size = np.where(level > 0.0, SOFTEST + (LOUDEST - SOFTEST) * level, RESTING)
    accents = np.array(
        [hit.onset_s for hit in hits if hit.piece != "hi_hat" and hit.piece != "ride" and hit.velocity > 0.3]
    )
    on_beat = np.zeros(len(beats), dtype=np.bool_)
    if len(accents):
        near = np.clip(np.searchsorted(accents, beats), 1, max(len(accents) - 1, 1))
        pair = accents[np.minimum(np.stack([near - 1, near]), len(accents) - 1)]
        on_beat = np.abs(pair - beats).min(axis=0) < ON_BEAT_S
    size = size * np.where(on_beat | (level == 0.0), 1.0, OFFBEAT)
    beat_s = float(np.median(np.diff(beats)))
    begin = hits[0].onset_s - BEFORE_BEATS * beat_s
    end = hits[-1].onset_s + AFTER_BEATS * beat_s
    return (
        size
        * minimum_jerk((beats - begin) / (2.0 * beat_s))
        * (1.0 - minimum_jerk((beats - end + 2.0 * beat_s) / (2.0 * beat_s)))
    )
