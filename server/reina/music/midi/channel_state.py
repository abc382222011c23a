"""What is in force on a channel when a note begins: its program, and whether it is drums."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reina.music.arrays import BoolArray, IntArray
from reina.music.gm import DRUM_CHANNEL
from reina.music.midi.messages import CHANNELS_OF_PORT, Messages
from reina.music.midi.sysex import Standard
from reina.music.midi.track import CONTROLLER, PART_MODE, PROGRAM, Track
from reina.music.notes import NO_PROGRAM

BANK_SELECT = 0
DRUM_BANKS = frozenset({120, 126, 127})
"""General MIDI 2's rhythm bank and XG's two; what GS has there are tones."""
MELODIC_BANK = 121
"""General MIDI 2's."""

UNSAID, MELODIC, DRUMS = -1, 0, 1
NEVER = -1


@dataclass(frozen=True, eq=False)
class Latest:
    """The latest change before each of N notes: (N,) its value and its tick, `NEVER` where there is none."""

    value: IntArray
    tick: IntArray

    def or_later(self, other: "Latest") -> "Latest":
        """Take the later of two changes, of equals this one."""
        own = self.tick >= other.tick
        return Latest(np.where(own, self.value, other.value), np.where(own, self.tick, other.tick))


@dataclass(frozen=True, eq=False)
class ChannelState:
    """What N notes find: (N,) their program or `NO_PROGRAM`, and (N,) whether they are drums."""

    program: IntArray
    is_drums: BoolArray


def read_channel_state(messages: Messages, notes: Messages, tracks: Sequence[Track]) -> ChannelState:
    """Find the state of their channel for notes.

    What the note's own track says of the channel holds, and what a track says that has no note on it; where
    these say nothing, what any track says. So a setup track sets the programs of all, and tracks that
    collide on a channel do not change each other's.

    Args:
        messages: The channel messages of all tracks.
        notes: The note-on messages.
        tracks: The tracks, which switch standards.
    """
    state = _Lookup(notes)
    programs = state.latest(_chosen(messages, messages.command == PROGRAM), "first")
    is_bank = (messages.command == CONTROLLER) & (messages.first == BANK_SELECT)
    banks = state.latest(_chosen(messages, is_bank), "second")
    modes = state.latest(_chosen(messages, messages.command == PART_MODE), "first")
    by_bank = np.full(len(banks.value), UNSAID)
    by_bank[banks.value == MELODIC_BANK] = MELODIC
    if _standard(tracks) != "GS":
        by_bank[np.isin(banks.value, tuple(DRUM_BANKS))] = DRUMS
    mode_holds = (by_bank == UNSAID) | (modes.tick > banks.tick)
    said = np.where(mode_holds, modes.value, by_bank)
    by_channel = notes.channel % CHANNELS_OF_PORT == DRUM_CHANNEL
    is_drums = (said == DRUMS) | ((said == UNSAID) & by_channel)
    return ChannelState(np.where(programs.tick == NEVER, NO_PROGRAM, programs.value), is_drums)


def _standard(tracks: Sequence[Track]) -> Standard | None:
    """Return the standard that a file switches to, the last one; General MIDI itself is none of its own."""
    switches = sorted(
        (change for track in tracks for change in track.standards if change[1] != "GM"),
        key=lambda change: change[0],
    )
    return switches[-1][1] if switches else None


def _chosen(messages: Messages, which: BoolArray) -> Messages:
    chosen = np.flatnonzero(which)
    return messages.take(chosen[np.argsort(messages.tick[chosen], kind="stable")])


class _Lookup:
    """Finds the latest change before each note, by track and by channel."""

    def __init__(self, notes: Messages) -> None:
        self._notes = notes
        self._sources = np.unique(_source(notes))

    def latest(self, changes: Messages, field: str) -> Latest:
        """Find the latest of `changes`, which are sorted by tick, at or before each note."""
        notes, values = self._notes, getattr(changes, field)
        silent = ~np.isin(_source(changes), self._sources)
        own = _latest(_source(changes), changes.tick, values, _source(notes), notes.tick)
        setup = _latest(
            changes.channel[silent], changes.tick[silent], values[silent], notes.channel, notes.tick
        )
        found = own.or_later(setup)
        anyones = _latest(changes.channel, changes.tick, values, notes.channel, notes.tick)
        unsaid = found.tick == NEVER
        return Latest(
            np.where(unsaid, anyones.value, found.value), np.where(unsaid, anyones.tick, found.tick)
        )


def _source(messages: Messages) -> IntArray:
    """Return ``track, channel`` of each message in one number."""
    return messages.track << 12 | messages.channel


def _latest(group: IntArray, tick: IntArray, value: IntArray, of: IntArray, at: IntArray) -> Latest:
    """Find for each of N notes the latest change in its group at or before its tick.

    Args:
        group: (C,) what the changes belong to.
        tick: (C,) when they are, increasing within a group.
        value: (C,) what they say.
        of: (N,) what the notes belong to.
        at: (N,) when they begin.
    """
    if not len(group):
        nothing = np.full(len(of), NEVER)
        return Latest(nothing, nothing)
    order = np.argsort(group, kind="stable")
    group, tick, value = group[order], tick[order], value[order]
    # Group and tick in one number, which rises: 22 and 38 bits of 63.
    found = np.searchsorted(group << 40 | tick, of << 40 | at, side="right") - 1
    is_found = (found >= 0) & (group[np.maximum(found, 0)] == of)
    return Latest(np.where(is_found, value[found], NEVER), np.where(is_found, tick[found], NEVER))
