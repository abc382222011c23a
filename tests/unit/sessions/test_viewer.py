from __future__ import annotations

import asyncio
from dataclasses import replace

from tests.unit.sessions.fakes import Wire

from reina.protocol.websocket import binary_frame, text_frame
from reina.sessions.viewer import FRAMES_WAITING, MESSAGES_WAITING, TRY_AGAIN_LATER, Viewer
from reina.system.metrics import tally


def binary(number: int) -> bytes:
    return binary_frame(b"%d" % number)


def lagging(frames_per_message: int = 1) -> tuple[Wire, Viewer]:
    """A viewer into whose connection nothing more can be written."""
    wire = Wire()
    viewer = Viewer(wire, frames_per_message=frames_per_message)
    wire.hold()
    viewer.post_text(text_frame("fills it"))
    wire.frames.clear()
    return wire, viewer


def test_who_reads_is_written_to_at_once_and_has_no_queue() -> None:
    wire = Wire()
    viewer = Viewer(wire)
    frames = [binary(number) for number in range(1000)]
    for frame in frames:
        viewer.post_frames(frame)
        assert wire.frames[-1] is frame, "the same bytes, in the turn in which they are posted"
        assert viewer.waiting == 0
    assert len(wire.frames) == 1000
    assert viewer.dropped == 0


def test_control_messages_that_wait_go_before_frames_and_both_in_order() -> None:
    wire, viewer = lagging()
    viewer.post_frames(binary(1))
    viewer.post_text(text_frame("a"))
    viewer.post_frames(binary(2))
    viewer.post_text(text_frame("b"))
    assert wire.sent == []
    wire.let()
    viewer.post_frames(binary(3))
    assert wire.sent == ["a", "b", b"1", b"2", b"3"]
    assert viewer.waiting == 0


def test_a_viewer_that_does_not_read_loses_the_oldest_frames() -> None:
    wire = Wire()
    viewer = Viewer(wire)
    wire.hold()
    for number in range(1000):
        viewer.post_frames(binary(number))
    assert viewer.waiting == FRAMES_WAITING
    # One was on its way when the line was held up.
    assert viewer.dropped == 1000 - FRAMES_WAITING - 1
    wire.let()
    assert wire.sent == [b"0", *(b"%d" % number for number in range(1000 - FRAMES_WAITING, 1000))]
    viewer.post_frames(binary(1000))
    assert wire.sent[-1] == b"1000", "who keeps up again is written to at once again"


def test_what_waits_goes_as_far_as_there_is_room() -> None:
    wire, viewer = lagging()
    for number in range(3):
        viewer.post_frames(binary(number))
    for number in range(3):
        wire.is_full = False
        assert wire.on_free
        wire.on_free()
        assert wire.sent == [b"%d" % each for each in range(number + 1)]
        assert viewer.waiting == 2 - number


def test_more_frames_may_wait_for_a_viewer_with_a_greater_lead() -> None:
    _, viewer = lagging(frames_per_message=3)
    viewer.take_lead(1.0)
    for number in range(1000):
        viewer.post_frames(binary(number))
    assert viewer.waiting == (FRAMES_WAITING + 54) // 3
    viewer.take_lead(0.1)
    assert viewer.waiting == FRAMES_WAITING // 3


def test_too_many_control_messages_end_it_with_try_again_later() -> None:
    async def scenario() -> tuple[Wire, int]:
        wire, viewer = lagging()
        most = 0
        for number in range(3 * MESSAGES_WAITING):
            viewer.post_text(text_frame(str(number)))
            most = max(most, viewer.waiting)
        await asyncio.sleep(0)
        wire.let()
        return wire, most

    wire, most = asyncio.run(scenario())
    assert most == MESSAGES_WAITING
    assert wire.closed is not None
    assert wire.closed[0] == TRY_AGAIN_LATER
    assert wire.sent == [], "nothing is said after the goodbye"


def test_frames_of_a_past_epoch_are_dropped() -> None:
    wire, viewer = lagging()
    viewer.post_frames(binary(1))
    viewer.drop_frames()
    viewer.post_frames(binary(2))
    wire.let()
    assert wire.sent == [b"2"]


def test_a_session_that_ends_says_so_and_nothing_after() -> None:
    async def scenario() -> Wire:
        wire = Wire()
        viewer = Viewer(wire)
        viewer.end(1001, "the session has ended")
        viewer.end(1011, "another reason")
        viewer.post_frames(binary(1))
        viewer.post_text(text_frame("late"))
        await asyncio.sleep(0)
        return wire

    wire = asyncio.run(scenario())
    assert wire.closed == (1001, "the session has ended")
    assert wire.sent == []


def test_what_is_sent_and_what_is_lost_is_counted() -> None:
    before = replace(tally)
    wire, viewer = lagging(frames_per_message=3)
    for _ in range(5):
        assert not viewer.post_frames(binary(123))
    assert tally.frames_sent == before.frames_sent, "what waits is not sent"
    wire.let()
    assert tally.frames_sent - before.frames_sent == 4 * 3
    assert tally.frames_lost - before.frames_lost == 3
    assert tally.stream_bytes - before.stream_bytes == 4 * len(binary(123))
    assert viewer.post_frames(binary(4)), "counted by who sends it to many"
