"""Stretches of a score that are heard, put together to the map of the whole."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from reina.sound.alignment.alignment import Gap, MapPoint
from reina.sound.alignment.chords import HeardStretch
from reina.sound.alignment.score_bands import Times
from reina.sound.alignment.segments import SMALLEST_GAP_S

CONFIDENCE_REACH_S = 2.5
"""How sure a place is, is the mean of the chords within so long on either side."""

LONG_WAY_S = 2.0
"""Over more than that a stretch goes on in the tempo of as long beside it."""


@dataclass(frozen=True)
class Assembled:
    """The map of the whole: its points, and what either leaves out."""

    points: tuple[MapPoint, ...]
    gaps: tuple[Gap, ...]


def assemble(
    stretches: list[HeardStretch],
    *,
    first_onset_s: float,
    last_onset_s: float,
    end_s: float,
    song_duration_s: float,
    tones_s: tuple[float, float] | None = None,
) -> Assembled:
    """Put stretches together.

    Drums are not listened for. Where they play alone before the first tone or after the last, they are taken
    to be heard in the tempo beside them, if the recording has the time for it.

    Args:
        stretches: At least one, in order.
        first_onset_s: Where the score's first note begins.
        last_onset_s: Where its last one begins.
        end_s: Where it ends.
        song_duration_s: Length of the recording.
        tones_s: Where the first and the last note begin that are no drums; None if they are the score's.
    """
    head, tail = stretches[0], stretches[-1]
    if tones_s is not None and head.line_s[0] >= _alone_s(head, 0, first_onset_s) - SMALLEST_GAP_S:
        first_onset_s = tones_s[0]
    left_s = song_duration_s - float(tail.line_s[-1])
    if tones_s is not None and left_s >= _alone_s(tail, -1, last_onset_s) - SMALLEST_GAP_S:
        last_onset_s = tones_s[1]
    edges = _edges(stretches, first_onset_s, last_onset_s)
    trimmed = [
        stretch.trimmed(at_start=edges[index], at_end=edges[index + 1])
        for index, stretch in enumerate(stretches)
    ]
    score_s = np.concatenate([stretch.knots_s for stretch in trimmed])
    song_s = np.concatenate([stretch.line_s for stretch in trimmed])
    confidence = np.concatenate([_confidence(stretch) for stretch in trimmed])
    gaps = [
        _gap(before, after) for index, (before, after) in enumerate(pairwise(trimmed)) if edges[index + 1]
    ]
    head, tail = trimmed[0], trimmed[-1]
    if edges[0]:
        gaps.insert(0, Gap(0.0, float(head.knots_s[0]), float(head.line_s[0]), float(head.line_s[0])))
        before = (0.0, float(head.line_s[0]))
    else:
        before = (0.0, float(head.line_s[0]) - _alone_s(head, 0, 0.0))
    if edges[-1]:
        gaps.append(Gap(float(tail.knots_s[-1]), end_s, float(tail.line_s[-1]), float(tail.line_s[-1])))
        after = (end_s, float(tail.line_s[-1]))
    else:
        after = (max(end_s, float(tail.knots_s[-1])), float(tail.line_s[-1]) + _alone_s(tail, -1, end_s))
    score_s = np.concatenate(([before[0]], score_s, [after[0]]))
    song_s = np.concatenate(([before[1]], song_s, [after[1]]))
    confidence = np.concatenate(([confidence[0]], confidence, [confidence[-1]]))
    kept = np.concatenate(([True], (np.diff(score_s) > 1e-9) | (np.diff(song_s) > 1e-9)))
    score_s = np.maximum.accumulate(score_s[kept])
    song_s = np.maximum.accumulate(np.clip(song_s[kept], 0, song_duration_s))
    columns = zip(score_s.tolist(), song_s.tolist(), confidence[kept].tolist(), strict=True)
    return Assembled(tuple(MapPoint(*column) for column in columns), tuple(gaps))


def _edges(stretches: list[HeardStretch], first_onset_s: float, last_onset_s: float) -> list[bool]:
    """Whether something is left out before each stretch, and after the last."""
    between = [
        max(after.knots_s[0] - before.knots_s[-1], after.line_s[0] - before.line_s[-1]) > SMALLEST_GAP_S
        for before, after in pairwise(stretches)
    ]
    return [
        bool(stretches[0].knots_s[0] - first_onset_s > SMALLEST_GAP_S),
        *(bool(gap) for gap in between),
        bool(last_onset_s - stretches[-1].knots_s[-1] > SMALLEST_GAP_S),
    ]


def _gap(before: HeardStretch, after: HeardStretch) -> Gap:
    score_from, score_to = float(before.knots_s[-1]), float(after.knots_s[0])
    song_from, song_to = float(before.line_s[-1]), float(after.line_s[0])
    return Gap(score_from, max(score_from, score_to), song_from, max(song_from, song_to))


def _alone_s(stretch: HeardStretch, at: int, score_s: float) -> float:
    """How long the recording takes from a stretch's first (0) or last (-1) beat out to a place outside it."""
    away_s = max(0.0, (score_s - float(stretch.knots_s[-1])) if at else float(stretch.knots_s[0]) - score_s)
    if away_s <= LONG_WAY_S:
        return _slope(stretch, at) * away_s
    # One beat says too little of a tempo that goes on for so long.
    near = np.abs(stretch.knots_s - stretch.knots_s[at]) <= away_s
    score, song = stretch.knots_s[near], stretch.line_s[near]
    return float((song[-1] - song[0]) / max(score[-1] - score[0], 1e-9)) * away_s


def _slope(stretch: HeardStretch, at: int) -> float:
    """How long a second of the score lasts at a stretch's first or last beat."""
    steps = np.diff(stretch.line_s) / np.maximum(np.diff(stretch.knots_s), 1e-9)
    return float(steps[at])


def _confidence(stretch: HeardStretch) -> Times:
    """(K,) at each knot."""
    if not len(stretch.chord_s):
        return np.zeros(len(stretch.knots_s))
    near = np.maximum(0, 1 - np.abs(stretch.knots_s[:, None] - stretch.chord_s) / CONFIDENCE_REACH_S)
    weight = near.sum(axis=1)
    return np.where(weight > 0, near @ stretch.agreement / np.maximum(weight, 1e-9), 0.0)
