from __future__ import annotations

import asyncio

import numpy as np
import pytest
from tests.unit.sessions.fakes import NumberedPerformance, encoded, read

from reina.protocol import FrameFlag
from reina.sessions.schedule import DueFrame


def test_a_block_is_evaluated_once() -> None:
    performance = NumberedPerformance()
    frames = encoded(performance)
    for index in (0, 59, 60, 5, 61):
        frames.message([DueFrame(index, 1.0)], epoch=1, playing=True)
    assert performance.evaluated == [0, 1]


def test_blocks_are_made_ready_on_a_thread_of_their_own() -> None:
    performance = NumberedPerformance()
    frames = encoded(performance)

    async def scenario() -> None:
        await frames.ready(0.0, 1.0)
        frames.prefetch(2)
        frames.prefetch(2)

    asyncio.run(scenario())
    assert performance.evaluated[:2] == [0, 1]
    # Whoever needs one that is being evaluated waits for it, and it is evaluated once.
    got = frames.block(2)
    assert performance.evaluated == [0, 1, 2, 3]
    assert all(name.startswith("frames") for name in performance.threads[:2])
    assert got.tobytes() == encoded().block(2).tobytes()


def test_the_first_block_comes_alone_and_more_at_once_as_somebody_plays_on() -> None:
    performance = NumberedPerformance()
    frames = encoded(performance)
    spans: list[list[int]] = []
    for number in (20, 21, 22, 24, 27, 31, 50, 51):
        performance.evaluated.clear()
        frames.block(number)
        spans.append(performance.evaluated.copy())
    assert spans == [[20], [21], [22, 23], [24, 25, 26, 27], [], [31], [50], [51]]


def test_all_that_a_seek_needs_is_evaluated_at_once_however_many_play() -> None:
    performance = NumberedPerformance(blocks_at_once=1)
    frames = encoded(performance)
    asyncio.run(frames.ready(9.9, 10.2))
    assert performance.evaluated == [9, 10]
    assert performance.spans == [2]


def test_what_is_there_is_not_evaluated_again_with_others() -> None:
    performance = NumberedPerformance()
    frames = encoded(performance)
    for number in (4, 0, 1, 2):
        frames.block(number)
    assert performance.evaluated == [4, 0, 1, 2, 3]
    assert frames.block(3).tobytes() == encoded().block(3).tobytes()


@pytest.mark.parametrize("kept", [2, 3])
def test_no_more_are_evaluated_at_once_than_are_kept_beside_the_one_that_is_sent(kept: int) -> None:
    performance = NumberedPerformance()
    frames = encoded(performance, kept=kept)
    for number in range(8):
        frames.block(number)
    assert performance.evaluated == list(range(8))


def test_only_the_last_used_blocks_are_kept() -> None:
    performance = NumberedPerformance()
    frames = encoded(performance, kept=2)
    for number in (0, 1, 0, 2, 0, 1):
        frames.block(number)
    assert performance.evaluated == [0, 1, 2, 1]


def test_a_message_is_stamped_frames_back_to_back() -> None:
    frames = encoded()
    due = [DueFrame(58, 7.0, first=True), DueFrame(59, 7.5), DueFrame(60, 8.0, cut=True)]
    sent = read(frames, [frames.message(due, epoch=259, playing=True)])
    assert sent["index"].tolist() == [58, 59, 60]
    assert sent["parameters"][:, 0].tolist() == [58, 59, 60]
    assert sent["due_time_s"].tolist() == [7.0, 7.5, 8.0]
    assert sent["epoch"].tolist() == [3, 3, 3]
    assert sent["flags"].tolist() == [
        FrameFlag.PLAYING | FrameFlag.FIRST,
        FrameFlag.PLAYING,
        FrameFlag.PLAYING | FrameFlag.CUT,
    ]


def test_stamping_leaves_the_kept_block_as_it_is() -> None:
    frames = encoded()
    frames.message([DueFrame(3, 7.0, first=True)], epoch=1, playing=True)
    assert frames.block(0)["epoch"].tolist() == [0] * 60
    with pytest.raises(ValueError, match="read-only"):
        frames.block(0)["epoch"] = 1


@pytest.mark.parametrize(("cut", "flagged"), [(3, False), (4, True), (5, True), (6, True), (7, False)])
def test_a_cut_among_frames_that_are_passed_over_is_not_lost(cut: int, *, flagged: bool) -> None:
    frames = encoded(NumberedPerformance(cuts=frozenset({cut})))
    sent = read(frames, [frames.message([DueFrame(6, 1.0, skipped=2)], epoch=0, playing=True)])
    assert bool(sent["flags"][0] & FrameFlag.CUT) is flagged


def test_a_span_crosses_blocks() -> None:
    span = encoded().span(50, 130)
    assert span["index"].tolist() == list(range(50, 131))
    assert np.array_equal(span["parameters"][:, 0], np.arange(50, 131))


def test_what_was_forgotten_is_the_same_again() -> None:
    frames = encoded()
    before = frames.block(1).tobytes()
    frames.forget()
    assert frames.block(1).tobytes() == before
