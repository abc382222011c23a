"""A session: a score, its player, its show, its clock, its song and its audience."""

from __future__ import annotations

import asyncio
import time
import weakref
from contextlib import contextmanager
from typing import TYPE_CHECKING

import numpy as np

from reina.music import ClockError, ClockState, MusicClock, ScoreWarning, findings_of
from reina.performance import TAIL_S
from reina.protocol import resources
from reina.protocol.links import blocks_href, rendering_href, session_links, stream_links
from reina.protocol.messages import (
    AlignmentChanged,
    BlocksChanged,
    FrameBlocks,
    Hello,
    ScoreChanged,
    ShowChanged,
    SongReady,
    StreamError,
)
from reina.protocol.transport import Pause, Play, Seek, SetLoop, SetRate, TransportState
from reina.sessions.audience import Audience
from reina.sessions.description import (
    cast_summary,
    found,
    lead_fields,
    part_choices,
    part_summaries,
    stances_of,
    transport_state,
    warned,
    wire_note,
)
from reina.sessions.frames import EncodedFrames
from reina.sessions.frames_revision import frames_revision
from reina.sessions.heard_songs import HeardSongs
from reina.sessions.kept_clock import KeptClock
from reina.sessions.note_messages import NoteMessages
from reina.sessions.packed_blocks import PackedBlocks
from reina.sessions.show_fit import show_warnings
from reina.sessions.show_revision import changed_paths
from reina.sessions.song import Song, song_state
from reina.sessions.song_alignment import SongAlignment
from reina.sound.hearing import AS_WRITTEN

if TYPE_CHECKING:
    from collections.abc import Callable, Generator

    from reina.protocol.messages import SongState
    from reina.protocol.transport import TransportCommand
    from reina.sessions.bus.bus import Bus
    from reina.sessions.bus.notices import SharedClock
    from reina.sessions.packed_blocks import Form
    from reina.sessions.production import Production
    from reina.sessions.record import SessionRecord
    from reina.sessions.show_revision import ShowRevision
    from reina.sessions.song import RenderedSong
    from reina.sessions.viewer import Viewer
    from reina.sound.alignment.alignment import Alignment
    from reina.sound.hearing import Hearing

OWN_ORIGIN = "self"
"""Packed blocks are fetched from where the session is."""
AHEAD_S = 0.5
"""By so much another server's calendar may be ahead of this one's."""
FIRST_S = 0.3
"""Seconds of frames that are evaluated before a change: what is sent at once, and a margin."""


class Session:
    """One session that is loaded.

    Every change is made within one turn of the event loop and begins a new epoch at once. What takes time,
    such as planning another part or show, or evaluating the frames that come first, is done before, on a
    thread.

    Args:
        record: What is kept of it.
        production: What it plays.
        show_revision: The show that it plays, with its history.
        notes: `note_messages` of the production.
        song: Makes its sound; called when the rest is ready, and whenever the sound is another.
        heard: Makes what somebody wants to hear instead of a song that is made from the score.
        now: Server time, seconds; never goes back.
        wall: The present, seconds since 1970.
        alignment: What is known of where the score is heard in the song.
        clock_changed: Called whenever the clock has been changed.
        blocks_origin: Where packed blocks are to be fetched from, ``https://blocks.example.org``, or
            `OWN_ORIGIN` for where the session is; empty: the stream has them.
        version: How often what is kept of it was changed.
        bus: Where the clock is agreed upon with the other servers that have it; None: there are none.
    """

    def __init__(
        self,
        record: SessionRecord,
        production: Production,
        show_revision: ShowRevision,
        notes: NoteMessages,
        song: Callable[[Session], Song],
        heard: Callable[[Session, Hearing], RenderedSong],
        *,
        now: Callable[[], float],
        wall: Callable[[], float] = time.time,
        alignment: Alignment | None = None,
        clock_changed: Callable[[Session], None] = lambda _: None,
        blocks_origin: str = "",
        version: int = 0,
        bus: Bus | None = None,
    ) -> None:
        self.record = record
        self.version = version
        """Which state of what is kept this is."""
        self.turn = 0
        """How often its clock was changed, as all servers count it."""
        self._bus = bus
        self._now = now
        self._blocks_origin = blocks_origin
        self._wall = wall
        self._clock_changed = clock_changed
        self._asking = 0
        self.alignment = SongAlignment(alignment, is_heard=record.song is None or record.song.is_heard)
        self.production = production
        self.show_revision = show_revision
        self.editing = asyncio.Lock()
        """Held while an edit is planned, so that edits do not overtake one another."""
        self._controlling = asyncio.Lock()
        self.clock = MusicClock(now, self._duration_s())
        if record.clock != KeptClock():
            self.clock.resume(record.clock.state(now(), wall()))
        self._kept_epoch = self.clock.epoch
        blocks = self._blocks_of(production, record, show_revision)
        self.audience = Audience(blocks, self.clock, notes, now=now, pushes_blocks=not blocks_origin)
        self._make_song = song
        self.song = song(self)
        # A session that held itself would only be let go of by the collector, which hardly ever runs.
        itself: Session = weakref.proxy(self)
        self.heard = HeardSongs(lambda hearing: heard(itself, hearing))

    @property
    def id(self) -> str:
        """128 random bits."""
        return self.record.id

    @property
    def is_idle(self) -> bool:
        """Whether it can be unloaded: nobody watches, asks or edits, and no search is on.

        A clock that runs needs nobody to run it: where it is follows from what is kept of it.
        """
        busy = self._asking or self.editing.locked() or self.alignment.is_searching
        return not len(self.audience) and not busy

    @property
    def weight(self) -> int:
        """About how many bytes it takes in memory."""
        return self.production.weight + self.show_revision.weight + self.blocks.frames.weight

    @contextmanager
    def asked(self) -> Generator[None]:
        """While something that was asked of it is answered, it stays loaded."""
        self._asking += 1
        try:
            yield
        finally:
            self._asking -= 1

    def kept(self) -> SessionRecord:
        """The record with the clock as it is now, where it was changed since it was kept."""
        if self._kept_epoch == self.clock.epoch:
            return self.record
        return self.record.model_copy(update={"clock": self._kept_clock()})

    def is_kept(self, record: SessionRecord) -> None:
        """A record that `kept` gave has been written."""
        self.record = record
        self._kept_epoch = record.clock.epoch

    def _kept_clock(self) -> KeptClock:
        return KeptClock.of(self.clock.state(), self._wall())

    def close(self) -> None:
        """End what is under way: viewers and the rendering of the song."""
        self.audience.dismiss()
        self.alignment.close()
        self.song.close()
        self.heard.close()

    # What is said of it

    def song_state(self, hearing: Hearing = AS_WRITTEN) -> SongState:
        """The song, ready or on its way.

        Args:
            hearing: What of it is to be heard; anything but all of it as it is only of a rendered one.
        """
        production = self.production
        if self.record.song is not None:
            href = session_links(self.id).song
        else:
            played = ((one.parts, one.transposition) for one in production.sounding)
            href = rendering_href(self.id, production.score.sequence, played)
        song = self.song
        if not hearing.is_whole:
            song = self.heard.song(hearing)
            href = f"{href}&stem={hearing.stem}&player={hearing.player}&semitones={hearing.transposition}"
        return song_state(song, href, f"{session_links(self.id).song}/segments")

    @property
    def blocks(self) -> PackedBlocks:
        """Its frames, packed."""
        return self.audience.blocks

    def frame_blocks(self, blocks: PackedBlocks | None = None) -> FrameBlocks:
        """Where its packed blocks are to be had; those that are sent now when None."""
        revision = (blocks or self.blocks).revision
        origin = "" if self._blocks_origin == OWN_ORIGIN else self._blocks_origin
        href = f"{origin}{blocks_href(self.id, revision)}"
        return FrameBlocks(revision=revision, href=href, pushed=not self._blocks_origin)

    def hello(self, state: ClockState | None = None, blocks: PackedBlocks | None = None) -> Hello:
        """What a viewer hears first.

        Args:
            state: The clock; as it is now when None.
            blocks: The frames that will be sent; those that are sent now when None.
        """
        manifest = self.production.manifest
        return Hello(
            **dict(manifest),
            session=self.id,
            title=self.record.title,
            duration_s=self.clock.duration_s,
            links=stream_links(self.id, {skeleton.rig for skeleton in manifest.skeletons}),
            blocks=self.frame_blocks(blocks),
            song=self.song_state(),
            alignment=self.alignment.state(),
            transport=transport_state(state or self.clock.state()),
        )

    def resource(self) -> resources.Session:
        """What the HTTP interface says of it."""
        score, lead = self.production.score, self.production.cast.lead
        song = self.record.song.warnings if self.record.song else ()
        of_song = [ScoreWarning(warning.kind, warning.place, warning.message) for warning in song]
        of_show = show_warnings(self.production, self.clock.duration_s)
        return resources.Session(
            id=self.id,
            title=self.record.title,
            public=self.record.public,
            created_at=self.record.created_at,
            duration_s=self.clock.duration_s,
            **lead_fields(self.production),
            instrument=lead.instrument,
            player=lead.player,
            players=list(self.production.stage.players(lead.instrument)),
            sounding_transposition=self.production.played.transposition,
            sequence=score.sequence,
            sequences=score.sequences,
            parts=part_summaries(score),
            choices=part_choices(self.production.rankings[0]),
            cast=cast_summary(self.production),
            notes=len(score.notes),
            warnings=[*warned(self.production.warnings), *song, *warned(of_show)],
            findings=found([*self.production.findings, *findings_of(of_song), *findings_of(of_show)]),
            song=self.song_state(),
            alignment=self.alignment.state(),
            stances=stances_of(self.record),
            links=session_links(self.id),
        )

    def show_warnings(self) -> list[resources.Warned]:
        """What of its show has no effect in this piece."""
        return warned(show_warnings(self.production, self.clock.duration_s))

    def transport(self) -> TransportState:
        """The clock as it is now."""
        return transport_state(self.clock.state())

    # Its audience

    async def ready(
        self,
        song_time_s: float | None = None,
        blocks: PackedBlocks | None = None,
        *,
        rate: float | None = None,
        form: Form | None = None,
    ) -> None:
        """Have the frames evaluated on a thread that are sent first when somebody joins or something changes.

        Args:
            song_time_s: From there on; from the present on when None.
            blocks: The frames that will be sent; those that are sent now when None.
            rate: How fast it will play; as fast as now when None.
            form: Also packed so, beside the forms that others are sent.
        """
        first_s = self.audience.song_time_s() if song_time_s is None else song_time_s
        ahead_s = FIRST_S * (rate or self.clock.state().rate)
        forms = self.audience.forms
        if form is not None:
            forms.add(form)
        await (blocks or self.blocks).ready(first_s, first_s + ahead_s, forms)

    def join(self, viewer: Viewer) -> None:
        """Let somebody watch."""
        self.audience.join(viewer, lambda state: self.hello(state).model_dump_json())

    def take_lead(self, viewer: Viewer, lead_s: float) -> None:
        """Send somebody's frames so long before they are due, seconds."""
        self.audience.take_lead(viewer, lead_s)

    def leave(self, viewer: Viewer) -> None:
        """Let somebody go."""
        self.audience.leave(viewer)

    # What changes it

    async def follow(self, command: TransportCommand) -> TransportState:
        """`control`, once the frames that it leads to are there; commands are followed in their order.

        Raises:
            ClockError: The command does not fit the song.
            BusAwayError: The other servers that have the session could not be told; nothing is changed then.
        """
        async with self._controlling:
            if len(self.audience):
                match command:
                    case Seek(song_time_s=song_time_s):
                        await self.ready(min(song_time_s, self.clock.duration_s))
                    case SetLoop(start_s=float(start_s)):
                        await self.ready(min(max(start_s, 0.0), self.clock.duration_s))
                        await self.ready()
                    case SetRate(rate=rate):
                        await self.ready(rate=rate)
                    case _:
                        await self.ready()
            if self._bus is None:
                return self.control(command)
            return await self._agree(self._bus, command)

    async def take_clock(self, shared: SharedClock) -> None:
        """Be where another server has put the clock, once the frames are there; old news is passed over."""
        async with self._controlling:
            if shared.turn <= self.turn:
                return
            if len(self.audience):
                await self.ready(self._there(shared).at(self._now()).song_time_s, rate=shared.clock.rate)
            self._take(shared)

    async def share_clock(self) -> None:
        """Have the other servers put their clocks where this one is, whatever they have been told before."""
        if self._bus is None:
            return
        async with self._controlling:
            while True:
                other = await self._bus.set_clock(self.id, self._kept_clock(), self.turn)
                if other is None:
                    self.turn += 1
                    return
                self.turn = other.turn

    async def _agree(self, bus: Bus, command: TransportCommand) -> TransportState:
        """`control` on all servers: where another was first, the command goes on from there."""
        while True:
            trial = self.clock.fork()
            state = _follow(trial, command)
            now = self._now()
            clock = KeptClock.of(state.at(now), self._wall())
            other = await bus.set_clock(self.id, clock, self.turn)
            if other is not None:
                self._take(other)
                continue
            self.turn += 1
            self.clock.adopt(state)
            self._clock_is_set()
            return self.transport()

    def _there(self, shared: SharedClock) -> ClockState:
        return shared.clock.state(self._now(), self._wall(), ahead_s=AHEAD_S)

    def _take(self, shared: SharedClock) -> None:
        self.turn = shared.turn
        self.clock.adopt(self._there(shared))
        self.audience.restart()

    def _clock_is_set(self) -> None:
        self.audience.restart()
        self._clock_changed(self)

    def control(self, command: TransportCommand) -> TransportState:
        """Play, pause, seek, change rate or loop.

        Raises:
            ClockError: The command does not fit the song.
        """
        _follow(self.clock, command)
        self._clock_is_set()
        return self.transport()

    async def change_show(self, production: Production, show_revision: ShowRevision) -> None:
        """Play the same with another show.

        Args:
            production: The same but for the show.
            show_revision: The other show, with its history.
        """
        paths = await asyncio.to_thread(changed_paths, self.show_revision.show, show_revision.show)
        blocks = self._blocks_of(production, self.record, show_revision)
        await self._prepare(blocks)
        path = paths[0] if paths is not None and len(paths) == 1 else None
        self.show_revision = show_revision
        self._replace(production, blocks)
        self.audience.announce(ShowChanged(path=path, paths=paths, **dict(show_revision.state)))

    async def change_cast(
        self, record: SessionRecord, production: Production, *, follows: bool = False
    ) -> None:
        """Let others play, or other parts, or the same elsewhere; a song that was rendered is made anew.

        Another sequence is another piece: it begins at its beginning. Of other players `hello` tells again
        what the frames hold.

        Args:
            record: What is kept of it then.
            production: What is played.
            follows: Whether another server has made the change, which puts the clock there too.
        """
        another_piece = production.score.sequence != self.production.score.sequence
        notes = await asyncio.to_thread(note_messages, production)
        blocks = self._blocks_of(production, record, self.show_revision)
        await self._prepare(blocks, 0.0 if another_piece else None)
        another_layout = production.manifest != self.production.manifest
        another_sound = another_piece or production.cast.sound != self.production.cast.sound
        self.record = record
        self.production = production
        if another_piece and not follows:
            self.clock.set_loop(None)
            self.clock.seek(0.0)
        if self.clock.duration_s != self._duration_s():
            self.clock.set_duration(self._duration_s())
        if another_layout:
            self.audience.announce(self.hello(blocks=blocks))
        self._replace(production, blocks, notes)
        if record.song is None and another_sound:
            self.renew_song()
        if another_piece and not follows:
            await self.share_clock()
        self.audience.announce(
            ScoreChanged(
                sequence=production.score.sequence,
                **lead_fields(production),
                duration_s=self.clock.duration_s,
                song=self.song_state(),
            )
        )

    async def change_alignment(
        self, production: Production, show_revision: ShowRevision, alignment: Alignment | None
    ) -> None:
        """Play the same where it is heard in the song.

        Args:
            production: The same in another time.
            show_revision: The show that it plays: another where the show goes with the time of the music.
            alignment: Where the score is heard.
        """
        self.alignment.alignment = alignment
        if show_revision is not self.show_revision:
            await self.change_show(production, show_revision)
        await self.change_cast(self.record, production)
        self.tell_alignment()

    def tell_alignment(self) -> None:
        """Tell the audience how far score and song are in time with one another."""
        self.audience.announce(AlignmentChanged(**dict(self.alignment.state())))

    def renew_song(self) -> None:
        """Make the sound anew, for what is played now."""
        self.song.close()
        self.heard.close()
        self.song = self._make_song(self)

    def tell_song(self) -> None:
        """Tell the audience that the song is ready, or will not be."""
        state = self.song_state()
        if state.status == "ready":
            self.audience.announce(SongReady(song=state))
        elif self.song.error is not None:
            self.audience.announce(StreamError(title="There is no sound", detail=self.song.error))

    def _blocks_of(
        self, production: Production, record: SessionRecord, show_revision: ShowRevision
    ) -> PackedBlocks:
        frames = EncodedFrames(production.performance, production.manifest)
        revision = frames_revision(production.stage, record, show_revision, self.alignment.alignment)
        return PackedBlocks(frames, production.performance.layout, revision)

    async def _prepare(self, blocks: PackedBlocks, song_time_s: float | None = None) -> None:
        if len(self.audience):
            await self.ready(song_time_s, blocks)

    def _replace(
        self, production: Production, blocks: PackedBlocks, notes: NoteMessages | None = None
    ) -> None:
        self.production = production
        self.clock.touch()
        if blocks.revision != self.blocks.revision:
            self.audience.announce(BlocksChanged(**dict(self.frame_blocks(blocks))))
        self.audience.restart(blocks, notes)
        self._clock_changed(self)

    def _duration_s(self) -> float:
        uploaded = self.record.song.duration_s if self.record.song else None
        return max(self.production.score.duration_s + TAIL_S, uploaded or 0.0)


def _follow(clock: MusicClock, command: TransportCommand) -> ClockState:
    """Play, pause, seek, change rate or loop; returns the state.

    Raises:
        ClockError: The command does not fit the song.
    """
    match command:
        case Play(count_in_s=count_in_s):
            return clock.play(count_in_s)
        case Pause():
            return clock.pause()
        case Seek(song_time_s=song_time_s):
            return clock.seek(song_time_s)
        case SetRate(rate=rate):
            return clock.set_rate(rate)
        case SetLoop(start_s=start_s, end_s=end_s, count_in_s=count_in_s):
            if (start_s is None) != (end_s is None):
                raise ClockError("a loop has a start and an end; null both to end it", location="loop")
            return clock.set_loop(start_s, end_s, count_in_s)


def note_messages(production: Production) -> NoteMessages:
    """What is told of the played notes; of a long score this takes a while."""
    lines = [performer.played.line for performer in production.performers]
    columns = [(line.onset_s, line.end_s, line.sounding_pitch, line.note_index) for line in lines]
    onset_s, end_s, pitch, index = columns[0]
    if len(lines) > 1:
        order = np.argsort(np.concatenate([line.onset_s for line in lines]), kind="stable")
        onset_s, end_s, pitch, index = (
            np.concatenate(column)[order] for column in zip(*columns, strict=True)
        )
    table = production.note_table
    return NoteMessages(onset_s, end_s, pitch, lambda number: wire_note(table.note(int(index[number]))))
