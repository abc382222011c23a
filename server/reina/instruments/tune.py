"""Who has the tune: of several players the one who is heard above the others, bar by bar."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reina.instruments.played import Line, PlayedPart
from reina.music.arrays import FloatArray, IntArray

PER_OCTAVE, PER_NOTE, PER_VELOCITY = 1.0, 0.12, 1.0
"""What an octave more, a note a second more, and full velocity count for; sounding itself counts for 2."""

SOUNDING = 2.0
MAX_NOTES = 8.0
"""Notes a second beyond which no more is heard."""

MIDDLE_PITCH = 67.0
CHANGE_S = 1.5
"""The tune goes to another player who is above by 1 for longer than this."""


@dataclass(frozen=True)
class TunePassage:
    """A stretch in which one player has the tune.

    Attributes:
        start_s: Where it begins.
        end_s: Where it ends, which is where the next begins.
        player: The player's place in the cast.
    """

    start_s: float
    end_s: float
    player: int


def who_has_tune(
    played: Sequence[PlayedPart], bar_lines_s: FloatArray, duration_s: float
) -> tuple[TunePassage, ...]:
    """Say who has the tune from the beginning to the end.

    Of each bar and player it is counted how much sounds, how high, how lively and how loud; the way through
    the bars that gains most, with a price on every change, is taken (Viterbi).

    Args:
        played: Each player's part as it is played, in the cast's order.
        bar_lines_s: (B,) where the bars begin, increasing.
        duration_s: Where the piece ends.
    """
    lines_s = bar_lines_s[(bar_lines_s > 0.0) & (bar_lines_s < duration_s)]
    edges_s = np.concatenate([[0.0], lines_s, [max(duration_s, *lines_s[-1:], 1e-3)]])
    heard = np.stack([_heard(one.line, edges_s) for one in played], axis=1)
    lead = _best_way(heard * np.diff(edges_s)[:, None])
    first = np.flatnonzero(np.diff(lead, prepend=-1))
    ends_s = np.append(edges_s[first[1:]], edges_s[-1])
    return tuple(
        TunePassage(float(start_s), float(end_s), int(player))
        for start_s, end_s, player in zip(edges_s[first], ends_s, lead[first], strict=True)
    )


def _heard(line: Line, edges_s: FloatArray) -> FloatArray:
    """How much a line is heard in each stretch between (B + 1,) edges, (B,)."""
    bars = len(edges_s) - 1
    begun = np.searchsorted(edges_s, line.onset_s, side="right").astype(np.int64)
    bar = np.clip(begun - 1, 0, bars - 1)
    for_s = np.diff(edges_s)
    count: IntArray = np.bincount(bar, minlength=bars).astype(np.int64)
    # How much of each bar sounds: the time that has sounded by its end, less that by its beginning.
    edges = np.column_stack([line.onset_s, line.end_s]).ravel()
    sounded = np.cumsum(line.end_s - line.onset_s)
    by = np.column_stack([sounded - (line.end_s - line.onset_s), sounded]).ravel()
    share = np.diff(np.interp(edges_s, edges, by)) / for_s if len(line) else np.zeros(bars)
    # A bar into which a note is held goes on as the bar before.
    height, loud = _means(bar, count, line.sounding_pitch), _means(bar, count, line.velocity)
    lively = np.minimum(count / for_s, MAX_NOTES)
    worth = SOUNDING + PER_OCTAVE * (height - MIDDLE_PITCH) / 12.0 + PER_VELOCITY * loud
    return np.minimum(share, 1.0) * np.maximum(worth + PER_NOTE * lively, 0.0)


def _means(bar: IntArray, count: IntArray, values: FloatArray | IntArray) -> FloatArray:
    """The mean of notes' values in each bar, (B,); that of the bar before where none begins."""
    if not len(values):
        return np.zeros(len(count))
    total = np.bincount(bar, values, minlength=len(count))
    filled = np.flatnonzero(count)
    means = total[filled] / count[filled]
    last = np.maximum(np.searchsorted(filled, np.arange(len(count)), side="right") - 1, 0)
    return means[last]


def _best_way(gains: FloatArray) -> IntArray:
    """Of gains (B, P) the player of each bar, (B,), by which most is gained at `CHANGE_S` a change."""
    bars, players = gains.shape
    came_from = np.zeros((bars, players), dtype=np.int64)
    total: FloatArray = gains[0]
    for bar in range(1, bars):
        best = int(total.argmax())
        stays = total >= total[best] - CHANGE_S
        came_from[bar] = np.where(stays, np.arange(players, dtype=np.int64), np.int64(best))
        total = np.where(stays, total, total[best] - CHANGE_S) + gains[bar]
    way = np.zeros(bars, dtype=np.int64)
    way[-1] = total.argmax()
    for bar in range(bars - 1, 0, -1):
        way[bar - 1] = came_from[bar, way[bar]]
    return way
