"""Everybody who watches a session, and the loop that keeps them in frames."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from typing import TYPE_CHECKING

from reina.performance import BLOCK_FRAMES
from reina.protocol.messages import StreamError
from reina.sessions.block_broadcast import BlockBroadcast
from reina.sessions.broadcast import Broadcast
from reina.sessions.description import transport_message
from reina.sessions.viewer import GOING_AWAY, INTERNAL_ERROR
from reina.system.metrics import tally

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from pydantic import BaseModel

    from reina.music import ClockState, MusicClock
    from reina.sessions.frames import EncodedFrames
    from reina.sessions.note_messages import NoteMessages
    from reina.sessions.packed_blocks import Form, PackedBlocks
    from reina.sessions.viewer import Viewer

LAST_FRAME_S = 1 / 60
"""How often it is looked whether the music has ended, once its last frame is sent."""

AHEAD_S = 0.5
"""How long before they are sent frames are evaluated."""

_log = logging.getLogger(__name__)


class Audience:
    """The viewers of one session.

    One ticker serves all of them: what is due is evaluated and encoded once, then posted to each viewer's
    outbox. `tick` does one turn and takes the time from outside; `_run` is the loop around it, which waits
    for the times of the schedule so that no turn's delay adds up.

    Args:
        blocks: The session's frames, as they are and packed.
        clock: The session's music clock.
        notes: Tells of notes as the music passes them.
        now: Server time, seconds; the clock's own.
        pushes_blocks: Whether packed blocks are sent; else whoever watches by them fetches them.
    """

    def __init__(
        self,
        blocks: PackedBlocks,
        clock: MusicClock,
        notes: NoteMessages,
        *,
        now: Callable[[], float],
        pushes_blocks: bool = True,
    ) -> None:
        self._pushes_blocks = pushes_blocks
        self.blocks = blocks
        """What is sent."""
        self._clock = clock
        self._notes = notes
        self._now = now
        self._viewers: set[Viewer] = set()
        self._state = clock.state()
        self._resumed = False
        self._broadcasts: dict[float, Broadcast] = {}
        self._block_broadcasts: dict[Form, BlockBroadcast] = {}
        self._woken = asyncio.Event()
        self._ticking: asyncio.Task[None] | None = None
        notes.begin(self._state)

    def __len__(self) -> int:
        return len(self._viewers)

    @property
    def frames(self) -> EncodedFrames:
        """The frames as they are."""
        return self.blocks.frames

    @property
    def forms(self) -> set[Form]:
        """The forms in which packed blocks are sent to somebody."""
        return {viewer.form for viewer in self._viewers if viewer.form is not None and self._pushes_blocks}

    def join(self, viewer: Viewer, hello: Callable[[ClockState], str]) -> None:
        """Take a viewer in: `hello`, the notes that sound, and the frames from the present on.

        Args:
            viewer: Who comes.
            hello: The text of `hello`, given the clock's state.
        """
        now = self._now()
        self._settle(now)
        state = self._clock.state(now)
        if self._viewers:
            self._post(self._notes.advance(now))
        else:
            # What went by while nobody watched is not made up for.
            self._notes.begin(state)
        for text in (hello(state), *self._notes.sounding()):
            viewer.post_text(text)
        self._catch_up(viewer, state)
        self._viewers.add(viewer)
        self._woken.set()
        if self._ticking is None:
            self._ticking = asyncio.create_task(self._run())
            self._ticking.add_done_callback(self._stopped)

    def take_lead(self, viewer: Viewer, lead_s: float) -> None:
        """Send to a viewer so long before it is due, seconds; a few frames may be sent again."""
        now = self._now()
        self._settle(now)
        viewer.take_lead(lead_s)
        if viewer in self._viewers:
            self._catch_up(viewer, self._clock.state(now))
            self._woken.set()

    def leave(self, viewer: Viewer) -> None:
        """Let a viewer go; the last one stops the ticker."""
        self._viewers.discard(viewer)
        if not self._viewers:
            self.blocks.forget()
            # Who comes next begins at the present, not where the last one left off.
            self._broadcasts, self._block_broadcasts = {}, {}
            self._resumed = True
            if self._ticking:
                self._ticking.cancel()
                self._ticking = None

    def dismiss(self) -> None:
        """Close everybody: the session is no more."""
        for viewer in self._viewers:
            viewer.end(GOING_AWAY, "the session has ended")

    def announce(self, message: BaseModel) -> None:
        """Post a control message to everybody."""
        if self._viewers:
            self._post([message.model_dump_json()])

    def restart(self, blocks: PackedBlocks | None = None, notes: NoteMessages | None = None) -> None:
        """Begin the clock's new epoch: tell its transport, drop what waits, send from the present on.

        Args:
            blocks: Where the bytes come from now on; the same as before when None.
            notes: What is told of notes now on; the same as before when None.
        """
        self.blocks = blocks or self.blocks
        now = self._now()
        if self._viewers:
            # What came before the change is told before it.
            self._post(self._notes.advance(now))
            if notes is not None:
                self._post(self._notes.end())
        self._notes = notes or self._notes
        self._begin(self._clock.state(now), resumed=False)
        for viewers, broadcast in self._by_lead():
            self._send(viewers, broadcast.begin(now, _sizes(viewers)))
        self._send_blocks(now)
        self._woken.set()

    def song_time_s(self, later_s: float = 0.0) -> float:
        """What will be heard so much later, as the clock runs at present."""
        return float(self._clock.state().song_times_at(self._now() + later_s))

    def tick(self, now: float) -> bool:
        """Send what is due by `now`; returns whether more will be due without the clock being changed."""
        self._settle(now)
        self._post(self._notes.advance(now))
        self._send_due(now)
        return self._state.playing

    def _settle(self, now: float) -> None:
        """Take note of the music's end, which the clock comes to by itself."""
        state = self._clock.state(now)
        if self._state.playing and not state.playing:
            self._begin(state, resumed=True)

    def _begin(self, state: ClockState, *, resumed: bool) -> None:
        self._state = state
        self._resumed = resumed
        self._broadcasts, self._block_broadcasts = {}, {}
        for viewer in self._viewers:
            viewer.drop_frames()
        self.announce(transport_message(state))
        self._post(self._notes.begin(state))

    def _send_due(self, now: float) -> None:
        for viewers, broadcast in self._by_lead():
            if overdue := broadcast.overdue(now):
                tally.frames_late += sum(overdue.get(viewer.frames_per_message, 0) for viewer in viewers)
            self._send(viewers, broadcast.until(now, _sizes(viewers)))
        self._send_blocks(now)

    def _send_blocks(self, now: float) -> None:
        for viewers, broadcast in self._by_form():
            tally.frames_late += BLOCK_FRAMES * broadcast.overdue(now) * len(viewers)
            for message in broadcast.until(now):
                for viewer in viewers:
                    viewer.post_frames(message)

    def _send(self, viewers: list[Viewer], messages: dict[int, list[bytes]]) -> None:
        for viewer in viewers:
            for message in messages[viewer.frames_per_message]:
                viewer.post_frames(message)

    def _catch_up(self, viewer: Viewer, state: ClockState) -> None:
        if viewer.form is not None:
            if not self._pushes_blocks:
                return
            # Where it is the first of its form the ticker sends all of it.
            broadcast = self._block_broadcasts.get(viewer.form)
            if broadcast is None:
                broadcast = BlockBroadcast(self.blocks, viewer.form, state)
                self._block_broadcasts[viewer.form] = broadcast
            for message in broadcast.catch_up(state):
                viewer.post_frames(message)
            return
        for message in self._broadcast(viewer.lead_s).catch_up(state, viewer.frames_per_message):
            viewer.post_frames(message)

    def _by_lead(self) -> list[tuple[list[Viewer], Broadcast]]:
        """The viewers by their lead, with what they are sent; a broadcast that is nobody's is dropped."""
        groups: dict[float, list[Viewer]] = {}
        for viewer in self._viewers:
            if viewer.form is None:
                groups.setdefault(viewer.lead_s, []).append(viewer)
        self._broadcasts = {lead_s: self._broadcast(lead_s) for lead_s in groups}
        return [(viewers, self._broadcasts[lead_s]) for lead_s, viewers in groups.items()]

    def _by_form(self) -> list[tuple[list[Viewer], BlockBroadcast]]:
        """Those who watch by packed blocks, by their form, with what they are sent."""
        groups: dict[Form, list[Viewer]] = {}
        for viewer in self._viewers:
            if viewer.form is not None and self._pushes_blocks:
                groups.setdefault(viewer.form, []).append(viewer)
        known = self._block_broadcasts
        self._block_broadcasts = {
            form: known.get(form) or BlockBroadcast(self.blocks, form, self._state) for form in groups
        }
        return [(viewers, self._block_broadcasts[form]) for form, viewers in groups.items()]

    def _broadcast(self, lead_s: float) -> Broadcast:
        broadcast = self._broadcasts.get(lead_s)
        if broadcast is None:
            broadcast = Broadcast(self.frames, self._state, resumed=self._resumed, lead_s=lead_s)
            self._broadcasts[lead_s] = broadcast
        return broadcast

    def _due_frames(self, now: float) -> set[int]:
        due: set[int] = set()
        for viewers, broadcast in self._by_lead():
            due |= broadcast.frames_until(now, _sizes(viewers))
        return due

    def _post(self, texts: Iterable[str]) -> None:
        for text in texts:
            for viewer in self._viewers:
                viewer.post_text(text)

    def _stopped(self, ticking: asyncio.Task[None]) -> None:
        """A ticker that fails leaves nobody in front of a picture that stands still without a word."""
        if ticking.cancelled():
            return
        _log.error("the ticker of a session failed", exc_info=ticking.exception())
        self._ticking = None
        self.announce(StreamError(title="The stream has failed", detail="the server has noted why"))
        for viewer in self._viewers:
            viewer.end(INTERNAL_ERROR, "the stream has failed")

    async def _run(self) -> None:
        while True:
            self._woken.clear()
            now = self._now()
            missing = self.frames.missing(self._due_frames(now))
            if missing:
                # What was not evaluated ahead in time is not evaluated here either: the event loop is
                # everybody's.
                await self.frames.evaluated(missing)
                if self._woken.is_set():
                    continue
            packing = await self._pack_next(now)
            if packing and self._woken.is_set():
                continue
            playing = self.tick(now)
            if packing:
                # One at a time: what is needed first goes out first.
                continue
            if not playing:
                await self._woken.wait()
                continue
            await asyncio.sleep(0)  # the viewers' outboxes first
            if self._broadcasts:
                self.frames.prefetch(self.song_time_s(max(self._broadcasts) + AHEAD_S))
            # The schedule's own times are the deadlines: a turn that was late delays none after it.
            broadcasts = (*self._broadcasts.values(), *self._block_broadcasts.values())
            times = [broadcast.next_time() for broadcast in broadcasts]
            next_time = min((time for time in times if time is not None), default=None)
            wait_s = max(0.0, next_time - self._now()) if next_time else LAST_FRAME_S
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(wait_s):
                    await self._woken.wait()

    async def _pack_next(self, now: float) -> bool:
        """Have one block packed that is due and is not yet; returns whether there was one."""
        for form, broadcast in list(self._block_broadcasts.items()):
            for number in broadcast.missing(now)[:1]:
                await self.blocks.made([number], form)
                return True
        return False


def _sizes(viewers: list[Viewer]) -> set[int]:
    return {viewer.frames_per_message for viewer in viewers}
