"""A tempo that goes smoothly from beat to beat, and jumps where the music does, through onsets that err."""

import numpy as np

from reina.sound.alignment.score_bands import Times

ONSET_S = 0.012
"""How far a right onset lies from the beat's line."""
TEMPO_CHANGE = 0.035
"""By how much the tempo usually changes from one beat to the next, as a share."""
ROUNDS = 8
SLOWEST = 0.05
"""The least that a second of the score lasts."""
STEADY = 1e-4
"""A weight for the tempo where nothing is heard."""


def fit_beats(knots_s: Times, onset_s: Times, heard_s: Times, weight: Times) -> Times:
    """Where the recording is at each knot.

    The broken line through `knots_s` that goes near what is heard without bending much; both distances are
    taken as they are and not squared where they are large (Huber), so that a wrong onset does not pull and a
    sudden tempo does not smear. Reweighted least squares.

    Args:
        knots_s: (K,) places of the score, rising, two at least.
        onset_s: (N,) onsets in the score, between the knots.
        heard_s: (N,) where each is heard.
        weight: (N,) how clearly, 0..1.

    Returns:
        (K,) rising.
    """
    lengths = np.diff(knots_s)
    at = np.clip(np.searchsorted(knots_s, onset_s, side="right") - 1, 0, len(lengths) - 1)
    share = (onset_s - knots_s[at]) / lengths[at]
    line = _first_line(knots_s, onset_s, heard_s)
    for _ in range(ROUNDS):
        off = (line[at] * (1 - share) + line[at + 1] * share - heard_s) / ONSET_S
        pull = weight / np.maximum(1, np.abs(off)) / ONSET_S**2
        slopes = np.diff(line) / lengths
        usual = TEMPO_CHANGE * max(float(np.median(slopes)), SLOWEST)
        bend = np.diff(slopes) / usual
        stiffness = 1 / np.maximum(1, np.abs(bend)) / usual**2
        line = _solve(lengths, at, share, heard_s, pull, stiffness, line)
    steps = np.maximum(np.diff(line), SLOWEST * lengths)
    return line[0] + np.concatenate(([0.0], np.cumsum(steps)))


def _first_line(knots_s: Times, onset_s: Times, heard_s: Times) -> Times:
    if len(onset_s) < 2 or onset_s[-1] - onset_s[0] < 1e-6:
        offset = float(np.mean(heard_s - onset_s)) if len(onset_s) else 0.0
        return knots_s + offset
    slope = (heard_s[-1] - heard_s[0]) / (onset_s[-1] - onset_s[0])
    inside = np.interp(knots_s, onset_s, heard_s)
    inside += np.where(knots_s < onset_s[0], (knots_s - onset_s[0]) * slope, 0)
    return inside + np.where(knots_s > onset_s[-1], (knots_s - onset_s[-1]) * slope, 0)


def _solve(
    lengths: Times, at: np.ndarray, share: Times, heard_s: Times, pull: Times, stiffness: Times, line: Times
) -> Times:
    """Least squares with five diagonals: onsets between two knots, bends over three."""
    count = len(lengths) + 1
    diagonals = np.zeros((3, count))
    right = np.zeros(count)
    left = 1 - share
    np.add.at(diagonals[0], at, pull * left**2)
    np.add.at(diagonals[0], at + 1, pull * share**2)
    np.add.at(diagonals[1], at, pull * left * share)
    np.add.at(right, at, pull * left * heard_s)
    np.add.at(right, at + 1, pull * share * heard_s)
    if count > 2:
        a, c = 1 / lengths[:-1], 1 / lengths[1:]
        b = -(a + c)
        for row, (x, y) in enumerate(((a, a), (b, b), (c, c))):
            diagonals[0, row : row + count - 2] += stiffness * x * y
        diagonals[1, : count - 2] += stiffness * a * b
        diagonals[1, 1 : count - 1] += stiffness * b * c
        diagonals[2, : count - 2] += stiffness * a * c
    # Held to where it was, so weakly that it only decides what nothing else does.
    diagonals[0] += STEADY
    right += STEADY * line
    return _five_diagonals(diagonals, right)


def _five_diagonals(diagonals: Times, right: Times) -> Times:
    """Solve a symmetric, positive definite system of bandwidth two, by its factors L D Lᵀ."""
    d0, d1, d2 = (row.tolist() for row in diagonals)
    x = right.tolist()
    count = len(x)
    pivot, first, second = [0.0] * count, [0.0] * count, [0.0] * count
    for k in range(count):
        p1 = pivot[k - 1] if k else 0.0
        p2 = pivot[k - 2] if k > 1 else 0.0
        l1 = first[k - 1] if k else 0.0
        l2 = second[k - 2] if k > 1 else 0.0
        pivot[k] = d0[k] - l1 * l1 * p1 - l2 * l2 * p2
        if k + 1 < count:
            first[k] = (d1[k] - (second[k - 1] * l1 * p1 if k else 0.0)) / pivot[k]
        if k + 2 < count:
            second[k] = d2[k] / pivot[k]
        x[k] -= l1 * (x[k - 1] if k else 0.0) + l2 * (x[k - 2] if k > 1 else 0.0)
    for k in range(count - 1, -1, -1):
        x[k] /= pivot[k]
        if k + 1 < count:
            x[k] -= first[k] * x[k + 1]
        if k + 2 < count:
            x[k] -= second[k] * x[k + 2]
    return np.array(x)
