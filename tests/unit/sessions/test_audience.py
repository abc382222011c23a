from __future__ import annotations

import asyncio
import json
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from tests.unit.sessions.fakes import HandClock, NumberedPerformance, Wire, encoded, packed, read

from reina.instruments import ValvesFingering
from reina.music import MusicClock
from reina.protocol import FrameFlag
from reina.protocol.notes import WireNote
from reina.protocol.websocket import message_of
from reina.sessions.audience import Audience
from reina.sessions.broadcast import LEAD_S
from reina.sessions.note_messages import NoteMessages
from reina.sessions.ticker import Ticker
from reina.sessions.viewer import Viewer

if TYPE_CHECKING:
    from collections.abc import Callable

    import pytest

    from reina.protocol import Frames

FRAME = 1 / 60


def note(index: int) -> WireNote:
    return WireNote(
        index=index,
        part=0,
        onset_s=float(index),
        duration_s=0.5,
        onset_beats=2.0 * index,
        duration_beats=1.0,
        sounding_pitch=60 + index,
        written_pitch=62 + index,
        sounding_name="C4",
        written_name="D4",
        velocity=0.8,
        valves=[1],
        usual_valves=[1],
        fingering=ValvesFingering(valves=(1,)),
        reason="the usual fingering",
        player=0,
        in_played_part=True,
    )


class Inbox(Viewer):
    """A viewer whose post is read by hand."""

    def __init__(self, frames_per_message: int = 1) -> None:
        super().__init__(Wire(), frames_per_message=frames_per_message)
        self.texts: list[dict[str, Any]] = []
        self.posted: list[bytes] = []
        self.ended: tuple[int, str] | None = None

    def end(self, code: int, reason: str) -> None:
        self.ended = (code, reason)

    def post_text(self, frame: bytes) -> None:
        self.texts.append(json.loads(message_of(frame)))

    def post_frames(self, frame: bytes) -> bool:
        self.posted.append(frame)
        return True

    def drop_frames(self) -> None:
        self.posted.clear()

    @property
    def types(self) -> list[str]:
        return [str(text["type"]) for text in self.texts]


class Hall:
    """An audience whose ticks are turned by hand, over three notes of half a second at 0, 1 and 2 s."""

    def __init__(self, now: HandClock | None = None, ticker: Ticker | None = None) -> None:
        self.now = now or HandClock()
        self.ticker = Ticker() if ticker is None else ticker
        self.clock = MusicClock(self.now, 3.0)
        self.performance = NumberedPerformance()
        self.frames = encoded(self.performance)
        onsets = np.arange(3.0)
        notes = NoteMessages(onsets, onsets + 0.5, np.array([60, 61, 62]), note)
        self.audience = Audience(packed(self.frames), self.clock, notes, now=self.now, ticker=self.ticker)

    def join(self, frames_per_message: int = 1) -> Inbox:
        inbox = Inbox(frames_per_message)
        self.audience.join(inbox, lambda _: '{"type": "hello"}')
        return inbox

    def run(self, seconds: float) -> None:
        for _ in range(round(seconds / FRAME)):
            self.now.time_s += FRAME
            self.audience.tick(self.now())

    def read(self, inbox: Inbox) -> Frames:
        got = read(self.frames, [cast("bytes", message_of(frame)) for frame in inbox.posted])
        inbox.posted.clear()
        return got


async def until(sign: Callable[[], object]) -> None:
    """Let the event loop run until something has come about."""
    async with asyncio.timeout(30):
        while not sign():  # noqa: ASYNC110 - what comes about has no event
            await asyncio.sleep(0.001)


def in_hall(scenario: Callable[[Hall], None]) -> None:
    """Run a scenario inside an event loop, whose own ticker never gets a turn."""

    async def run() -> None:
        scenario(Hall())

    asyncio.run(run())


def test_whoever_joins_hears_hello_first_and_sees_the_present() -> None:
    def scenario(hall: Hall) -> None:
        hall.clock.seek(1.25)
        hall.audience.restart()
        inbox = hall.join()
        assert inbox.types == ["hello", "note_on"]
        assert hall.read(inbox)["index"].tolist() == [75]

    in_hall(scenario)


def test_a_viewer_behind_a_slow_network_is_sent_its_frames_earlier_and_nobody_else() -> None:
    def scenario(hall: Hall) -> None:
        near, far = hall.join(3), hall.join(3)
        hall.clock.play()
        hall.audience.restart()
        hall.run(0.2)
        hall.audience.take_lead(far, 0.93)
        hall.run(0.1)
        seen = hall.read(far)
        assert seen["due_time_s"].max() > hall.now() + 0.98, "a lead is rounded up to a tenth"
        assert set(range(18 + 60)) <= set(seen["index"].tolist()), "without a gap"
        assert hall.read(near)["due_time_s"].max() < hall.now() + LEAD_S + 2 * FRAME
        hall.clock.seek(0.5)
        hall.audience.restart()
        assert hall.read(far)["due_time_s"].max() < hall.now() + LEAD_S + 3 * FRAME, "the present first"
        hall.run(0.05)
        hall.audience.take_lead(far, LEAD_S)
        hall.run(1.2)
        seen = hall.read(far)
        assert seen["due_time_s"].max() < hall.now() + LEAD_S + 2 * FRAME
        assert set(range(37, 30 + 75)) <= set(seen["index"].tolist()), "without a gap"
        hall.clock.pause()
        hall.audience.restart()
        assert len(hall.read(far)) == 1

    in_hall(scenario)


def test_playing_sends_every_frame_once_in_order() -> None:
    def scenario(hall: Hall) -> None:
        inbox = hall.join()
        hall.read(inbox)
        hall.clock.play()
        hall.audience.restart()
        hall.run(1.05)
        got = hall.read(inbox)
        assert got["index"].tolist() == list(range(len(got)))
        assert 69 <= len(got) <= 70, "the time and the lead"
        assert (got["flags"] & FrameFlag.PLAYING).all()
        assert got["flags"][0] & FrameFlag.FIRST
        assert not (got["flags"][1:] & FrameFlag.FIRST).any()
        assert set(got["epoch"].tolist()) == {1}
        assert inbox.types == ["hello", "note_on", "transport", "note_off", "note_on"]

    in_hall(scenario)


def test_every_change_sends_the_present_at_once_under_a_new_epoch() -> None:
    def scenario(hall: Hall) -> None:
        inbox = hall.join()
        hall.clock.play()
        hall.audience.restart()
        hall.run(0.5)
        hall.read(inbox)
        hall.clock.seek(2.5)
        hall.audience.restart()
        got = hall.read(inbox)
        assert got["index"][0] == 150
        assert got["due_time_s"][0] == hall.now()
        assert set(got["epoch"].tolist()) == {2}
        hall.clock.pause()
        hall.audience.restart()
        paused = hall.read(inbox)
        assert paused["index"].tolist() == [150]
        assert paused["flags"].tolist() == [FrameFlag.FIRST]

    in_hall(scenario)


def test_two_viewers_get_the_same_bytes() -> None:
    def scenario(hall: Hall) -> None:
        first, second = hall.join(), hall.join()
        first.posted.clear()
        second.posted.clear()
        hall.clock.play()
        hall.audience.restart()
        hall.run(0.5)
        assert first.posted == second.posted
        assert all(one is other for one, other in zip(first.posted, second.posted, strict=True))

    in_hall(scenario)


def test_the_end_is_told_once_with_a_last_frame() -> None:
    def scenario(hall: Hall) -> None:
        inbox = hall.join()
        hall.clock.seek(2.4)
        hall.clock.play()
        hall.audience.restart()
        inbox.texts.clear()
        hall.run(1.0)
        got = hall.read(inbox)
        assert got["index"].tolist() == [180], "what waited of the music is dropped, the last frame is there"
        assert not (got["flags"] & (FrameFlag.PLAYING | FrameFlag.FIRST)).any()
        assert inbox.types == ["note_off", "transport"]
        assert inbox.texts[-1]["playing"] is False
        assert inbox.texts[-1]["song_time_s"] == 3.0

    in_hall(scenario)


def test_a_loop_strikes_its_notes_anew() -> None:
    def scenario(hall: Hall) -> None:
        inbox = hall.join()
        hall.clock.set_loop(0.9, 1.2)
        hall.clock.seek(0.9)
        hall.clock.play()
        hall.audience.restart()
        inbox.texts.clear()
        hall.run(0.75)
        assert inbox.types == ["note_on", "note_off", "note_on", "note_off", "note_on"]
        cuts = hall.read(inbox)["flags"] & FrameFlag.CUT
        assert np.flatnonzero(cuts).tolist() == [18, 36]

    in_hall(scenario)


def test_an_edit_is_in_the_next_frames() -> None:
    def scenario(hall: Hall) -> None:
        inbox = hall.join()
        hall.clock.play()
        hall.audience.restart()
        hall.run(0.5)
        hall.read(inbox)
        edited = NumberedPerformance(cuts=frozenset({30}))
        hall.clock.touch()
        hall.audience.restart(packed(encoded(edited)))
        got = hall.read(inbox)
        assert got["index"][0] == 30
        assert got["flags"][0] & FrameFlag.CUT

    in_hall(scenario)


def test_something_is_due_only_while_somebody_watches() -> None:
    async def scenario() -> None:
        hall = Hall()
        before = len(asyncio.all_tasks())
        hall.clock.play()
        inbox = hall.join()
        assert len(hall.ticker) == 1
        await until(lambda: len(inbox.posted) > 1)
        assert len(hall.ticker) == 1, "the next frame"
        assert len(asyncio.all_tasks()) == before, "nobody has a task"
        hall.audience.leave(inbox)
        assert len(hall.ticker) == 0

    asyncio.run(scenario())


def test_nothing_is_due_while_a_session_is_paused() -> None:
    async def scenario() -> None:
        hall = Hall()
        inbox = hall.join()
        assert len(hall.ticker) == 1
        await until(lambda: not len(hall.ticker))
        assert len(inbox.posted) == 1

    asyncio.run(scenario())


def test_two_sessions_share_a_ticker_and_one_that_breaks_leaves_the_other_alone(
    caplog: pytest.LogCaptureFixture,
) -> None:
    async def scenario() -> None:
        ticker, now = Ticker(), HandClock()
        halls = [Hall(now, ticker), Hall(now, ticker)]
        first, second = (hall.join() for hall in halls)
        for hall in halls:
            hall.clock.play()
            hall.audience.restart()
        await until(lambda: first.posted and second.posted)
        halls[0].performance.broken = True
        halls[0].frames.forget()
        for _ in range(100):
            now.time_s += FRAME
            await asyncio.sleep(0.001)
        await until(lambda: first.ended is not None)
        assert first.ended == (1011, "the stream has failed")
        assert first.types[-1] == "error"
        await until(lambda: len(second.posted) >= 100)
        got = halls[1].read(second)
        assert got["index"].tolist() == list(range(len(got))), "every frame, in order"
        assert second.ended is None
        assert len(ticker) == 1, "nothing of the broken one is to come"

    asyncio.run(scenario())
    assert "the stream of a session failed" in caplog.text


def test_a_ticker_that_fails_lets_everybody_go(caplog: pytest.LogCaptureFixture) -> None:
    async def scenario() -> tuple[int, str] | None:
        hall = Hall()
        inbox = hall.join()
        hall.clock.play()
        hall.audience.restart()
        await asyncio.sleep(0)
        hall.frames.forget()
        hall.clock.seek(2.0)
        hall.performance.broken = True
        # The ticker itself comes upon it, some turns later.
        hall.now.time_s += 0.5
        for _ in range(100):
            await asyncio.sleep(0.001)
            if inbox.ended:
                break
        return inbox.ended

    assert asyncio.run(scenario()) == (1011, "the stream has failed")
    assert "the stream of a session failed" in caplog.text


def test_the_event_loop_evaluates_nothing_while_it_sends(monkeypatch: pytest.MonkeyPatch) -> None:
    """Not even what was not evaluated ahead: at a loop's seam, at four times the speed, after a hitch."""

    async def scenario() -> None:
        hall = Hall()

        def wait_for_need(_: object) -> None:
            pass

        monkeypatch.setattr(hall.frames, "prefetch", wait_for_need)
        inbox = hall.join()
        hall.performance.threads.clear()
        seen: set[int] = set()
        for rate in (1.0, 4.0):
            hall.clock.set_rate(rate)
            hall.clock.set_loop(0.0, 2.5)
            hall.clock.play()
            hall.frames.forget()
            await hall.frames.ready(0.0, 2.0)
            hall.audience.restart()
            for step in range(40):
                hall.now.time_s += 1.2 if step == 20 else 0.08
                if step % 5 == 0:
                    hall.frames.forget()
                await asyncio.sleep(0.02)
                seen.update(hall.read(inbox)["index"].tolist() if inbox.posted else ())
        hall.audience.leave(inbox)
        assert len(hall.performance.evaluated) > 10
        assert len(seen) > 100
        assert {name.rstrip("_0123456789") for name in hall.performance.threads} == {"frames"}

    asyncio.run(scenario())


def test_what_went_by_while_nobody_watched_is_not_made_up_for() -> None:
    def scenario(hall: Hall) -> None:
        first = hall.join()
        hall.clock.set_loop(0.0, 3.0)
        hall.clock.play()
        hall.audience.restart()
        hall.run(0.1)
        hall.audience.leave(first)
        evaluated = len(hall.performance.evaluated)
        hall.now.time_s += 3600.0 + 0.3
        late = hall.join()
        assert late.types == ["hello", "note_on"]
        hall.audience.tick(hall.now())
        got = hall.read(late)
        assert got["index"].tolist() == list(range(24, 31)), "the present and the lead"
        assert np.all(got["due_time_s"] > hall.now() - 2 * FRAME)
        assert len(hall.performance.evaluated) - evaluated <= 1

    in_hall(scenario)


def test_a_change_tells_of_what_came_before_it() -> None:
    def scenario(hall: Hall) -> None:
        inbox = hall.join()
        hall.clock.play()
        hall.audience.restart()
        hall.run(0.9)
        inbox.texts.clear()
        # The note at 1 s begins and ends between two ticks, then the rate is changed.
        hall.now.time_s += 0.65
        hall.clock.set_rate(2.0)
        hall.audience.restart()
        assert inbox.types == ["note_on", "note_off", "transport"]
        assert [text.get("song_time_s") for text in inbox.texts[:2]] == [1.0, 1.5]

    in_hall(scenario)


def test_other_notes_end_those_that_sound() -> None:
    def scenario(hall: Hall) -> None:
        hall.clock.seek(1.25)
        hall.audience.restart()
        inbox = hall.join()
        inbox.texts.clear()
        other = NoteMessages(np.array([1.2]), np.array([1.4]), np.array([70]), lambda _: note(7))
        hall.clock.touch()
        hall.audience.restart(notes=other)
        assert [(text["type"], text.get("index")) for text in inbox.texts] == [
            ("note_off", 1),
            ("transport", None),
            ("note_on", 7),
        ]

    in_hall(scenario)
