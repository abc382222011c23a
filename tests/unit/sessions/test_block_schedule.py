from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reina.music import ClockState
from reina.sessions.block_schedule import REMEMBERED, BlockSchedule, NeededBlock

if TYPE_CHECKING:
    from collections.abc import Iterator

AT = 1000.0


def state(
    song_time_s: float = 0.0,
    *,
    playing: bool = True,
    rate: float = 1.0,
    loop: tuple[float, float] | None = None,
    duration_s: float = 10.0,
    count_in_s: float = 0.0,
    loop_count_in_s: float = 0.0,
) -> ClockState:
    return ClockState(playing, song_time_s, AT, rate, loop, 7, duration_s, count_in_s, loop_count_in_s)


def taken(schedule: BlockSchedule, most: int = 100) -> list[NeededBlock]:
    def blocks() -> Iterator[NeededBlock]:
        while (block := schedule.take()) is not None:
            yield block

    return [block for block, _ in zip(blocks(), range(most), strict=False)]


def test_blocks_come_in_order_each_due_with_its_first_frame() -> None:
    schedule = BlockSchedule(state(2.5), fps=60)
    assert [block.number for block in schedule.due_until(AT + 1.5)] == [2, 3, 4]
    assert schedule.next == NeededBlock(2, AT), "looking ahead takes nothing"
    blocks = taken(schedule)
    assert [block.number for block in blocks] == list(range(2, 11))
    assert [block.due_time_s for block in blocks] == pytest.approx([AT, *(AT + k + 0.5 for k in range(8))])


def test_while_paused_there_is_the_present_block_alone() -> None:
    assert [block.number for block in taken(BlockSchedule(state(3.2, playing=False), fps=60))] == [3]


def test_the_rate_and_what_is_counted_in_say_when_a_block_is_due() -> None:
    fast = taken(BlockSchedule(state(0.0, rate=2.0), fps=60))
    assert [block.due_time_s for block in fast[:3]] == pytest.approx([AT, AT + 0.5, AT + 1.0])
    counted = taken(BlockSchedule(state(0.0, rate=2.0, count_in_s=3.0), fps=60))
    assert [block.due_time_s for block in counted[:2]] == pytest.approx([AT, AT + 1.5 + 0.5])


def test_a_short_loop_is_sent_once() -> None:
    blocks = taken(BlockSchedule(state(4.5, loop=(1.5, 5.5), loop_count_in_s=1.0), fps=60))
    assert [block.number for block in blocks] == [4, 5, 1, 2, 3]
    assert blocks[2].due_time_s == pytest.approx(AT + 1.0), "its start is on screen while it is counted in"
    assert blocks[3].due_time_s == pytest.approx(AT + 1.0 + 1.0 + 0.5)


def test_a_long_loop_is_sent_again_each_round() -> None:
    blocks = taken(BlockSchedule(state(0.0, loop=(0.0, 20.0), duration_s=40.0), fps=60), 45)
    assert [block.number for block in blocks] == [*range(20), *range(20), *range(5)]


def test_a_clock_behind_its_loop_runs_on_to_the_end() -> None:
    assert [block.number for block in taken(BlockSchedule(state(8.0, loop=(1.0, 2.0)), fps=60))] == [8, 9, 10]


@given(
    begin=st.floats(0, 9.9),
    start=st.floats(0, 8),
    length=st.floats(0.05, 9),
    rate=st.floats(0.1, 4),
    counted=st.sampled_from([0.0, 0.7]),
)
def test_every_frame_that_is_shown_is_in_a_block_that_came_in_time(
    begin: float, start: float, length: float, rate: float, counted: float
) -> None:
    clock = state(begin, rate=rate, loop=(start, start + length), loop_count_in_s=counted, duration_s=20.0)
    blocks = taken(BlockSchedule(clock, fps=60), 60)
    assert all(a.due_time_s <= b.due_time_s + 1e-9 for a, b in pairwise(blocks))
    until = blocks[-1].due_time_s if len(blocks) == 60 else AT + 60.0
    times = np.linspace(AT, until, 200)
    frames = np.floor(clock.song_times_at(times) * 60 + 1e-6).astype(int)
    if begin < start + length:
        # Nothing of a loop's end is shown.
        frames = np.minimum(frames, math.ceil((start + length) * 60 - 1e-6) - 1)
    for time_s, frame in zip(times.tolist(), frames.tolist(), strict=True):
        come = [block.number for block in blocks if block.due_time_s <= time_s + 1e-6]
        assert frame // 60 in come[-REMEMBERED - 1 :]
