"""Note events: who listens is told when a note begins and when it ends."""

import logging
from collections import deque
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Generic, Literal, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from reina.music.clock import Span

N = TypeVar("N")

_log = logging.getLogger("reina.music.events")
_OFF, _ON, _OFF_OF_TAP = 0, 1, 2

SAME_TIME_S = 1e-6
"""Song times nearer than this are the same: what two calculations of one time may differ by."""


@dataclass(frozen=True)
class NoteEvent(Generic[N]):
    """The beginning or the end of a note.

    Attributes:
        kind: ``note_on`` or ``note_off``.
        song_time_s: The song time of the event: the onset, the end, or the place that a seek went to.
        index: Which note, an index into the emitter's notes.
        note: What the emitter was given for it: the note with its fingering.
        resumed: Whether the note began before: a seek went into it, or the listener came late.
    """

    kind: Literal["note_on", "note_off"]
    song_time_s: float
    index: int
    note: N
    resumed: bool = False


Listener = Callable[[NoteEvent[N]], None]


def _log_failure(error: Exception, event: NoteEvent[Any]) -> None:
    _log.error("a listener failed at %s of note %d", event.kind, event.index, exc_info=error)


class NoteEventEmitter(Generic[N]):
    """Tells listeners of notes as song time passes over them, each event once and in order.

    The emitter holds a position and the notes that sound there; nothing else. `advance` passes over the
    events after the position up to and with the new one, `seek` goes somewhere else. After either, the notes
    that were announced and not ended are exactly those with ``onset_s <= position < end_s``. Hence:

    - Events come in the order of their times. At one time ends come before beginnings, then the lower pitch
      first, then the earlier note. Only the end of a note without duration comes after its own beginning.
    - A seek ends the notes that sound no longer and announces, marked `resumed` if they began before, those
      that do; a note that sounds before and after it is left alone. What lies between is not told.
    - A loop is followed by `follow`: at its end every note that sounds is ended, and those that sound at its
      beginning are announced, so that a note as long as the loop is struck anew each time. The loop's end
      itself is not part of it: what begins there is not told.
    - The rate of play is nothing to an emitter: it hears of song time alone.
    - A listener that is added late is told at once, marked `resumed`, of the notes that sound.
    - A listener that raises neither disturbs the others nor loses later events; `on_error` is told.
    - A listener may itself call the emitter; what that causes is told after the present event.

    It is free of threads and of waiting: the caller decides when time has passed, and from one thread.
    """

    def __init__(
        self,
        onset_s: ArrayLike,
        end_s: ArrayLike,
        pitch: ArrayLike,
        notes: Sequence[N],
        *,
        on_error: Callable[[Exception, NoteEvent[N]], None] | None = None,
    ) -> None:
        """Make an emitter that stands before the first event.

        Args:
            onset_s: (N,) seconds, in any order.
            end_s: (N,) seconds, none before its onset.
            pitch: (N,) what orders the events of one time.
            notes: What the events carry.
            on_error: Told of what a listener raised; by default it is logged.

        Raises:
            ValueError: If the columns differ in length, or a note ends before it begins.
        """
        onsets, ends = np.asarray(onset_s, dtype=np.float64), np.asarray(end_s, dtype=np.float64)
        pitches = np.asarray(pitch)
        if not onsets.shape == ends.shape == pitches.shape == (len(notes),):
            shapes = (onsets.shape, ends.shape, pitches.shape)
            raise ValueError(f"columns of the length {len(notes)} are needed, not {shapes}")
        if np.any(ends < onsets):
            raise ValueError("a note ends before it begins")
        self._notes = notes
        self._onsets, self._ends, self._pitches = onsets, ends, pitches
        index = np.arange(len(notes), dtype=np.int32)
        times = np.concatenate((ends, onsets))
        kinds = np.concatenate((np.where(ends > onsets, _OFF, _OFF_OF_TAP), np.full(len(notes), _ON)))
        kinds = kinds.astype(np.int8)
        order = np.lexsort((np.tile(index, 2), np.tile(pitches, 2), kinds, times))
        self._times = times[order]
        self._kinds = kinds[order]
        self._indices = np.tile(index, 2)[order]
        self._position = -np.inf
        self._next = 0
        self._sounding: dict[int, None] = {}
        self._listeners: dict[int, Listener[N]] = {}
        self._listener_count = 0
        self._on_error = on_error or _log_failure
        self._waiting: deque[NoteEvent[N]] = deque()
        self._telling = False

    @property
    def position_s(self) -> float:
        """The song time that was reached; minus infinity before the first."""
        return float(self._position)

    @property
    def next_time_s(self) -> float:
        """The song time of the next event after the position; infinity when none follows."""
        return float(self._times[self._next]) if self._next < len(self._times) else np.inf

    @property
    def sounding(self) -> tuple[int, ...]:
        """Indices of the notes that sound at the position, lower pitches first."""
        return tuple(self._by_pitch(self._sounding))

    def add_listener(self, listener: Listener[N], *, announce: bool = True) -> Callable[[], None]:
        """Add a listener; the same one may be added several times.

        Args:
            listener: Called with each event.
            announce: Whether it is told now, marked `resumed`, of the notes that sound.

        Returns:
            What removes it again.
        """
        number = self._listener_count
        self._listener_count += 1
        if announce:
            for index in self._by_pitch(self._sounding):
                self._tell(
                    listener, NoteEvent("note_on", self._position, index, self._notes[index], resumed=True)
                )
        self._listeners[number] = listener

        def remove() -> None:
            self._listeners.pop(number, None)

        return remove

    def advance(self, to_s: float) -> None:
        """Pass over the events after the position up to and with `to_s`.

        Raises:
            ValueError: If `to_s` lies before the position; going back is a `seek`.
        """
        if to_s < self._position:
            raise ValueError(f"{to_s} lies before the position {self._position}; seek goes back")
        self._position = to_s
        self._pass_events(int(np.searchsorted(self._times, to_s, side="right")))
        self._deliver()

    def seek(self, to_s: float) -> None:
        """Go to `to_s` without passing over what lies between."""
        self._go(to_s)
        self._deliver()

    def follow(self, spans: Iterable[Span]) -> None:
        """Follow a clock through the spans that `ClockState.spans` gives, loops included."""
        for span in spans:
            if span.start_s < self._position - SAME_TIME_S:
                self._release_all(self._position)
                self._go(span.start_s)
            elif self._position == -np.inf:
                self._go(span.start_s)
            self._position = max(span.end_s, self._position)
            side = "right" if span.ends_song else "left"
            self._pass_events(int(np.searchsorted(self._times, self._position, side=side)))
        self._deliver()

    def _by_pitch(self, indices: Iterable[int]) -> list[int]:
        return sorted(indices, key=lambda index: (self._pitches[index], index))

    def _pass_events(self, until: int) -> None:
        """Put the events from the next one up to, not including, number `until` into the queue."""
        events = slice(self._next, max(until, self._next))
        columns = zip(self._times[events], self._kinds[events], self._indices[events], strict=True)
        for time, kind, index in columns:
            if kind == _ON:
                self._sounding[int(index)] = None
                self._queue("note_on", time, int(index))
            elif int(index) in self._sounding:
                del self._sounding[int(index)]
                self._queue("note_off", time, int(index))
        self._next = events.stop

    def _go(self, to_s: float) -> None:
        sounding = set(np.flatnonzero((self._onsets <= to_s) & (to_s < self._ends)).tolist())
        for index in self._by_pitch(set(self._sounding) - sounding):
            del self._sounding[index]
            self._queue("note_off", to_s, index)
        for index in self._by_pitch(sounding - set(self._sounding)):
            self._sounding[index] = None
            self._queue("note_on", to_s, index, resumed=bool(self._onsets[index] < to_s))
        self._position = to_s
        self._next = int(np.searchsorted(self._times, to_s, side="right"))

    def _release_all(self, at_s: float) -> None:
        for index in self._by_pitch(self._sounding):
            self._queue("note_off", at_s, index)
        self._sounding.clear()

    def _queue(
        self, kind: Literal["note_on", "note_off"], time: float, index: int, *, resumed: bool = False
    ) -> None:
        self._waiting.append(NoteEvent(kind, float(time), index, self._notes[index], resumed))

    def _deliver(self) -> None:
        if self._telling:
            return
        self._telling = True
        try:
            while self._waiting:
                event = self._waiting.popleft()
                for listener in tuple(self._listeners.values()):
                    self._tell(listener, event)
        finally:
            self._telling = False

    def _tell(self, listener: Listener[N], event: NoteEvent[N]) -> None:
        try:
            listener(event)
        except Exception as error:
            self._on_error(error, event)
