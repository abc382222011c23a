"""Note-on and note-off messages into notes."""

from dataclasses import dataclass

import numpy as np

from reina.music.arrays import BoolArray, IntArray


@dataclass(frozen=True)
class Pairs:
    """Which message ends which note.

    Attributes:
        on: (N,) indices of the note-on messages, in the order of the messages.
        off: (N,) index of the message that ends each, or -1 if none does. Of a note that is never released
            it is the note-on that strikes its key again.
        overlapping: (N,) bool, whether a note of the same key already sounded.
        stray: indices of the note-offs that end nothing.
    """

    on: IntArray
    off: IntArray
    overlapping: BoolArray
    stray: IntArray


def pair_notes(key: IntArray, is_on: BoolArray, tick: IntArray) -> Pairs:
    """Pair M messages: first in, first out, where every note has its end.

    Where a note-off is missing, first in, first out would shift all later ends of the key by one. From where
    the key was last at rest a note-on ends the note before it there, as a synthesizer has it.

    Args:
        key: (M,) what has to agree for a note-off to end a note-on (track, channel and pitch in one number).
        is_on: (M,) bool.
        tick: (M,) when, increasing among messages of one key.
    """
    order = np.argsort(key, kind="stable")
    key, is_on, tick = key[order], is_on[order], tick[order]
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
    overlapping = depth[on_at] > 1

    place_of_on = np.cumsum(is_on) - 1
    for run in _hanging_runs(depth, is_stray, start):
        messages = order[run]
        ends = _end_by_the_next(is_on[run].tolist(), tick[run].tolist())
        ons = place_of_on[run][is_on[run]]
        off[ons] = [messages[end] if end is not None else -1 for end in ends]
        overlapping[ons] = False
        used = np.zeros(len(run), dtype=np.bool_)
        used[[end for end in ends if end is not None]] = True
        is_stray[run[~used & ~is_on[run]]] = True

    in_file = np.argsort(order[on_at], kind="stable")
    return Pairs(
        on=order[on_at][in_file],
        off=off[in_file],
        overlapping=overlapping[in_file],
        stray=np.sort(order[is_stray]),
    )


def _hanging_runs(depth: IntArray, is_stray: BoolArray, start: IntArray) -> list[IntArray]:
    """Return of each key that sounds at its end the messages since it was last at rest, without strays.

    Args:
        depth: (M,) how many notes of the key sound after each message, sorted by key.
        is_stray: (M,) which messages end nothing.
        start: Where each key begins.
    """
    end = np.append(start, len(depth))[1:]
    last_rest = np.maximum.accumulate(np.where(depth == 0, np.arange(len(depth)), -1))
    runs: list[IntArray] = []
    for key in np.flatnonzero(depth[end - 1] > 0).tolist():
        begin = max(int(last_rest[end[key] - 1]) + 1, int(start[key]))
        run = np.arange(begin, int(end[key]))
        runs.append(run[~is_stray[run]])
    return runs


def _end_by_the_next(is_on: list[bool], tick: list[int]) -> list[int | None]:
    """Return for each note-on of a run which of its messages ends it: the next, whether on or off."""
    ends: list[int | None] = []
    before: int | None = None
    """The note that the one that sounds has ended."""
    sounding: int | None = None
    began = 0
    for message, begins in enumerate(is_on):
        if begins:
            if sounding is not None:
                ends[sounding] = message
            before, sounding = sounding, len(ends)
            began = tick[message]
            ends.append(None)
        elif sounding is not None and before is not None and tick[message] == began:
            # The key is struck again and then let go at one tick: this ends the note before.
            ends[before], before = message, None
        elif sounding is not None:
            ends[sounding] = message
            before = sounding = None
    return ends
