"""When notes end, whether the file says so or not."""

from dataclasses import dataclass

import numpy as np

from reina.music.arrays import BoolArray, IntArray
from reina.music.midi.messages import Messages
from reina.music.midi.pairing import Pairs
from reina.music.midi.silences import next_silence, next_tick, source_of

LONGEST_BEATS = 4
"""How long a note may sound that nothing ends: a bar. A high one would keep all others out of its line."""

LAST_BEATS = 1
"""How long it sounds where its track ends with its beginning."""


@dataclass(frozen=True, eq=False)
class NoteEnds:
    """When N notes end.

    Attributes:
        tick: (N,) when.
        struck_again: (N,) bool, whether the key is pressed again before it is let go.
        silenced: (N,) bool, whether its channel is silenced before its note-off, if it has one.
        left: (N,) bool, whether nothing says when it ends.
    """

    tick: IntArray
    struck_again: BoolArray
    silenced: BoolArray
    left: BoolArray


def find_note_ends(
    silences: Messages,
    note_messages: Messages,
    is_on: BoolArray,
    pairs: Pairs,
    track_end: IntArray,
    ticks_per_beat: float,
) -> NoteEnds:
    """Find when notes end.

    A note that nothing ends lasts to the end of its track, but no longer than a bar. On a channel without any
    note-off a note ends where the next begins.

    Args:
        silences: The messages that silence their channel.
        note_messages: Those that begin and end notes.
        is_on: (M,) which of these begin one.
        pairs: Their pairs.
        track_end: (T,) when each track ends.
        ticks_per_beat: The file's division.
    """
    on = note_messages.take(pairs.on)
    has_end = pairs.off >= 0
    longest, last = (on.tick + round(beats * ticks_per_beat) for beats in (LONGEST_BEATS, LAST_BEATS))
    end_of_track = track_end[on.track]
    left_end = np.where(end_of_track > on.tick, np.minimum(end_of_track, longest), last)
    tick = np.where(has_end, note_messages.tick[pairs.off], left_end)
    source = source_of(on)
    never_released = ~np.isin(source, source_of(note_messages.take(np.flatnonzero(~is_on))))
    following = next_tick(source, on.tick, source, on.tick)
    is_cut = never_released & (following > on.tick) & (following < tick)
    tick = np.where(is_cut, following, tick)
    silence = next_silence(silences, on)
    silenced = (silence > on.tick) & (~has_end | (silence < tick))
    return NoteEnds(
        tick=np.where(silenced, silence, tick),
        struck_again=has_end & is_on[pairs.off] & ~is_cut & ~silenced,
        silenced=silenced,
        left=(~has_end | is_cut) & ~silenced,
    )
