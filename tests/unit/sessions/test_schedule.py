from __future__ import annotations

import math
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reina.music import ClockState, MusicClock
from reina.sessions.schedule import DueFrame, FrameSchedule

FPS = 60


def state(
    song_time_s: float = 0.0,
    *,
    playing: bool = True,
    rate: float = 1.0,
    loop: tuple[float, float] | None = None,
    duration_s: float = 10.0,
) -> ClockState:
    return ClockState(playing, song_time_s, 1000.0, rate, loop, 3, duration_s)


def test_frames_are_due_when_their_song_time_is_heard() -> None:
    frames = FrameSchedule(state(2.0), fps=FPS).take(4)
    assert [frame.index for frame in frames] == [120, 121, 122, 123]
    assert [frame.due_time_s for frame in frames] == pytest.approx([1000 + k / 60 for k in range(4)])
    assert [frame.first for frame in frames] == [True, False, False, False]
    assert not any(frame.cut for frame in frames)


def test_the_first_frame_is_the_one_on_screen() -> None:
    first, second = FrameSchedule(state(2.0 + 0.4 / FPS), fps=FPS).take(2)
    assert (first.index, second.index) == (120, 121)
    assert first.due_time_s == pytest.approx(1000 - 0.4 / FPS)
    assert second.due_time_s == pytest.approx(1000 + 0.6 / FPS)


def test_while_paused_there_is_one_frame() -> None:
    schedule = FrameSchedule(state(2.0, playing=False), fps=FPS)
    assert schedule.take(12) == [DueFrame(120, 1000.0, first=True)]
    assert schedule.next is None


@pytest.mark.parametrize(("rate", "stride"), [(0.25, 1), (1.0, 1), (1.4, 1), (2.0, 2), (2.6, 3), (4.0, 4)])
def test_at_other_rates_frames_are_passed_over_or_are_due_further_apart(rate: float, stride: int) -> None:
    frames = FrameSchedule(state(rate=rate), fps=FPS).take(5)
    assert [frame.index for frame in frames] == [k * stride for k in range(5)]
    assert [frame.due_time_s for frame in frames] == pytest.approx(
        [1000 + k * stride / FPS / rate for k in range(5)]
    )
    assert [frame.skipped for frame in frames] == [0] + [stride - 1] * 4


def test_the_last_frame_is_sent_whatever_the_stride() -> None:
    frames = FrameSchedule(state(9.9, rate=4.0), fps=FPS).take(99)
    assert [frame.index for frame in frames] == [594, 598, 600]


def test_a_loop_goes_on_at_its_start_with_a_cut() -> None:
    frames = FrameSchedule(state(0.45, loop=(0.2, 0.5)), fps=FPS).take(6)
    assert [frame.index for frame in frames] == [27, 28, 29, 12, 13, 14]
    assert [frame.cut for frame in frames] == [False, False, False, True, False, False]
    assert frames[3].due_time_s == pytest.approx(1000 + 0.05)


def test_a_clock_behind_its_loop_plays_on_to_the_end() -> None:
    frames = FrameSchedule(state(9.95, loop=(0.2, 0.5)), fps=FPS).take(99)
    assert [frame.index for frame in frames] == [597, 598, 599, 600]


def test_taking_one_by_one_is_taking_many() -> None:
    one_by_one = FrameSchedule(state(0.4, rate=3.0, loop=(0.1, 0.5)), fps=FPS)
    together = FrameSchedule(state(0.4, rate=3.0, loop=(0.1, 0.5)), fps=FPS)
    assert [one_by_one.take(1)[0] for _ in range(50)] == together.take(50)


@given(
    song_time_s=st.floats(0, 10),
    rate=st.floats(0.1, 4.0),
    loop=st.one_of(st.none(), st.tuples(st.floats(0, 5), st.floats(0.2, 5)).map(lambda p: (p[0], sum(p)))),
)
def test_each_frame_is_due_at_its_song_time(
    song_time_s: float, rate: float, loop: tuple[float, float] | None
) -> None:
    begin = state(song_time_s, rate=rate, loop=loop)
    frames = FrameSchedule(begin, fps=FPS).take(100)
    dues = [frame.due_time_s for frame in frames]
    assert dues == sorted(dues)
    for frame in frames[1:]:
        # A moment later, so that what is due just when a loop begins anew is not heard at its end.
        heard = float(begin.song_times_at(frame.due_time_s + 1e-7))
        assert heard == pytest.approx(frame.index / FPS, abs=1e-6)
    assert frames[-1].index <= math.floor(10.0 * FPS + 1e-6)


def test_it_follows_the_music_clock() -> None:
    now = 5.0
    clock = MusicClock(lambda: now, 3.0)
    clock.seek(1.0)
    clock.play()
    frames = FrameSchedule(clock.state(), fps=FPS).take(1000)
    assert [frame.index for frame in frames] == list(range(60, 181))
    assert frames[-1].due_time_s == pytest.approx(7.0)


def test_a_count_in_holds_its_frame_and_shows_it_again_when_it_is_over() -> None:
    frames = FrameSchedule(replace(state(2.0, rate=0.5), count_in_s=1.0), fps=FPS).take(4)
    assert [frame.index for frame in frames] == [120, 120, 121, 122]
    assert [frame.due_time_s for frame in frames] == pytest.approx([1000, 1002, 1002 + 1 / 30, 1002 + 2 / 30])
    assert [frame.first for frame in frames] == [True, False, False, False]


def test_each_further_round_of_a_loop_is_held_while_it_is_counted_in() -> None:
    looping = replace(state(1.0, loop=(1.0, 1.05)), loop_count_in_s=2.0)
    frames = FrameSchedule(looping, fps=FPS).take(7)
    assert [frame.index for frame in frames] == [60, 61, 62, 60, 60, 61, 62]
    assert [frame.cut for frame in frames] == [False, False, False, True, False, False, False]
    assert [frame.due_time_s for frame in frames[3:6]] == pytest.approx([1000.05, 1002.05, 1002.05 + 1 / 60])


@given(
    start=st.floats(0.0, 9.9),
    rate=st.floats(0.1, 4.0),
    loop=st.sampled_from([None, (2.0, 3.5), (0.0, 10.0)]),
    taken=st.integers(0, 40),
    size=st.integers(1, 12),
    ahead_s=st.floats(-0.5, 3.0),
)
def test_what_is_due_by_a_time_is_known_without_taking_it(
    start: float, rate: float, loop: tuple[float, float] | None, taken: int, size: int, ahead_s: float
) -> None:
    schedule = FrameSchedule(state(start, rate=rate, loop=loop), fps=FPS)
    schedule.take(taken)
    until_s = (schedule.next.due_time_s if schedule.next else 1000.0) + ahead_s
    known = schedule.frames_until(until_s, size)
    given: list[DueFrame] = []
    while schedule.next and schedule.next.due_time_s <= until_s:
        given += schedule.take(size)
    expected = {each for frame in given for each in range(frame.index - frame.skipped, frame.index + 1)}
    assert expected <= known
    # One that is due a hair later may be told too.
    if schedule.next is None or schedule.next.due_time_s > until_s + 1e-4:
        assert known == expected
