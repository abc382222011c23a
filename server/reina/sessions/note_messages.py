"""`note_on` and `note_off` as the music passes over the played notes."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from reina.music import NoteEventEmitter
from reina.protocol.messages import NoteOff, NoteOn

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    from numpy.typing import NDArray

    from reina.music import ClockState, NoteEvent
    from reina.protocol.notes import WireNote

NOTE_BYTES = 26
"""What a note takes in memory: a time, a kind and an index of its beginning, and of its end."""
JOINED_BYTES = 24
"""What it takes beside, where several players' notes are put together: times, pitch and index."""

_MESSAGES = {"note_on": NoteOn, "note_off": NoteOff}


class NoteMessages:
    """Note events as messages, ready to be posted.

    Args:
        onset_s: (N,) onsets of the played notes, seconds.
        end_s: (N,) their ends.
        pitch: (N,) their sounding pitches.
        describe: The number of a played note -> what the wire says of it.
    """

    def __init__(
        self,
        onset_s: NDArray[np.float64],
        end_s: NDArray[np.float64],
        pitch: NDArray[np.int64],
        describe: Callable[[int], WireNote],
    ) -> None:
        self._emitter = NoteEventEmitter[int](onset_s, end_s, pitch, range(len(onset_s)))
        self._events: list[NoteEvent[int]] = []
        self._emitter.add_listener(self._events.append)
        self._describe = describe
        self._state: ClockState | None = None
        self._until_s = 0.0
        self.due_s = math.inf
        """Server time before which `advance` has nothing to tell; infinity while nothing moves."""

    def begin(self, state: ClockState) -> list[str]:
        """Go where the clock is at the begin of an epoch: what ends and begins to sound by that."""
        self._state = state
        self._until_s = state.server_time_s
        self._emitter.seek(state.song_time_s)
        return self._heard()

    def end(self) -> list[str]:
        """`note_off` of every note that sounds: others are told of from now on."""
        at_s = self._emitter.position_s
        return [self._message("note_off", index, at_s) for index in self._emitter.sounding]

    def advance(self, now: float) -> list[str]:
        """What ends and begins up to server time `now`, since the call before."""
        if self._state is not None:
            self._emitter.follow(self._state.spans(self._until_s, now))
            self._until_s = max(now, self._until_s)
        return self._heard()

    def sounding(self) -> list[str]:
        """`note_on` of every note that sounds: for those who join."""
        at_s = self._emitter.position_s
        return [self._message("note_on", index, at_s) for index in self._emitter.sounding]

    def _heard(self) -> list[str]:
        self.due_s = self._next_due_s()
        texts = [self._message(event.kind, event.index, event.song_time_s) for event in self._events]
        self._events.clear()
        return texts

    def _next_due_s(self) -> float:
        state = self._state
        if state is None or not state.playing:
            return math.inf
        next_s = self._emitter.next_time_s
        if state.loop is not None:
            # At a loop's end notes are ended that have not come to theirs.
            next_s = min(next_s, state.loop[1])
        return self._until_s + max(0.0, next_s - self._emitter.position_s) / state.rate

    def _message(self, kind: str, index: int, song_time_s: float) -> str:
        note = self._describe(index)
        return _MESSAGES[kind](**note.model_dump(), song_time_s=song_time_s).model_dump_json()
