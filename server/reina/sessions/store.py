"""All sessions of a server: a bounded number in memory, all of them in storage."""

from __future__ import annotations

import asyncio
import logging
import time
from typing import TYPE_CHECKING

from reina.errors import InputError
from reina.sessions.following import Following
from reina.sessions.loaded_sessions import LoadedSessions
from reina.sessions.memory_bound import MEMORY_BYTES, MemoryBound
from reina.sessions.recordings import Recordings
from reina.sessions.session_edits import SessionEdits
from reina.sessions.session_reading import SessionReading
from reina.sessions.sightings import Sightings, near_end
from reina.sessions.staging import STAGING_BYTES, Staging
from reina.sessions.storage.errors import SessionDamagedError
from reina.sessions.storage.session_storage import SessionStorage
from reina.sessions.usage import DiskBound
from reina.sessions.workers.reader import Reader
from reina.sound.alignment.aligner_process import Aligner
from reina.sound.recording.decoder import SongDecoder
from reina.system.to_the_end import to_the_end
from reina.system.tokens import hash_token, new_token

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from reina.sessions.bus.bus import Bus
    from reina.sessions.draft import Draft
    from reina.sessions.session import Session
    from reina.sessions.stage import Stage
    from reina.sessions.storage.session_storage import Listed
    from reina.sessions.usage import Usage
    from reina.sound.renderer import SongRenderer

SHARED_GRACE_S = 600.0
"""Where other servers write to the same database, a file that no session has is left for so long."""

LOADED = 32
"""How many sessions are kept in memory; beyond that, the idle ones that were asked for least recently are put
away."""

_log = logging.getLogger(__name__)


class SessionStore:
    """Makes, finds and ends sessions; its parts keep and change them.

    Reading, planning and writing happen on threads and in processes; sessions themselves live on the event
    loop.

    Args:
        storage: Keeps them; or the data directory, in which they are kept by an embedded database.
        stage: Who plays on what.
        renderer: Makes songs for scores that come without.
        now: Server time, seconds; never goes back.
        loaded: How many sessions are kept in memory.
        memory_bytes: How many bytes the sessions in memory may weigh together.
        disk: How much may be kept.
        staging_bytes: How large what is being sent may be together.
        wall: The present, seconds since 1970.
        decoder: Tells what uploaded songs are.
        reader: Reads scores and shows.
        aligner: Finds scores in uploaded songs.
        blocks_origin: Where pages fetch packed blocks, as `Session` has it.
        bus: Connects the servers that serve the same sessions.
    """

    def __init__(
        self,
        storage: SessionStorage | Path,
        stage: Stage,
        renderer: SongRenderer,
        *,
        now: Callable[[], float],
        loaded: int = LOADED,
        memory_bytes: int = MEMORY_BYTES,
        disk: DiskBound | None = None,
        staging_bytes: int = STAGING_BYTES,
        wall: Callable[[], float] = time.time,
        decoder: SongDecoder | None = None,
        reader: Reader | None = None,
        aligner: Aligner | None = None,
        blocks_origin: str = "",
        bus: Bus | None = None,
    ) -> None:
        self.stage = stage
        self.reader = reader or Reader(stage)
        self.decoder = decoder or SongDecoder()
        self.storage = storage if isinstance(storage, SessionStorage) else SessionStorage.open(storage)
        """Everything that is kept of them."""
        self.staging = Staging(self.storage.stage, staging_bytes)
        """What is being sent."""
        self.sightings = Sightings(self.storage, wall=wall)
        """When sessions were seen."""
        self.reading = SessionReading(self.storage, self.reader, self.decoder)
        """Plans what they play."""
        self.loaded = LoadedSessions(
            self.storage,
            renderer,
            MemoryBound(loaded, memory_bytes),
            now=now,
            wall=wall,
            blocks_origin=blocks_origin,
            bus=bus,
        )
        """Those that are in memory."""
        self._aligner = aligner or Aligner()
        self.edits = SessionEdits(self.storage, self.loaded, self.reading, self.reader, self._aligner)
        """Changes them."""
        self._following: Following | None = None
        if bus is not None or self.storage.is_shared:
            self._following = Following(self.storage, self.loaded, self.edits, bus)
        self.recordings = Recordings(self.storage, self.edits, self.decoder, self.staging)
        """The songs that were sent with them."""
        self._wall = wall
        self._disk = disk or DiskBound()
        self._loading: dict[str, asyncio.Task[Session | None]] = {}
        self._collecting: asyncio.Task[None] | None = None

    async def begin(self) -> None:
        """Begin what goes on in the background: what an earlier server left half done is removed."""
        if self._following is not None:
            await self._following.start()
        self._collecting = asyncio.create_task(self._remove_orphans())

    async def check(self) -> None:
        """See that what keeps the sessions answers.

        Raises:
            DatabaseError: It does not.
        """
        await asyncio.to_thread(self.storage.check)

    async def check_bus(self) -> None:
        """See that what connects this server with others answers, if there is anything.

        Raises:
            BusAwayError: It does not.
        """
        if self._following is not None:
            await self._following.check()

    async def create(self, draft: Draft) -> tuple[Session, str]:
        """Make a session.

        Returns:
            The session, and its control token, which is not kept.

        Raises:
            InputError: Score, song or show cannot be used; nothing of the draft is kept then.
        """
        token = new_token()
        await self.require_disk(draft.sender, self.staging.room.size(draft.folder))
        read = await self.reading.draft(draft)

        async def make() -> Session:
            await self.loaded.clocks_written()
            with self.loaded.room_for(read.weight):
                made = await asyncio.to_thread(self.reading.keep, read, hash_token(token))
            return self.loaded.admit(made)

        session = await to_the_end(make())
        if self._following is not None:
            await self._following.begin(session.id)
        if read.alignment is None:
            self.edits.search_alignment(session)
        return session, token

    async def get(self, session_id: str) -> Session | None:
        """A session, loaded if need be; None where there is none.

        Raises:
            SessionDamagedError: It is kept, and cannot be read.
            DatabaseAwayError: What keeps it does not answer.
        """
        session = self.loaded.ask(session_id)
        if session is None:
            # Those who ask at the same time share one loading.
            loading = self._loading.get(session_id)
            if loading is None:
                loading = asyncio.create_task(self._load(session_id))
                self._loading[session_id] = loading
                loading.add_done_callback(lambda _: self._loading.pop(session_id, None))
            if await asyncio.shield(loading) is None:
                return None
            # It may have been ended or unloaded again before it was this one's turn.
            return await self.get(session_id)
        if self._following is not None:
            with session.asked():
                await self._following.up_to_date(session)
            return self.loaded.find(session_id)
        return session

    async def listed(
        self, limit: int, after: str | None = None, *, owner: str | None = None
    ) -> tuple[list[Listed], str | None]:
        """Some of the sessions that are listed, or of a person's, newest first; see `SessionStorage.page`."""
        return await asyncio.to_thread(self.storage.page, limit, after, owner=owner)

    async def delete(self, session: Session) -> None:
        """End a session and remove everything of it.

        The song that was rendered for it goes too, unless a session that is loaded has the same; one that is
        not will have it rendered anew.
        """
        async with self.edits.held(session):

            async def remove() -> set[Path]:
                await asyncio.to_thread(self.storage.remove, session.id)
                if self._following is not None:
                    self._following.tell_end(session.id)
                return self.loaded.forget(session)

            songs = await to_the_end(remove())
        if session.record.song is None and session.song.path is not None:
            songs.add(session.song.path)
        await self.loaded.discard_songs(songs)

    async def delete_damaged(self, damaged: SessionDamagedError) -> None:
        """End a session that cannot be read, and remove everything of it."""
        await to_the_end(asyncio.to_thread(self.storage.remove, damaged.session_id))

    async def ends_at(self, session: Session, after_s: float) -> str | None:
        """When a session will be ended that nobody sees, if that is near: ISO 8601, UTC.

        Args:
            session: Which.
            after_s: How long after it was seen last sessions are ended; 0 for never.
        """
        if not after_s or len(session.audience):
            return None
        ends_s = await self.sightings.ends_s(session.id, after_s)
        return None if ends_s is None else near_end(ends_s, self._wall(), after_s)

    async def end_unseen(self, after_s: float) -> int:
        """End the sessions that nobody has seen for so long, seconds; returns how many."""
        await self.sightings.keep(self.loaded.watched)
        ended, since_s = 0, self._wall() - after_s
        for session_id in await asyncio.to_thread(self.storage.unseen_since, since_s):
            loaded = self.loaded.find(session_id)
            if loaded is None and session_id not in self._loading:
                await to_the_end(asyncio.to_thread(self.storage.remove, session_id))
            elif loaded is not None and loaded.is_idle:
                await self.delete(loaded)
            else:
                continue
            ended += 1
        return ended

    async def usage(self, sender: str | None) -> Usage:
        """How many sessions came from a sender, or from all (None), and how large they are."""
        return await asyncio.to_thread(self.storage.usage, sender)

    async def require_disk(self, sender: str, adding: int = 0) -> None:
        """See that another session of a sender may be kept; what the sender is sending counts too.

        Raises:
            LimitError: It may not.
        """
        sending = self.staging.room.of(sender) if sender else 0
        await asyncio.to_thread(self._disk.require, self.storage.usage, sender, max(adding, sending))

    async def aclose(self) -> None:
        """Put every session away."""
        if self._collecting is not None:
            self._collecting.cancel()
            await asyncio.wait([self._collecting])
        try:
            await self.sightings.keep(self.loaded.watched)
        except InputError as error:
            _log.warning("when sessions were seen is not kept: %s", error)
        await self.loaded.aclose()
        if self._following is not None:
            await self._following.aclose()
        await self._aligner.aclose()
        await self.reader.aclose()
        await asyncio.to_thread(self.storage.close)

    async def _load(self, session_id: str) -> Session | None:
        if self._following is None:
            return await self._load_kept(session_id)
        await self._following.begin(session_id)
        try:
            session = await self._load_kept(session_id)
            if session is not None:
                await self._following.joined(session)
            return session
        finally:
            self._following.end(session_id)

    async def _load_kept(self, session_id: str) -> Session | None:
        await self.loaded.put_away(session_id)
        try:
            read = await self.reading.kept(session_id)
        except SessionDamagedError:
            if await asyncio.to_thread(self.storage.__contains__, session_id):
                raise
            # Nothing is damaged: it was ended meanwhile.
            return None
        await self.loaded.clocks_written()
        # Ended while it was read: it must not come back.
        if read is None or not await asyncio.to_thread(self.storage.__contains__, session_id):
            return None
        session = self.loaded.admit(read)
        # It was still being looked for when the server ended; or another is at it.
        wanted = read.alignment is None and read.record.song is not None
        if wanted and (self._following is None or await self._following.may_search(session)):
            self.edits.search_alignment(session)
        return session

    async def _remove_orphans(self) -> None:
        try:
            orphans = await asyncio.to_thread(self.storage.orphans)
            if orphans and self.storage.is_shared:
                # Another server may be about to name them.
                await asyncio.sleep(SHARED_GRACE_S)
            removed = await asyncio.to_thread(self.storage.remove_files, orphans)
        except InputError as error:
            _log.warning("files that no session has are not looked for: %s", error)
            return
        if removed:
            _log.info("removed %d files that no session has", removed)
