import itertools
import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reina.music import ClockError, ClockState, MusicClock


class Hand:
    """A clock that is set by hand."""

    def __init__(self, time: float = 100.0) -> None:
        self.time = time

    def __call__(self) -> float:
        return self.time


def clock(duration_s: float = 10.0) -> tuple[MusicClock, Hand]:
    hand = Hand()
    return MusicClock(hand, duration_s), hand


def test_a_new_clock_stands_at_0():
    music, _ = clock()
    assert music.state() == ClockState(False, 0.0, 100.0, 1.0, None, 0, 10.0)


def test_song_time_runs_while_playing_only():
    music, hand = clock()
    music.play()
    hand.time += 2.5
    assert music.state().song_time_s == 2.5
    music.pause()
    hand.time += 100
    assert music.state().song_time_s == 2.5
    assert not music.state().playing


def test_rate_keeps_the_position():
    music, hand = clock()
    music.play()
    hand.time += 2
    music.set_rate(0.5)
    hand.time += 2
    assert music.state().song_time_s == 3.0
    assert music.state(hand.time + 4).song_time_s == 5.0


def test_at_the_end_it_stops_and_play_begins_anew():
    music, hand = clock()
    music.play()
    hand.time += 9
    assert music.state(hand.time + 1) == ClockState(False, 10.0, 110.0, 1.0, None, 1, 10.0)
    assert music.state(hand.time + 0.5).playing
    hand.time += 50
    assert not music.state().playing
    assert music.play().song_time_s == 0.0
    assert music.state().playing


def test_seek_is_held_inside_the_song():
    music, _ = clock()
    assert music.seek(4).song_time_s == 4
    assert music.seek(-1).song_time_s == 0
    assert music.seek(11).song_time_s == 10


def test_every_change_raises_the_epoch():
    music, _ = clock()
    changes = [
        music.play,
        music.play,
        music.pause,
        music.pause,
        lambda: music.seek(1),
        lambda: music.set_rate(2),
        lambda: music.set_loop(1, 2),
        lambda: music.set_loop(None),
        music.touch,
        lambda: music.set_duration(20),
    ]
    for epoch, change in enumerate(changes, 1):
        assert change().epoch == music.epoch == music.state().epoch == epoch


def test_touch_changes_nothing_else():
    music, hand = clock()
    music.play()
    hand.time += 3
    before = music.state()
    after = music.touch()
    assert (after.playing, after.song_time_s, after.rate) == (before.playing, before.song_time_s, before.rate)
    assert music.state(hand.time + 2).song_time_s == 5


def test_a_loop_wraps():
    music, hand = clock()
    music.set_loop(2, 5)
    music.play()
    times = music.state().song_times_at(hand.time + np.array([0, 4.5, 5, 6, 8, 11.5]))
    np.testing.assert_allclose(times, [0, 4.5, 2, 3, 2, 2.5], atol=1e-12)
    hand.time += 1000
    assert music.state().playing


def test_a_loop_that_was_passed_does_not_call_back():
    music, hand = clock()
    music.seek(6)
    music.set_loop(2, 5)
    music.play()
    assert music.state(hand.time + 3).song_time_s == 9
    assert not music.state(hand.time + 4).playing


def test_a_loop_to_the_end_goes_on():
    music, hand = clock()
    music.set_loop(8, 10)
    music.play()
    assert music.state(hand.time + 11).song_time_s == pytest.approx(9)


def test_set_duration_keeps_what_fits():
    music, _ = clock()
    music.set_loop(2, 9)
    music.seek(8)
    state = music.set_duration(7)
    assert (state.song_time_s, state.loop, state.duration_s) == (7, None, 7)


def test_server_time_of_a_song_time():
    music, hand = clock()
    assert music.state().server_time_of(0.0) == hand.time
    assert music.state().server_time_of(1.0) is None
    music.set_rate(2)
    music.set_loop(2, 5)
    state = music.play()
    assert state.server_time_of(4) == hand.time + 2
    assert state.server_time_of(5) is None
    later = state.at(hand.time + 2)
    assert later.song_time_s == 4
    assert later.server_time_of(3) == hand.time + 3
    assert later.server_time_of(1) is None


def refused(action: str, *arguments: float) -> Callable[[MusicClock], ClockState]:
    return lambda clock: getattr(clock, action)(*arguments)


@pytest.mark.parametrize(
    "wrong",
    [
        refused("seek", math.nan),
        refused("seek", math.inf),
        refused("set_rate", 0),
        refused("set_rate", -1),
        refused("set_rate", math.nan),
        refused("set_rate", 5),
        refused("set_loop", 3, 2),
        refused("set_loop", -1, 2),
        refused("set_loop", 1, 11),
        refused("set_loop", 1, 1.05),
        refused("set_loop", math.nan, 2),
    ],
)
def test_what_cannot_be_done_is_refused_and_changes_nothing(wrong: Callable[[MusicClock], ClockState]):
    music, _ = clock()
    before = music.state()
    with pytest.raises(ClockError):
        wrong(music)
    assert music.state() == before


@pytest.mark.parametrize("duration", [0, -1, math.inf, math.nan])
def test_a_song_has_a_length(duration: float):
    with pytest.raises(ValueError, match="song lasts"):
        MusicClock(Hand(), duration)
    with pytest.raises(ValueError, match="song lasts"):
        clock()[0].set_duration(duration)


def playing(song: float, rate: float, loop: tuple[float, float] | None, duration: float) -> ClockState:
    fits = loop if loop and loop[1] <= duration else None
    return ClockState(True, min(song, duration - 0.01), 100.0, rate, fits, 3, duration)


states = st.builds(
    playing,
    st.floats(0, 20),
    st.sampled_from([0.1, 0.5, 1.0, 1.3, 4.0]),
    st.one_of(st.none(), st.tuples(st.floats(0, 3), st.floats(3.5, 8))),
    st.floats(4, 20),
)


@given(states, st.floats(0, 60), st.floats(0, 60))
def test_a_state_is_a_function_of_the_last_change_and_the_time(
    state: ClockState, first: float, second: float
):
    between = state.at(100 + min(first, second))
    late = 100 + max(first, second)
    direct = state.at(late)
    via = between.at(late) if between.playing else between
    assert via.playing == direct.playing
    if state.loop is None:
        assert via.song_time_s == pytest.approx(direct.song_time_s, abs=1e-9)
    else:
        length = state.loop[1] - state.loop[0]
        apart = abs(via.song_time_s - direct.song_time_s)
        assert min(apart, abs(apart - length)) < 1e-9


@given(states, st.lists(st.floats(0, 60), min_size=2, max_size=8), st.sampled_from([24, 30, 60]))
def test_frames_due_come_once_and_at_their_time(state: ClockState, cuts: list[float], fps: int):
    whole_frames, whole_due = state.frames_due(100, 100 + max(cuts), fps)
    pieces = [
        state.frames_due(100 + a, 100 + b, fps)
        for a, b in zip([0.0, *sorted(cuts)], sorted(cuts), strict=False)
    ]
    assert np.concatenate([frames for frames, _ in pieces]).tolist() == whole_frames.tolist()
    np.testing.assert_allclose(np.concatenate([due for _, due in pieces]), whole_due, atol=1e-9)
    assert np.all(np.diff(whole_due) > -1e-9)
    heard = state.song_times_at(whole_due + 1e-7)
    np.testing.assert_allclose(heard, whole_frames / fps, atol=1e-5)


@given(states, st.floats(0.5, 60))
def test_spans_say_what_the_state_says(state: ClockState, until: float):
    spans = state.spans(100, 100 + until)
    for span in spans:
        middle = span.server_time_s + (span.end_s - span.start_s) / 2 / state.rate
        assert state.song_times_at(middle) == pytest.approx((span.start_s + span.end_s) / 2, abs=1e-6)
    heard = sum(span.end_s - span.start_s for span in spans)
    left = state.duration_s - state.song_time_s
    looping = state.loop is not None and state.song_time_s < state.loop[1]
    expected = until * state.rate if looping else min(until * state.rate, left)
    assert heard == pytest.approx(expected, abs=1e-6)
    assert not any(span.ends_song for span in spans[:-1])
    if abs(until * state.rate - left) > 1e-6:
        assert any(span.ends_song for span in spans) == (not looping and until * state.rate > left)


def test_a_seek_to_a_frame_begins_with_it_and_the_song_ends_with_its_last():
    music, hand = clock()
    for k in range(0, 600, 7):
        music.seek(k / 60)
        frames, due = music.play().frames_due(hand.time, hand.time + 20, 60)
        assert frames.tolist() == list(range(k, 601))
        assert due[0] == pytest.approx(hand.time, abs=1e-7)
    music.pause()
    assert len(music.state().frames_due(hand.time, hand.time + 1, 60)[0]) == 0


def test_a_count_in_passes_at_the_rate_before_song_time_runs():
    music, hand = clock()
    music.seek(4)
    music.set_rate(0.5)
    assert music.play(2).count_in_s == 2
    hand.time += 3
    state = music.state()
    assert (state.playing, state.song_time_s, state.count_in_s) == (True, 4, 0.5)
    assert state.server_time_of(4.5) == pytest.approx(hand.time + 2)
    hand.time += 2
    assert (music.state().song_time_s, music.state().count_in_s) == (4.5, 0)


def test_another_rate_within_a_count_in_goes_for_what_is_left_of_it():
    music, hand = clock()
    music.play(2)
    hand.time += 1
    assert music.set_rate(2).count_in_s == 1
    assert music.state(hand.time + 0.75).song_time_s == 0.5


@pytest.mark.parametrize("action", ["pause", "seek"])
def test_whoever_pauses_or_seeks_ends_the_count_in(action: str):
    music, hand = clock()
    music.play(2)
    hand.time += 1
    state = music.pause() if action == "pause" else music.seek(3)
    assert state.count_in_s == 0
    assert music.play().count_in_s == 0


def test_each_further_round_of_a_loop_is_counted_in():
    music, hand = clock()
    music.set_loop(2, 5, 1)
    music.seek(4)
    music.play(1)
    times = [0.5, 1.5, 2.0, 2.5, 3.0, 4.0, 5.9, 6.5, 7.5]
    states = [music.state(hand.time + time) for time in times]
    assert [state.song_time_s for state in states] == [4, 4.5, 2, 2, 2, 3, pytest.approx(4.9), 2, 2.5]
    assert [state.count_in_s for state in states] == [0.5, 0, 1, 0.5, 0, 0, 0, 0.5, 0]
    assert states[5].server_time_of(2.5) == pytest.approx(hand.time + 7.5)


@pytest.mark.parametrize("count_in_s", [-0.1, 121, math.nan])
def test_a_count_in_that_is_no_count_in_is_refused(count_in_s: float):
    music, _ = clock()
    before = music.state()
    for action in (lambda: music.play(count_in_s), lambda: music.set_loop(1, 2, count_in_s)):
        with pytest.raises(ClockError, match="count-in"):
            action()
    assert music.state() == before


@given(states, st.floats(0, 8), st.floats(0, 8), st.floats(0.5, 60))
def test_spans_and_states_agree_through_count_ins(
    state: ClockState, first_s: float, round_s: float, until: float
):
    state = replace(state, count_in_s=first_s, loop_count_in_s=round_s if state.loop else 0.0)
    spans = state.spans(100, 100 + until)
    for span in spans:
        middle = span.server_time_s + (span.end_s - span.start_s) / 2 / state.rate
        assert state.song_times_at(middle) == pytest.approx((span.start_s + span.end_s) / 2, abs=1e-6)
        assert state.at(middle).count_in_s == 0
    for one, next_one in itertools.pairwise(spans):
        ended = one.server_time_s + (one.end_s - one.start_s) / state.rate
        assert next_one.server_time_s - ended == pytest.approx(round_s / state.rate, abs=1e-6)
    heard = sum(span.end_s - span.start_s for span in spans)
    counted = first_s + round_s * max(len(spans) - 1, 0)
    run = max(until * state.rate - counted, 0.0)
    if state.loop is None or state.song_time_s >= state.loop[1]:
        run = min(run, state.duration_s - state.song_time_s)
        assert heard == pytest.approx(run, abs=1e-6)
    else:
        assert heard <= run + 1e-6
