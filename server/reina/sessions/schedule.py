"""Which frame is due when: the music clock's state laid out on the grid of frames. Pure; knows no clock."""

from __future__ import annotations

import copy
import math
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from reina.music import ClockState

GRID_TOLERANCE = 1e-6
"""Frames: a song time this close before a frame counts as on it, so that seeking to k / fps shows frame k."""


def frame_from(song_time_s: float, fps: int) -> int:
    """The first frame at or after a song time."""
    return math.ceil(song_time_s * fps - GRID_TOLERANCE)


class DueFrame(NamedTuple):
    """One frame to be sent."""

    index: int  # pyright: ignore[reportIncompatibleMethodOverride] - a frame, no place in the tuple
    due_time_s: float
    """Server time at which its song time is heard."""
    first: bool = False
    """The first of its epoch."""
    cut: bool = False
    """Playback jumped to it from elsewhere: the loop began anew."""
    skipped: int = 0
    """How many frames before it were passed over, at rates above 1."""


class FrameSchedule:
    """The frames of one epoch in the order in which they are due, from the clock's state on.

    Frame k stands at song time k / fps. The first is the one that is on screen at the state's own time. While
    playing at rate r every max(1, round(r))-th frame follows, each due when its song time is heard; at a
    loop's end playback goes on at its start. The last is the last frame before the end. While paused there is
    one alone. While a count-in is on, the frame at which song time stands comes when it begins and again when
    it ends, so that nothing is blended over it.

    Args:
        state: The clock at the begin of the epoch, or at any time within it.
        fps: Frames a second of song time.
        resumed: The epoch began before `state`; no frame is its first then.
    """

    def __init__(self, state: ClockState, *, fps: int, resumed: bool = False) -> None:
        self.state = state
        self._fps = fps
        self._last = math.floor(state.duration_s * fps + GRID_TOLERANCE)
        self._stride = max(1, round(state.rate))
        # Song time `_song_s` is heard at server time `_server_s`; a loop moves both.
        self._song_s = state.song_time_s
        self._server_s = state.server_time_s + state.count_in_s / state.rate
        self._held = state.playing and state.count_in_s > 0
        self._loop = state.loop if state.loop and state.song_time_s < state.loop[1] else None
        index = math.floor(state.song_time_s * fps + GRID_TOLERANCE)
        due = self._due(index) if state.playing and not self._held else state.server_time_s
        self._next: DueFrame | None = DueFrame(index, due, first=not resumed)

    @property
    def next(self) -> DueFrame | None:
        """The frame that `take` begins with; None when all have been taken."""
        return self._next

    def take(self, count: int) -> list[DueFrame]:
        """The next frames in order, at most `count`."""
        taken: list[DueFrame] = []
        while self._next is not None and len(taken) < count:
            taken.append(self._next)
            self._next = self._after(self._next.index)
        return taken

    def frames_until(self, server_time_s: float, size: int = 1) -> set[int]:
        """The frames that are due by a server time, and those that are passed over; none is taken.

        Args:
            server_time_s: Until when.
            size: They are taken by so many.
        """
        first = self._next
        if first is None or first.due_time_s > server_time_s:
            return set()
        if self._loop or self._held or not self.state.playing:
            ahead, frames = copy.copy(self), set[int]()
            while ahead.next and ahead.next.due_time_s <= server_time_s:
                for frame in ahead.take(size):
                    frames.update(range(frame.index - frame.skipped, frame.index + 1))
            return frames
        # Nothing but the stride lies between one and the next.
        passed = (server_time_s - first.due_time_s) * self.state.rate * self._fps / self._stride
        taken = (math.floor(passed + GRID_TOLERANCE) // size + 1) * size
        last = min(first.index + (taken - 1) * self._stride, max(self._last, first.index))
        return set(range(first.index - first.skipped, last + 1))

    def _due(self, index: int) -> float:
        return self._server_s + (index / self._fps - self._song_s) / self.state.rate

    def _after(self, index: int) -> DueFrame | None:
        if not self.state.playing:
            return None
        if self._held:
            self._held = False
            return DueFrame(index, self._due(index))
        following = index + self._stride
        if self._loop:
            start_s, end_s = self._loop
            if following >= end_s * self._fps - GRID_TOLERANCE:
                ended_s = self._server_s + (end_s - self._song_s) / self.state.rate
                counted_s = self.state.loop_count_in_s / self.state.rate
                self._server_s = ended_s + counted_s
                self._song_s = start_s
                self._held = counted_s > 0
                start = frame_from(start_s, self._fps)
                return DueFrame(start, self._due(start) - counted_s, cut=True)
        following = min(following, self._last)
        if following <= index:
            return None
        return DueFrame(following, self._due(following), skipped=following - index - 1)
