"""Which messages end all that sounds on a channel."""

import numpy as np

from reina.music.arrays import BoolArray, IntArray
from reina.music.midi.messages import Messages
from reina.music.midi.track import CONTROLLER, NOTE_OFF, NOTE_ON

ALL_SOUND_OFF, ALL_NOTES_OFF = 120, 123

ALL_KEYS = 64
"""So many keys let go at one tick are a sequencer's way to silence a channel, and no music."""

NEVER = -1


def find_silences(messages: Messages) -> BoolArray:
    """Return (M,) which of M messages are All Sound Off, All Notes Off, or one of note-offs for all keys."""
    silences = (messages.command == CONTROLLER) & np.isin(messages.first, (ALL_SOUND_OFF, ALL_NOTES_OFF))
    is_off = (messages.command == NOTE_OFF) | ((messages.command == NOTE_ON) & (messages.second == 0))
    offs = messages.take(np.flatnonzero(is_off))
    moments, moment = np.unique(source_of(offs) << 40 | offs.tick, return_inverse=True)
    # A key that is let go twice at a time counts once.
    keys = np.bincount(np.unique(moment << 7 | offs.first) >> 7, minlength=len(moments))
    silences[is_off] = keys[moment] >= ALL_KEYS
    return silences


def next_silence(silences: Messages, on: Messages) -> IntArray:
    """Return (N,) when the channel of each of N notes is next silenced, `NEVER` if it is not.

    What a track says of a channel on which it has no note holds for all tracks, else for its own notes.

    Args:
        silences: The messages of `find_silences`.
        on: The note-on messages.
    """
    of_all = ~np.isin(source_of(silences), np.unique(source_of(on)))
    own = next_tick(source_of(silences), silences.tick, source_of(on), on.tick)
    others = next_tick(silences.channel[of_all], silences.tick[of_all], on.channel, on.tick)
    return np.where((own == NEVER) | ((others != NEVER) & (others < own)), others, own)


def source_of(messages: Messages) -> IntArray:
    """Return ``track, channel`` of each message in one number."""
    return messages.track << 12 | messages.channel


def next_tick(group: IntArray, tick: IntArray, of: IntArray, at: IntArray) -> IntArray:
    """Return for each of N notes the first tick of its group after its own, `NEVER` if there is none.

    Args:
        group: (S,) what the ticks belong to.
        tick: (S,) the ticks.
        of: (N,) what the notes belong to.
        at: (N,) when they begin.
    """
    moments = np.sort(group << 40 | tick)
    found = np.append(moments, NEVER)[np.searchsorted(moments, of << 40 | at, side="right")]
    return np.where(found >> 40 == of, found & ((1 << 40) - 1), NEVER)
