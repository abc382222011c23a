"""Everybody who watches a session, and the loop that keeps them in frames."""

from __future__ import annotations

import asyncio
import contextlib
from typing import TYPE_CHECKING

from reina.sessions.broadcast import Broadcast
from reina.sessions.description import transport_message

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from pydantic import BaseModel

    from reina.music import ClockState, MusicClock
    from reina.sessions.frames import EncodedFrames
    from reina.sessions.note_messages import NoteMessages
    from reina.sessions.viewer import Viewer

TICK_S = 1 / 60
LATEST_S = 0.25
"""A turn that is later than this is not made up for."""


class Audience:
    """The viewers of one session.

    One ticker serves all of them: what is due is evaluated and encoded once, then posted to each viewer's
    outbox. `tick` does one turn and takes the time from outside; `_run` is the loop around it, which waits
    for absolute deadlines so that no turn's delay adds up.

    Args:
        frames: The session's encoded frames.
        clock: The session's music clock.
        notes: Tells of notes as the music passes them.
        now: Server time, seconds; the clock's own.
    """

    def __init__(
        self,
        frames: EncodedFrames,
        clock: MusicClock,
        notes: NoteMessages,
        *,
        now: Callable[[], float],
    ) -> None:
        self._frames = frames
        self._clock = clock
        self._notes = notes
        self._now = now
        self._viewers: set[Viewer] = set()
        self._state = clock.state()
        self._broadcast = Broadcast(frames, self._state)
        self._woken = asyncio.Event()
        self._ticking: asyncio.Task[None] | None = None
        notes.begin(self._state)

    def __len__(self) -> int:
        return len(self._viewers)

    def join(self, viewer: Viewer, hello: Callable[[ClockState], str]) -> None:
        """Take a viewer in: `hello`, the notes that sound, and the frames from the present on.

        Args:
            viewer: Who comes.
            hello: The text of `hello`, given the clock's state.
        """
        now = self._now()
        self._settle(now)
        self._post(self._notes.advance(now))
        state = self._clock.state(now)
        for text in (hello(state), *self._notes.sounding()):
            viewer.post_text(text)
        for message in self._broadcast.catch_up(state, viewer.frames_per_message):
            viewer.post_frames(message)
        self._viewers.add(viewer)
        self._woken.set()
        if self._ticking is None:
            self._ticking = asyncio.create_task(self._run())

    def leave(self, viewer: Viewer) -> None:
        """Let a viewer go; the last one stops the ticker."""
        self._viewers.discard(viewer)
        if not self._viewers and self._ticking:
            self._ticking.cancel()
            self._ticking = None

    def dismiss(self) -> None:
        """Close everybody: the session is no more."""
        for viewer in self._viewers:
            viewer.end()

    def announce(self, message: BaseModel) -> None:
        """Post a control message to everybody."""
        if self._viewers:
            self._post([message.model_dump_json()])

    def restart(self, frames: EncodedFrames | None = None, notes: NoteMessages | None = None) -> None:
        """Begin the clock's new epoch: tell its transport, drop what waits, send from the present on.

        Args:
            frames: Where the bytes come from now on; the same as before when None.
            notes: What is told of notes now on; the same as before when None.
        """
        self._frames = frames or self._frames
        now = self._now()
        if notes is not None:
            self._notes = notes
        self._begin(self._clock.state(now), Broadcast(self._frames, self._clock.state(now)))
        self._send_due(now)
        self._woken.set()

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
            self._begin(state, Broadcast(self._frames, state, resumed=True))

    def _begin(self, state: ClockState, broadcast: Broadcast) -> None:
        self._state = state
        self._broadcast = broadcast
        for viewer in self._viewers:
            viewer.drop_frames()
        self.announce(transport_message(state))
        self._post(self._notes.begin(state))

    def _send_due(self, now: float) -> None:
        messages = self._broadcast.until(now, {viewer.frames_per_message for viewer in self._viewers})
        for viewer in self._viewers:
            for message in messages[viewer.frames_per_message]:
                viewer.post_frames(message)

    def _post(self, texts: Iterable[str]) -> None:
        for text in texts:
            for viewer in self._viewers:
                viewer.post_text(text)

    async def _run(self) -> None:
        deadline = self._now()
        while True:
            self._woken.clear()
            if not self.tick(self._now()):
                await self._woken.wait()
                deadline = self._now()
                continue
            await asyncio.sleep(0)  # the viewers' outboxes first
            self._broadcast.prepare()
            if self._now() >= deadline:
                # After a long stall count on from now instead of hurrying through what was missed.
                deadline = max(deadline + TICK_S, self._now() - LATEST_S)
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(max(0.0, deadline - self._now())):
                    await self._woken.wait()
