"""Everybody who watches a session, and the loop that keeps them in frames."""

from __future__ import annotations

import asyncio
import logging
import math
from typing import TYPE_CHECKING

from reina.performance import BLOCK_FRAMES
from reina.protocol.messages import StreamError
from reina.protocol.websocket import binary_frame, text_frame
from reina.sessions.block_broadcast import BlockBroadcast
from reina.sessions.broadcast import Broadcast
from reina.sessions.description import transport_message
from reina.sessions.ticker import TICKER
from reina.sessions.viewer import GOING_AWAY, INTERNAL_ERROR, count_sent
from reina.system.metrics import tally

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from pydantic import BaseModel

    from reina.music import ClockState, MusicClock
    from reina.sessions.frames import EncodedFrames
    from reina.sessions.note_messages import NoteMessages
    from reina.sessions.packed_blocks import Form, PackedBlocks
    from reina.sessions.ticker import Deadline, Ticker
    from reina.sessions.viewer import Viewer

AHEAD_S = 0.5
"""How long before they are sent frames are evaluated."""
LOOKING_S = 0.1
"""How often it is looked which blocks of frames are needed soon."""
SOON_S = 0.001
"""What is due by the clock and still not passed is looked at again after so long."""

_log = logging.getLogger(__name__)


class Audience:
    """The viewers of one session.

    What is due is evaluated, encoded and framed once, then posted to each viewer. `tick` does one turn and
    takes the time from outside; `_turn` is what the process's ticker calls at the times of the schedule, so
    that no turn's delay adds up. It never waits: what is not evaluated or packed yet is made on a thread, and
    the next turn comes when it is.

    Args:
        blocks: The session's frames, as they are and packed.
        clock: The session's music clock.
        notes: Tells of notes as the music passes them.
        now: Server time, seconds; the clock's own.
        pushes_blocks: Whether packed blocks are sent; else whoever watches by them fetches them.
        ticker: What calls it when something is due; the process's when None.
    """

    def __init__(
        self,
        blocks: PackedBlocks,
        clock: MusicClock,
        notes: NoteMessages,
        *,
        now: Callable[[], float],
        pushes_blocks: bool = True,
        ticker: Ticker | None = None,
    ) -> None:
        self._ticker = TICKER if ticker is None else ticker
        self._pushes_blocks = pushes_blocks
        self.blocks = blocks
        """What is sent."""
        self._clock = clock
        self._notes = notes
        self._now = now
        self._viewers: set[Viewer] = set()
        self._state = clock.state()
        self._ends_s = _end_of(self._state)
        self._resumed = False
        self._broadcasts: dict[float, Broadcast] = {}
        self._block_broadcasts: dict[Form, BlockBroadcast] = {}
        self._groups: list[tuple[Broadcast, dict[int, list[Viewer]]]] | None = None
        self._block_groups: list[tuple[BlockBroadcast, list[Viewer]]] | None = None
        self._deadline: Deadline | None = None
        self._making: asyncio.Future[object] | None = None
        """What is evaluated or packed for the next turn."""
        self._known: frozenset[int] = frozenset()
        """The blocks of frames that are needed by `_known_until_s`."""
        self._known_until_s = -math.inf
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
            self._post_notes(self._notes.advance(now))
        else:
            # What went by while nobody watched is not made up for.
            self._notes.begin(state)
        sounding = self._notes.sounding() if viewer.hears_notes else ()
        for text in (hello(state), *sounding):
            viewer.post_text(text_frame(text))
        self._catch_up(viewer, state)
        self._viewers.add(viewer)
        self._regroup()
        self._wake()

    def take_lead(self, viewer: Viewer, lead_s: float) -> None:
        """Send to a viewer so long before it is due, seconds; a few frames may be sent again."""
        now = self._now()
        self._settle(now)
        viewer.take_lead(lead_s)
        if viewer in self._viewers:
            self._catch_up(viewer, self._clock.state(now))
            self._regroup()
            self._wake()

    def leave(self, viewer: Viewer) -> None:
        """Let a viewer go; after the last one nothing is due any more."""
        self._viewers.discard(viewer)
        self._regroup()
        if not self._viewers:
            self.blocks.forget()
            # Who comes next begins at the present, not where the last one left off.
            self._broadcasts, self._block_broadcasts = {}, {}
            self._resumed = True
            self._making = None
            if self._deadline is not None:
                self._deadline.cancel()
                self._deadline = None

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
            self._post_notes(self._notes.advance(now))
            if notes is not None:
                self._post_notes(self._notes.end())
        self._notes = notes or self._notes
        self._begin(self._clock.state(now), resumed=False)
        for broadcast, viewers in self._by_lead():
            self._send(viewers, broadcast.begin(now, viewers.keys()))
        self._send_blocks(now)
        self._wake()

    def song_time_s(self, later_s: float = 0.0) -> float:
        """What will be heard so much later, as the clock runs at present."""
        return float(self._clock.state().song_times_at(self._now() + later_s))

    def tick(self, now: float) -> bool:
        """Send what is due by `now`; returns whether more will be due without the clock being changed."""
        if now >= self._ends_s:
            self._settle(now)
        if now >= self._notes.due_s:
            self._post_notes(self._notes.advance(now))
        self._send_due(now)
        return self._state.playing

    def _settle(self, now: float) -> None:
        """Take note of the music's end, which the clock comes to by itself."""
        state = self._clock.state(now)
        if self._state.playing and not state.playing:
            self._begin(state, resumed=True)

    def _begin(self, state: ClockState, *, resumed: bool) -> None:
        self._state = state
        self._ends_s = _end_of(state)
        self._resumed = resumed
        self._broadcasts, self._block_broadcasts = {}, {}
        self._regroup()
        for viewer in self._viewers:
            viewer.drop_frames()
        self.announce(transport_message(state))
        self._post_notes(self._notes.begin(state))

    def _send_due(self, now: float) -> None:
        for broadcast, viewers in self._by_lead():
            for size, count in broadcast.overdue(now).items():
                tally.frames_late += count * len(viewers.get(size, ()))
            self._send(viewers, broadcast.until(now, viewers.keys()))
        self._send_blocks(now)

    def _send_blocks(self, now: float) -> None:
        for broadcast, viewers in self._by_form():
            tally.frames_late += BLOCK_FRAMES * broadcast.overdue(now) * len(viewers)
            for message in broadcast.until(now):
                _post_frames(viewers, message)

    def _send(self, viewers: dict[int, list[Viewer]], messages: dict[int, list[bytes]]) -> None:
        for size, given in messages.items():
            for message in given:
                _post_frames(viewers[size], message)

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
                _post_frames([viewer], message)
            return
        for message in self._broadcast(viewer.lead_s).catch_up(state, viewer.frames_per_message):
            _post_frames([viewer], message)

    def _regroup(self) -> None:
        """Who is sent what is another from now on."""
        self._groups = self._block_groups = None
        self._known_until_s = -math.inf

    def _by_lead(self) -> list[tuple[Broadcast, dict[int, list[Viewer]]]]:
        """What is sent, with the viewers by their frames in a message; one that is nobody's is dropped."""
        if self._groups is None:
            groups: dict[float, dict[int, list[Viewer]]] = {}
            for viewer in self._viewers:
                if viewer.form is None:
                    sizes = groups.setdefault(viewer.lead_s, {})
                    sizes.setdefault(viewer.frames_per_message, []).append(viewer)
            self._broadcasts = {lead_s: self._broadcast(lead_s) for lead_s in groups}
            self._groups = [(self._broadcasts[lead_s], sizes) for lead_s, sizes in groups.items()]
        return self._groups

    def _by_form(self) -> list[tuple[BlockBroadcast, list[Viewer]]]:
        """What is sent to those who watch by packed blocks, of each form, with them."""
        if self._block_groups is None:
            groups: dict[Form, list[Viewer]] = {}
            for viewer in self._viewers:
                if viewer.form is not None and self._pushes_blocks:
                    groups.setdefault(viewer.form, []).append(viewer)
            known = self._block_broadcasts
            self._block_broadcasts = {
                form: known.get(form) or BlockBroadcast(self.blocks, form, self._state) for form in groups
            }
            self._block_groups = [(self._block_broadcasts[form], viewers) for form, viewers in groups.items()]
        return self._block_groups

    def _broadcast(self, lead_s: float) -> Broadcast:
        broadcast = self._broadcasts.get(lead_s)
        if broadcast is None:
            broadcast = Broadcast(self.frames, self._state, resumed=self._resumed, lead_s=lead_s)
            self._broadcasts[lead_s] = broadcast
        return broadcast

    def _blocks_until(self, now: float) -> list[int]:
        """The blocks of the frames that are due by then, by their numbers."""
        due: set[int] = set()
        for broadcast, viewers in self._by_lead():
            due |= broadcast.frames_until(now, viewers.keys())
        return sorted({frame // BLOCK_FRAMES for frame in due})

    def _post(self, texts: Iterable[str]) -> None:
        for text in texts:
            frame = text_frame(text)
            for viewer in self._viewers:
                viewer.post_text(frame)

    def _post_notes(self, texts: Iterable[str]) -> None:
        for text in texts:
            frame = text_frame(text)
            for viewer in self._viewers:
                if viewer.hears_notes:
                    viewer.post_text(frame)

    # What the ticker calls

    def _wake(self) -> None:
        """Take a turn as soon as may be."""
        self._take_turn_in(0.0)

    def _take_turn_in(self, wait_s: float) -> None:
        if self._deadline is not None:
            self._deadline.cancel()
            self._deadline = None
        if self._viewers:
            self._deadline = self._ticker.at(asyncio.get_running_loop().time() + wait_s, self._turn)

    def _turn(self) -> None:
        self._deadline = None
        try:
            now = self._now()
            missing = self._missing(now)
            if missing:
                # What was not evaluated ahead in time is not evaluated here either: the event loop is
                # everybody's.
                self._make(self.frames.block, missing[0])
                return
            for form, broadcast in self._block_broadcasts.items():
                for number in broadcast.missing(now)[:1]:
                    # One at a time: what is needed first goes out first.
                    self._make(self.blocks.block, number, form)
            if self.tick(now):
                self._take_turn_in(self._next_time(now) - self._now())
        except Exception as error:
            self._fail(error)

    def _next_time(self, now: float) -> float:
        """Server time at which something is due again; the schedule's own, though a turn was late."""
        next_s = max(min(self._notes.due_s, self._ends_s), now + SOON_S)
        for broadcast in self._broadcasts.values():
            time_s = broadcast.next_time()
            if time_s is not None and time_s < next_s:
                next_s = time_s
        for broadcast in self._block_broadcasts.values():
            time_s = broadcast.next_time()
            # A block that is to be packed first has a turn of its own, when it is.
            if time_s is not None and now < time_s < next_s:
                next_s = time_s
        return next_s

    def _missing(self, now: float) -> list[int]:
        """The blocks of the frames that are due and still to be evaluated; one that is due soon is begun."""
        if now >= self._known_until_s:
            self._known_until_s = now + LOOKING_S
            self._known = frozenset(self._blocks_until(self._known_until_s))
            for number in self._blocks_until(self._known_until_s + AHEAD_S):
                if not self.frames.has([number]):
                    self.frames.prefetch(number)
                    break
        if self.frames.has(self._known):
            return []
        return [number for number in self._blocks_until(now) if not self.frames.has([number])]

    def _make(self, make: Callable[..., object], *of: object) -> None:
        """Have something made on the thread, unless something is: there is a turn when it is there."""
        if self._making is None:
            self._making = asyncio.get_running_loop().run_in_executor(self.frames.thread, make, *of)
            self._making.add_done_callback(self._made)

    def _made(self, making: asyncio.Future[object]) -> None:
        error = None if making.cancelled() else making.exception()
        if making is not self._making or making.cancelled():
            return
        self._making = None
        if error is None:
            self._wake()
        else:
            self._fail(error)

    def _fail(self, error: BaseException) -> None:
        """A stream that fails leaves nobody in front of a picture that stands still without a word."""
        _log.error("the stream of a session failed", exc_info=error)
        self.announce(StreamError(title="The stream has failed", detail="the server has noted why"))
        for viewer in self._viewers:
            viewer.end(INTERNAL_ERROR, "the stream has failed")


def _post_frames(viewers: list[Viewer], message: bytes) -> None:
    frame = binary_frame(message)
    sent = 0
    for viewer in viewers:
        if viewer.post_frames(frame):
            sent += 1
    count_sent(frame, viewers[0].frames_per_message, sent)


def _end_of(state: ClockState) -> float:
    """Server time at which the clock comes to the music's end by itself; infinity if never."""
    ends_s = state.server_time_of(state.duration_s) if state.playing else None
    return math.inf if ends_s is None else ends_s
