"""Note-on and note-off messages into notes."""

from dataclasses import dataclass

import numpy as np

from reina.music.arrays import BoolArray, IntArray


@dataclass(frozen=True)
class Pairs:
    """Which message ends which note.

    Attributes:
        on: (N,) indices of the note-on messages, in the order of the messages.
        off: (N,) index of the message that ends each, or -1 if none does.
        overlapping: (N,) bool, whether a note of the same key already sounded.
        stray: indices of the note-offs that end nothing.
    """

    on: IntArray
    off: IntArray
    overlapping: BoolArray
    stray: IntArray


def pair_notes(key: IntArray, is_on: BoolArray) -> Pairs:
    """Pair M messages first in, first out.

    Args:
        key: (M,) what has to agree for a note-off to end a note-on (track, channel and pitch in one number).
        is_on: (M,) bool.
    """
    order = np.argsort(key, kind="stable")
    key, is_on = key[order], is_on[order]
    begins = np.concatenate(([True], key[1:] != key[:-1]))[: len(key)]
    group = np.cumsum(begins) - 1
    start = np.flatnonzero(begins)

    # How many notes of the key sound after each message, could the count go below zero ...
    step = np.where(is_on, 1, -1)
    total = np.cumsum(step)
    count = total - (total[start] - step[start])[group]
    # ... and the lowest count so far, 0 at most: where it falls, a note-off has nothing to end.
    apart = 2 * len(key) + 2
    lowest = np.minimum(np.minimum.accumulate(count - group * apart) + group * apart, 0)
    before = np.where(begins, 0, np.concatenate(([0], lowest[:-1]))[: len(key)])
    is_stray = lowest < before
    depth = count - lowest

    on_at = np.flatnonzero(is_on)
    off_at = np.flatnonzero(~is_on & ~is_stray)
    first_on = np.searchsorted(group[on_at], np.arange(len(start)))
    first_off = np.searchsorted(group[off_at], np.arange(len(start)))
    rank = np.arange(len(off_at)) - first_off[group[off_at]]
    off = np.full(len(on_at), -1, dtype=np.int64)
    off[first_on[group[off_at]] + rank] = order[off_at]

    in_file = np.argsort(order[on_at], kind="stable")
    return Pairs(
        on=order[on_at][in_file],
        off=off[in_file],
        overlapping=(depth[on_at] > 1)[in_file],
        stray=np.sort(order[is_stray]),
    )
