"""What goes out when to those who watch by packed blocks: one schedule and one packing for all of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reina.sessions.block_schedule import BlockSchedule

if TYPE_CHECKING:
    from reina.music import ClockState
    from reina.sessions.packed_blocks import Form, PackedBlocks

AHEAD_S = 2.0
"""How long before its first frame is due a block is sent; playing goes on over such a gap of the network."""


class BlockBroadcast:
    """The packed blocks of one epoch, in one form.

    What is not packed yet when it is to be given out is waited for: packing is not for the event loop.

    Args:
        blocks: Where they come from.
        form: In which form.
        state: The clock at the begin of the epoch, or where it has come to its end.
    """

    def __init__(self, blocks: PackedBlocks, form: Form, state: ClockState) -> None:
        self._blocks = blocks
        self._form: Form = form
        self._begun_s = state.server_time_s
        self._schedule = BlockSchedule(state, fps=blocks.fps)

    def until(self, now: float) -> list[bytes]:
        """The blocks to be sent by server time `now` that are packed and were not given out before."""
        given: list[bytes] = []
        while (block := self._schedule.next) and block.due_time_s <= now + AHEAD_S:
            data = self._blocks.packed(block.number, self._form)
            if data is None:
                break
            given.append(data)
            self._schedule.take()
        return given

    def missing(self, now: float) -> list[int]:
        """Which blocks `until` waits for, in the order in which they are needed."""
        needed = (block.number for block in self._schedule.due_until(now + AHEAD_S))
        return [number for number in needed if self._blocks.packed(number, self._form) is None]

    def overdue(self, now: float) -> int:
        """How many blocks `until` would give out after they were due; what an epoch begins with never is."""
        return sum(self._begun_s < block.due_time_s for block in self._schedule.due_until(now))

    def catch_up(self, state: ClockState) -> list[bytes]:
        """What a viewer who joins late needs before the next of `until`'s blocks: from the present on.

        Args:
            state: The clock at the time of joining, in the same epoch.
        """
        needed = BlockSchedule(state, fps=self._blocks.fps).due_until(state.server_time_s + AHEAD_S)
        coming = self._schedule.next
        before = [block for block in needed if not coming or block.due_time_s < coming.due_time_s - 1e-6]
        packed = (self._blocks.packed(block.number, self._form) for block in before)
        return [data for data in packed if data is not None]

    def next_time(self) -> float | None:
        """Server time at which `until` has something to give again; None when this epoch has no more."""
        block = self._schedule.next
        return None if block is None else block.due_time_s - AHEAD_S
