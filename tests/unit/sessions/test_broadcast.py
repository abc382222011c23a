from __future__ import annotations

import pytest
from tests.unit.sessions.fakes import NumberedPerformance, encoded, read

from reina.music import ClockState
from reina.protocol import FrameFlag
from reina.sessions.broadcast import LEAD_S, Broadcast

FRAME = 1 / 60


def state(song_time_s: float = 0.0, *, playing: bool = True, at: float = 1000.0) -> ClockState:
    return ClockState(playing, song_time_s, at, 1.0, None, 7, 10.0)


def test_frames_go_out_a_lead_before_they_are_due() -> None:
    frames = encoded()
    broadcast = Broadcast(frames, state())
    first = read(frames, broadcast.until(1000.0, {1})[1])
    assert first["index"].tolist() == list(range(7))
    assert first["due_time_s"].max() <= 1000.0 + LEAD_S
    assert broadcast.until(1000.0 + 0.5 * FRAME, {1})[1] == []
    then = read(frames, broadcast.until(1000.0 + FRAME, {1})[1])
    assert then["index"].tolist() == [7]


def test_a_message_of_several_frames_goes_out_with_its_first() -> None:
    frames = encoded()
    broadcast = Broadcast(frames, state())
    messages = broadcast.until(1000.0, {4})[4]
    assert [len(message) // frames.manifest.frame_size for message in messages] == [4, 4]
    assert broadcast.until(1000.0 + FRAME, {4})[4] == []
    later = read(frames, broadcast.until(1000.0 + 2 * FRAME, {4})[4])
    assert later["index"].tolist() == [8, 9, 10, 11]


def test_a_greater_lead_sends_the_same_frames_earlier() -> None:
    frames = encoded()
    usual, early = Broadcast(frames, state()), Broadcast(frames, state(), lead_s=1.0)
    begun = early.begin(1000.0, {1})[1]
    assert begun == usual.until(1000.0, {1})[1], "what is due first is not held up by what is due later"
    rest = early.until(1000.0, {1})[1]
    assert read(frames, [*begun, *rest])["index"].tolist() == list(range(61))
    assert early.next_time() == pytest.approx(1000.0 + FRAME)
    assert early.frames_until(1000.0 + FRAME, {1}) == {61}
    later = usual.until(1000.9, {1})[1]
    assert rest[: len(later)] == later


def test_all_sizes_carry_the_same_frames() -> None:
    frames = encoded()
    broadcast = Broadcast(frames, state())
    sent: dict[int, list[bytes]] = {1: [], 3: []}
    for tick in range(30):
        for size, messages in broadcast.until(1000.0 + tick * FRAME, {1, 3}).items():
            sent[size] += messages
    one, three = read(frames, sent[1]).tobytes(), read(frames, sent[3]).tobytes()
    assert three[: len(one)] == one
    assert len(one) >= 36 * frames.manifest.frame_size


def test_many_viewers_cost_one_evaluation() -> None:
    performance = NumberedPerformance()
    broadcast = Broadcast(encoded(performance), state())
    for tick in range(60):
        broadcast.until(1000.0 + tick * FRAME, {1, 2, 3, 12})
    assert performance.evaluated == [0, 1]


def test_who_joins_late_goes_on_from_the_present_without_a_gap() -> None:
    frames = encoded()
    broadcast = Broadcast(frames, state())
    for tick in range(31):
        broadcast.until(1000.0 + tick * FRAME, {1})
    caught_up = broadcast.catch_up(state(30 * FRAME, at=1000.0 + 30 * FRAME), 1)
    after = broadcast.until(1000.0 + 31 * FRAME, {1})[1]
    got = read(frames, [*caught_up, *after])
    assert got["index"].tolist() == list(range(30, 38))
    assert not (got["flags"] & FrameFlag.FIRST).any()


def test_who_joins_late_with_a_size_of_their_own_goes_on_too() -> None:
    frames = encoded()
    broadcast = Broadcast(frames, state())
    broadcast.until(1000.5, {1})
    caught_up = broadcast.catch_up(state(0.5, at=1000.5), 5)
    after = broadcast.until(1000.5 + 4 * FRAME, {1, 5})[5]
    assert read(frames, [*caught_up, *after])["index"].tolist() == list(range(30, 45))


def test_while_paused_each_viewer_gets_one_frame() -> None:
    frames = encoded()
    broadcast = Broadcast(frames, state(2.0, playing=False))
    sent = read(frames, broadcast.until(1000.0, {1})[1])
    assert sent["index"].tolist() == [120]
    assert sent["flags"].tolist() == [FrameFlag.FIRST]
    assert broadcast.next_time() is None
    late = read(frames, broadcast.catch_up(state(2.0, playing=False, at=1005.0), 1))
    assert late["index"].tolist() == [120]
    assert broadcast.until(1006.0, {1})[1] == []


def test_the_next_time_is_a_lead_before_the_next_frame() -> None:
    broadcast = Broadcast(encoded(), state())
    broadcast.until(1000.0, {1})
    assert broadcast.next_time() == pytest.approx(1000.0 + 7 * FRAME - LEAD_S)


def test_frames_that_are_given_out_after_they_were_due_are_counted() -> None:
    broadcast = Broadcast(encoded(), state())
    broadcast.until(1000.0, {1, 3})
    # Sent are frames 0 to 6 one by one, and 0 to 8 in threes; due is a frame every 60th.
    assert broadcast.overdue(1000.0 + 7 * FRAME - 1e-6) == {}
    assert broadcast.overdue(1000.0 + 10.5 * FRAME) == {1: 4, 3: 2}
    broadcast.until(1000.0 + 10.5 * FRAME, {1, 3})
    assert broadcast.overdue(1000.0 + 10.5 * FRAME) == {}
