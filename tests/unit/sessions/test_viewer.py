from __future__ import annotations

import asyncio
from dataclasses import replace

from reina.sessions.viewer import FRAMES_WAITING, MESSAGES_WAITING, TRY_AGAIN_LATER, Viewer
from reina.system.metrics import tally


class Line:
    """A connection that records, and that can be held up."""

    def __init__(self) -> None:
        self.sent: list[str | bytes] = []
        self.closed: tuple[int, str] | None = None
        self.open = asyncio.Event()
        self.open.set()

    async def send_bytes(self, data: bytes) -> None:
        await self.open.wait()
        self.sent.append(data)

    async def send_text(self, data: str) -> None:
        await self.open.wait()
        self.sent.append(data)

    async def close(self, code: int, reason: str) -> None:
        await self.open.wait()
        self.closed = (code, reason)


async def _settle() -> None:
    for _ in range(10):
        await asyncio.sleep(0)


def test_control_messages_go_before_frames_and_both_in_order() -> None:
    async def scenario() -> list[str | bytes]:
        line = Line()
        viewer = Viewer(line)
        viewer.post_frames(b"1")
        viewer.post_text("a")
        viewer.post_frames(b"2")
        viewer.post_text("b")
        running = asyncio.create_task(viewer.run())
        await _settle()
        viewer.post_frames(b"3")
        await _settle()
        running.cancel()
        return line.sent

    assert asyncio.run(scenario()) == ["a", "b", b"1", b"2", b"3"]


def test_a_viewer_that_does_not_read_loses_the_oldest_frames() -> None:
    async def scenario() -> tuple[list[str | bytes], int, int]:
        line = Line()
        line.open.clear()
        viewer = Viewer(line)
        running = asyncio.create_task(viewer.run())
        for number in range(1000):
            viewer.post_frames(b"%d" % number)
            await asyncio.sleep(0)
        waiting, dropped = viewer.waiting, viewer.dropped
        line.open.set()
        await _settle()
        for _ in range(FRAMES_WAITING):
            await asyncio.sleep(0)
        running.cancel()
        return line.sent, waiting, dropped

    sent, waiting, dropped = asyncio.run(scenario())
    assert waiting == FRAMES_WAITING
    # One was on its way when the line was held up.
    assert dropped == 1000 - FRAMES_WAITING - 1
    assert sent == [b"0", *(b"%d" % number for number in range(1000 - FRAMES_WAITING, 1000))]


def test_more_frames_may_wait_for_a_viewer_with_a_greater_lead() -> None:
    viewer = Viewer(Line(), frames_per_message=3)
    viewer.take_lead(1.0)
    for number in range(1000):
        viewer.post_frames(b"%d" % number)
    assert viewer.waiting == (FRAMES_WAITING + 54) // 3
    viewer.take_lead(0.1)
    assert viewer.waiting == FRAMES_WAITING // 3


def test_too_many_control_messages_end_it_with_try_again_later() -> None:
    async def scenario() -> tuple[tuple[int, str] | None, int]:
        line = Line()
        line.open.clear()
        viewer = Viewer(line)
        running = asyncio.create_task(viewer.run())
        for number in range(3 * MESSAGES_WAITING):
            viewer.post_text(str(number))
        waiting = viewer.waiting
        await _settle()
        line.open.set()
        await asyncio.wait_for(running, 5)
        return line.closed, waiting

    closed, waiting = asyncio.run(scenario())
    assert waiting == MESSAGES_WAITING
    assert closed is not None
    assert closed[0] == TRY_AGAIN_LATER


def test_frames_of_a_past_epoch_are_dropped() -> None:
    async def scenario() -> list[str | bytes]:
        line = Line()
        viewer = Viewer(line)
        viewer.post_frames(b"old")
        viewer.drop_frames()
        viewer.post_frames(b"new")
        running = asyncio.create_task(viewer.run())
        await _settle()
        running.cancel()
        return line.sent

    assert asyncio.run(scenario()) == [b"new"]


def test_a_session_that_ends_says_so() -> None:
    async def scenario() -> tuple[int, str] | None:
        line = Line()
        viewer = Viewer(line)
        running = asyncio.create_task(viewer.run())
        await _settle()
        viewer.end(1001, "the session has ended")
        await asyncio.wait_for(running, 5)
        return line.closed

    assert asyncio.run(scenario()) == (1001, "the session has ended")


def test_what_is_sent_and_what_is_lost_is_counted() -> None:
    async def scenario() -> None:
        line = Line()
        line.open.clear()
        viewer = Viewer(line, frames_per_message=3)
        running = asyncio.create_task(viewer.run())
        for _ in range(5):
            viewer.post_frames(b"123")
        line.open.set()
        await _settle()
        running.cancel()

    before = replace(tally)
    asyncio.run(scenario())
    assert tally.frames_sent - before.frames_sent == 4 * 3
    assert tally.frames_lost - before.frames_lost == 3
    assert tally.stream_bytes - before.stream_bytes == 4 * 3
