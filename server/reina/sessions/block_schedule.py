"""Which block of frames is needed when: the music clock's state laid out on the grid of blocks. Pure."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass
from typing import TYPE_CHECKING

from reina.performance import BLOCK_FRAMES
from reina.sessions.schedule import GRID_TOLERANCE

if TYPE_CHECKING:
    from collections.abc import Iterator

    from reina.music import ClockState

REMEMBERED = 12
"""So many blocks that were sent last are not sent again in an epoch: every viewer keeps more."""


@dataclass(frozen=True, slots=True)
class NeededBlock:
    """One block to be sent."""

    number: int
    due_time_s: float
    """Server time at which the first of its frames that is shown is due."""


class BlockSchedule:
    """The blocks of one epoch in the order in which they are needed, from the clock's state on.

    The first is the one that the present frame is in; while paused there is that one alone. A loop comes back
    to blocks that were there: those that viewers still have are left out, so that of a loop of a few blocks
    there is an end.

    Args:
        state: The clock at the begin of the epoch, or at any time within it.
        fps: Frames a second of song time.
    """

    def __init__(self, state: ClockState, *, fps: int) -> None:
        self._needed = _without_remembered(_blocks(state, fps))
        self._coming: deque[NeededBlock] = deque()

    @property
    def next(self) -> NeededBlock | None:
        """The block that `take` gives; None when all have been taken."""
        return self._at(0)

    def take(self) -> NeededBlock | None:
        """The next block in order."""
        return self._coming.popleft() if self._at(0) else None

    def due_until(self, server_time_s: float) -> list[NeededBlock]:
        """The next blocks that are due by a server time; none is taken."""
        due: list[NeededBlock] = []
        while (block := self._at(len(due))) and block.due_time_s <= server_time_s:
            due.append(block)
        return due

    def _at(self, place: int) -> NeededBlock | None:
        while len(self._coming) <= place and (block := next(self._needed, None)):
            self._coming.append(block)
        return self._coming[place] if place < len(self._coming) else None


def _without_remembered(blocks: Iterator[NeededBlock]) -> Iterator[NeededBlock]:
    remembered: deque[int] = deque(maxlen=REMEMBERED)
    passed = 0
    for block in blocks:
        if block.number not in remembered:
            passed = 0
            remembered.append(block.number)
            yield block
            continue
        passed += 1
        if passed > REMEMBERED:
            # A whole round of a loop, and nothing of it is new.
            return


def _blocks(state: ClockState, fps: int) -> Iterator[NeededBlock]:
    """Every block that is come to, those among them that were there before."""
    number = math.floor(state.song_time_s * fps + GRID_TOLERANCE) // BLOCK_FRAMES
    yield NeededBlock(number, state.server_time_s)
    if not state.playing:
        return
    last = math.floor(state.duration_s * fps + GRID_TOLERANCE)
    loop = state.loop if state.loop and state.song_time_s < state.loop[1] else None
    # Song time `song_s` is heard at server time `server_s`; a loop moves both.
    song_s, server_s = state.song_time_s, state.server_time_s + state.count_in_s / state.rate
    while True:
        number += 1
        frame = number * BLOCK_FRAMES
        if loop and frame >= loop[1] * fps - GRID_TOLERANCE:
            start_s, end_s = loop
            ended_s = server_s + (end_s - song_s) / state.rate
            song_s, server_s = start_s, ended_s + state.loop_count_in_s / state.rate
            number = math.floor(start_s * fps + GRID_TOLERANCE) // BLOCK_FRAMES
            # While it is counted in, the loop's start is on screen.
            yield NeededBlock(number, ended_s)
        elif frame > last:
            return
        else:
            yield NeededBlock(number, server_s + (frame / fps - song_s) / state.rate)
