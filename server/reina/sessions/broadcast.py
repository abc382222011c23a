"""What goes out when: one schedule and one encoding for all viewers of a session. Pure; time is passed in."""

from __future__ import annotations

import copy
import math
from typing import TYPE_CHECKING

from reina.sessions.schedule import FrameSchedule

if TYPE_CHECKING:
    from collections.abc import Set

    from reina.music import ClockState
    from reina.sessions.frames import EncodedFrames
    from reina.sessions.schedule import DueFrame

LEAD_S = 0.1
"""How long before it is due a frame is sent to viewers who ask for nothing else."""


class Broadcast:
    """The binary messages of one epoch.

    Viewers that want the same number of frames in a message share its bytes. A message goes out when the
    first of its frames is `lead_s` from being due; the others in it are only earlier then.

    Args:
        frames: Where the bytes come from.
        state: The clock at the begin of the epoch, or where it has come to its end.
        resumed: The epoch began before `state`.
        lead_s: How long before it is due a frame is sent, seconds.
    """

    def __init__(
        self, frames: EncodedFrames, state: ClockState, *, resumed: bool = False, lead_s: float = LEAD_S
    ) -> None:
        self.lead_s = lead_s
        """How long before it is due a frame is sent, seconds."""
        self._frames = frames
        self._state = state
        self._resumed = resumed
        self._fps = frames.manifest.fps
        self._schedules: dict[int, FrameSchedule] = {}

    def begin(self, now: float, sizes: Set[int]) -> dict[int, list[bytes]]:
        """The first of `until`'s messages: what is due within `LEAD_S`, however great the lead."""
        return self.until(now - max(self.lead_s - LEAD_S, 0.0), sizes)

    def until(self, now: float, sizes: Set[int]) -> dict[int, list[bytes]]:
        """The messages to be sent by server time `now` that were not given out before.

        Args:
            now: Server time, seconds.
            sizes: The numbers of frames in a message that viewers want.

        Returns:
            The messages in order, by the number of frames in each.
        """
        if self._schedules.keys() != sizes:
            for size in self._schedules.keys() - sizes:
                del self._schedules[size]
        messages: dict[int, list[bytes]] = {}
        for size in sizes:
            schedule = self._schedules.get(size)
            if schedule is None:
                schedule = FrameSchedule(self._state, fps=self._fps, resumed=self._resumed)
                self._schedules[size] = schedule
            messages[size] = self._messages(schedule, size, now + self.lead_s)
        return messages

    def overdue(self, now: float) -> dict[int, int]:
        """How many frames `until` would give out after they were due, by the number of frames in a message.

        Args:
            now: Server time, seconds.
        """
        overdue: dict[int, int] = {}
        for size, schedule in self._schedules.items():
            if schedule.next and schedule.next.due_time_s < now:
                behind = copy.copy(schedule)
                count = 0
                while behind.next and behind.next.due_time_s < now:
                    behind.take(1)
                    count += 1
                overdue[size] = count
        return overdue

    def frames_until(self, now: float, sizes: Set[int]) -> set[int]:
        """The frames that `until` would read; nothing is given out."""
        frames: set[int] = set()
        for size in sizes:
            schedule = self._schedules.get(size) or FrameSchedule(self._state, fps=self._fps)
            frames |= schedule.frames_until(now + self.lead_s, size)
        return frames

    def catch_up(self, state: ClockState, size: int) -> list[bytes]:
        """What a viewer who joins late needs before the next of `until`'s messages: from the present on.

        Args:
            state: The clock at the time of joining, in the same epoch.
            size: Frames in a message.
        """
        schedule = FrameSchedule(state, fps=self._fps, resumed=True)
        following = self._schedules.get(size)
        if following is None:
            # Nobody shares this size yet: `until` goes on where this leaves off.
            self._schedules[size] = schedule
            return self._messages(schedule, size, state.server_time_s + min(self.lead_s, LEAD_S))
        before = following.next.due_time_s if following.next else math.inf
        due: list[DueFrame] = []
        while schedule.next and schedule.next.due_time_s < before - 0.5 / self._fps:
            due.extend(schedule.take(1))
        return [self._message(due[i : i + size]) for i in range(0, len(due), size)]

    def next_time(self) -> float | None:
        """Server time at which `until` has something to give again; None when this epoch has no more."""
        times = [schedule.next.due_time_s for schedule in self._schedules.values() if schedule.next]
        return min(times) - self.lead_s if times else None

    def _messages(self, schedule: FrameSchedule, size: int, horizon_s: float) -> list[bytes]:
        messages: list[bytes] = []
        while schedule.next and schedule.next.due_time_s <= horizon_s:
            messages.append(self._message(schedule.take(size)))
        return messages

    def _message(self, due: list[DueFrame]) -> bytes:
        return self._frames.message(due, epoch=self._state.epoch, playing=self._state.playing)
