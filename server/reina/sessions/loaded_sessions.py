"""The sessions in memory: how they come, make room for one another, and go; the songs that they use."""

from __future__ import annotations

import asyncio
import logging
from collections import OrderedDict
from contextlib import contextmanager
from typing import TYPE_CHECKING

from reina.errors import InputError
from reina.sessions.clock_keeping import ClockKeeping
from reina.sessions.session import Session
from reina.sessions.song import RenderedSong, Song, UploadedSong

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterable, Iterator
    from pathlib import Path

    from reina.sessions.bus.bus import Bus
    from reina.sessions.memory_bound import MemoryBound
    from reina.sessions.record import SessionRecord
    from reina.sessions.session_reading import ReadSession
    from reina.sessions.storage.session_storage import SessionStorage
    from reina.sound.hearing import Hearing
    from reina.sound.renderer import SongRenderer

_log = logging.getLogger(__name__)


class LoadedSessions:
    """A bounded number of sessions, the least recently asked for first.

    Args:
        storage: Keeps where their clocks stand.
        renderer: Makes songs for scores that come without.
        bound: How many there may be, and how large.
        now: Server time, seconds; never goes back.
        wall: The present, seconds since 1970.
        blocks_origin: Where pages fetch packed blocks, as `Session` has it.
        bus: Connects the servers that have the same sessions, as `Session` has it.
    """

    def __init__(
        self,
        storage: SessionStorage,
        renderer: SongRenderer,
        bound: MemoryBound,
        *,
        now: Callable[[], float],
        wall: Callable[[], float],
        blocks_origin: str = "",
        bus: Bus | None = None,
    ) -> None:
        self._bus = bus
        self.is_outdated: Callable[[Session], None] = lambda _: None
        """Called with one that is not as it is kept."""
        self._storage = storage
        self._renderer = renderer
        renderer.cache.in_use = self._listened_to
        self._bound = bound
        self._now = now
        self._wall = wall
        self._blocks_origin = blocks_origin
        self._sessions: OrderedDict[str, Session] = OrderedDict()
        self._coming = 0
        self._clocks = ClockKeeping(self._keep_clock)
        self._putting_away: dict[str, asyncio.Task[None]] = {}
        self._pruning: set[asyncio.Task[None]] = set()

    def __len__(self) -> int:
        return len(self._sessions)

    def __iter__(self) -> Iterator[Session]:
        return iter(list(self._sessions.values()))

    def __contains__(self, session: Session) -> bool:
        return self._sessions.get(session.id) is session

    @property
    def viewers(self) -> int:
        """How many streams are open."""
        return sum(len(session.audience) for session in self)

    @property
    def watched(self) -> list[str]:
        """The ids of those that somebody watches."""
        return [session.id for session in self if len(session.audience)]

    @property
    def weight(self) -> int:
        """About how many bytes they take."""
        return sum(session.weight for session in self)

    def find(self, session_id: str) -> Session | None:
        """The session of that name, if it is in memory."""
        return self._sessions.get(session_id)

    def ask(self, session_id: str) -> Session | None:
        """The same, for somebody who asks for it: it is the last to go then."""
        session = self._sessions.get(session_id)
        if session is not None:
            self._sessions.move_to_end(session_id)
        return session

    # How they come and go

    def admit(self, read: ReadSession) -> Session:
        """Have a session in memory.

        Raises:
            LimitError: There is no room.
        """
        self.make_room(read.weight)
        # Nothing else of what was read stays: the session may come to play something else.
        uploaded = read.song
        session = Session(
            read.record,
            read.production,
            read.revision,
            read.notes,
            lambda session: self._song(session, uploaded),
            self._heard,
            now=self._now,
            wall=self._wall,
            alignment=read.alignment,
            clock_changed=self._clocks.note,
            blocks_origin=self._blocks_origin,
            version=read.version,
            bus=self._bus,
        )
        self._sessions[session.id] = session
        return session

    def make_room(self, adding: int, *, staying: Session | None = None) -> None:
        """Unload what is idle, so that something more fits.

        Args:
            adding: About how many bytes come.
            staying: A session that is not to go, whatever it does.

        Raises:
            LimitError: It does not, with all that is watched.
        """
        loaded = self._sessions.values()
        for session in self._bound.leaving(loaded, adding, coming=self._coming, staying=staying):
            self._unload(session)

    @contextmanager
    def room_for(self, weight: int) -> Generator[None]:
        """Have room for a session that is being made.

        Raises:
            LimitError: There is none.
        """
        self.make_room(weight)
        self._coming += weight
        try:
            yield
        finally:
            self._coming -= weight

    def forget(self, session: Session) -> set[Path]:
        """Let a session go that is not kept any more; returns the songs that were made for its viewers."""
        self._sessions.pop(session.id, None)
        self._unfollow(session)
        songs = session.heard.paths
        session.close()
        return songs

    async def put_away(self, session_id: str) -> None:
        """Wait until a session that is being unloaded is: what was kept of it last is what is read."""
        if session_id in self._putting_away:
            await asyncio.wait([self._putting_away[session_id]])

    async def clocks_written(self) -> None:
        """Wait until no clock is being written: a session whose clock is cannot be unloaded."""
        await self._clocks.written()

    async def aclose(self) -> None:
        """Unload every session, and end what makes their songs."""
        await self._clocks.aclose()
        for session in self:
            self._unload(session)
        await self._renderer.aclose()
        for tasks in (self._pruning, self._putting_away.values()):
            if tasks:
                await asyncio.wait(tasks)

    def _unload(self, session: Session) -> None:
        del self._sessions[session.id]
        self._unfollow(session)
        record = session.kept()
        session.close()
        if record != session.record:
            writing = asyncio.create_task(self._put_away(record, session.version))
            self._putting_away[session.id] = writing
            writing.add_done_callback(lambda _: self._putting_away.pop(session.id, None))

    def _unfollow(self, session: Session) -> None:
        if self._bus is not None:
            self._bus.unfollow(session.id)

    async def _put_away(self, record: SessionRecord, version: int) -> None:
        try:
            # What another server has changed meanwhile it has kept with a clock of its own.
            await asyncio.to_thread(self._storage.keep_clock, record, version)
        except InputError as error:
            _log.warning("session %s: where its clock stood is not kept: %s", record.id, error)

    async def _keep_clock(self, session: Session) -> None:
        async with session.editing:
            if session in self:
                record = session.kept()
                if await asyncio.to_thread(self._storage.keep_clock, record, session.version):
                    session.is_kept(record)
                else:
                    self.is_outdated(session)

    # Their songs

    def songs_in_use(self) -> set[Path]:
        """Files of songs that sessions have open, as everybody and as single viewers hear them."""
        return _songs_of(self)

    async def discard_songs(self, songs: set[Path]) -> None:
        """Remove rendered songs, but for those that sessions have open."""
        for path in songs - self.songs_in_use():
            await asyncio.to_thread(self._renderer.discard, path)

    async def prune_songs(self) -> None:
        """Remove the rendered songs that were not asked for the longest until the rest is small enough."""
        freed = await asyncio.to_thread(self._renderer.prune, in_use=self._listened_to())
        if freed:
            _log.info("removed %.0f MB of rendered songs", freed / 1e6)

    def _song(self, session: Session, uploaded: Path | None) -> Song:
        record, production = session.record, session.production
        if record.song is not None and uploaded is not None:
            return UploadedSong(uploaded, record.song)
        return RenderedSong(
            self._renderer,
            production.score,
            production.sounding,
            owner=record.sender or record.id,
            ready=lambda: self._song_made(session),
        )

    def _heard(self, session: Session, hearing: Hearing) -> RenderedSong:
        production = session.production
        return RenderedSong(
            self._renderer,
            production.score,
            production.sounding,
            hearing=hearing,
            owner=session.record.sender or session.id,
            ready=self._prune_soon,
        )

    def _song_made(self, session: Session) -> None:
        session.tell_song()
        self._prune_soon()

    def _prune_soon(self) -> None:
        pruning = asyncio.create_task(self.prune_songs())
        self._pruning.add(pruning)
        pruning.add_done_callback(self._pruning.discard)

    def _listened_to(self) -> set[Path]:
        """Files of songs of sessions that somebody watches."""
        return _songs_of(session for session in self if len(session.audience))


def _songs_of(sessions: Iterable[Session]) -> set[Path]:
    paths: set[Path] = set()
    for session in sessions:
        paths |= session.heard.paths
        if session.song.path is not None:
            paths.add(session.song.path)
    return paths
