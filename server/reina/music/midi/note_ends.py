"""When notes end, whether the file says so or not."""

from dataclasses import dataclass

import numpy as np

from reina.music.arrays import BoolArray, IntArray
from reina.music.midi.messages import Messages
from reina.music.midi.pairing import Pairs
from reina.music.midi.track import CONTROLLER

ALL_SOUND_OFF, ALL_NOTES_OFF = 120, 123

LONGEST_AFTER_BEATS = 4
"""How long after the last note event of its track a note that is never released may sound on: a bar."""


@dataclass(frozen=True, eq=False)
class NoteEnds:
    """When N notes end.

    Attributes:
        tick: (N,) when.
        struck_again: (N,) bool, whether the key is pressed again before it is let go.
        silenced: (N,) bool, whether a controller ends the note before its note-off, if it has one.
        left: (N,) bool, whether nothing ends it.
    """

    tick: IntArray
    struck_again: BoolArray
    silenced: BoolArray
    left: BoolArray


def find_note_ends(
    messages: Messages,
    note_messages: Messages,
    is_on: BoolArray,
    pairs: Pairs,
    track_end: IntArray,
    ticks_per_beat: float,
) -> NoteEnds:
    """Find when notes end.

    All Sound Off and All Notes Off end what sounds on their channel and track. A note that nothing ends lasts
    to the end of its track; where that lies far behind the track's last note event, it ends with that, or
    after a bar.

    Args:
        messages: The channel messages of all tracks.
        note_messages: Those that begin and end notes.
        is_on: (M,) which of these begin one.
        pairs: Their pairs.
        track_end: (T,) when each track ends.
        ticks_per_beat: The file's division.
    """
    on = note_messages.take(pairs.on)
    has_end = pairs.off >= 0
    struck_again = has_end & is_on[pairs.off]
    last = np.zeros(len(track_end), dtype=np.int64)
    np.maximum.at(last, note_messages.track, note_messages.tick)
    bar = round(LONGEST_AFTER_BEATS * ticks_per_beat)
    sensible = np.maximum(last[on.track], on.tick + bar)
    end_of_track = np.maximum(track_end[on.track], on.tick)
    is_far = end_of_track - last[on.track] > bar
    tick = np.where(
        has_end,
        note_messages.tick[pairs.off],
        np.where(is_far, np.minimum(sensible, end_of_track), end_of_track),
    )
    silence = _next_silence(messages, on)
    silenced = (silence > on.tick) & (silence < np.where(has_end, tick, end_of_track + 1))
    return NoteEnds(
        tick=np.where(silenced, silence, tick),
        struck_again=struck_again & ~silenced,
        silenced=silenced,
        left=~has_end & ~silenced,
    )


def _next_silence(messages: Messages, on: Messages) -> IntArray:
    """Return (N,) when a controller next silences the track and channel of each note, -1 if none does."""
    silences = messages.take(
        np.flatnonzero(
            (messages.command == CONTROLLER) & np.isin(messages.first, (ALL_SOUND_OFF, ALL_NOTES_OFF))
        )
    )
    if not len(silences.tick):
        return np.full(len(on.tick), -1)

    def moment(of: Messages) -> IntArray:
        return (of.track << 12 | of.channel) << 40 | of.tick

    moments = np.sort(moment(silences))
    found = np.append(moments, -1)[np.searchsorted(moments, moment(on), side="right")]
    return np.where(found >> 40 == moment(on) >> 40, found & ((1 << 40) - 1), -1)
