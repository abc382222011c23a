"""Keeps the sessions that a server has loaded as the other servers have them."""

from __future__ import annotations

import asyncio
import logging
from typing import TYPE_CHECKING

from reina.errors import InputError
from reina.sessions.bus.notices import (
    ClockSet,
    SearchProgress,
    SessionChanged,
    SessionEnded,
)
from reina.sessions.session_edits import SessionEndedError
from reina.sessions.storage.errors import ChangedElsewhereError

if TYPE_CHECKING:
    from collections.abc import Coroutine

    from reina.sessions.bus.bus import Bus
    from reina.sessions.bus.notices import Notice, SharedClock
    from reina.sessions.loaded_sessions import LoadedSessions
    from reina.sessions.session import Session
    from reina.sessions.session_edits import SessionEdits
    from reina.sessions.storage.session_storage import SessionStorage

SEARCH_S = 120.0
"""A search of which nothing was heard for so long has ended with its server; another begins it anew."""

ASKING_S = 2.0
"""What has not answered by then is away: whoever asks for a session that is loaded waits no longer for it."""
AWAY_S = 2.0
"""So long after that it is not asked again."""

_log = logging.getLogger(__name__)


class Following:
    """Hears what other servers change, tells them what this one does, and asks where neither may be enough.

    Where there is no bus, what is kept is asked alone: whoever asks this server for a session has it as it
    is; those who watch it here see what others change only then.

    Args:
        storage: Keeps the sessions, for all servers.
        loaded: Those that are in memory here.
        edits: Changes them.
        bus: Connects the servers; None: nothing does.
    """

    def __init__(
        self, storage: SessionStorage, loaded: LoadedSessions, edits: SessionEdits, bus: Bus | None
    ) -> None:
        self._storage = storage
        self._loaded = loaded
        self._edits = edits
        self._bus = bus
        self._asking: dict[str, asyncio.Task[None]] = {}
        self._asking_next: dict[str, asyncio.Task[None]] = {}
        self._tasks: set[asyncio.Task[None]] = set()
        self._takeovers: dict[str, asyncio.TimerHandle] = {}
        self._away_until_s = 0.0
        loaded.is_outdated = lambda session: self._begin(self._ask(session))
        edits.changed = self._tell_change
        edits.searching = self._tell_search

    async def start(self) -> None:
        """Listen from now on."""
        if self._bus is not None:
            await self._bus.start(self._hear, self._ask_all)

    async def aclose(self) -> None:
        """Listen no more."""
        for timer in self._takeovers.values():
            timer.cancel()
        for task in list(self._tasks):
            task.cancel()
        if self._tasks:
            await asyncio.wait(self._tasks)
        if self._bus is not None:
            await self._bus.aclose()

    async def check(self) -> None:
        """See that what connects the servers answers.

        Raises:
            BusAwayError: It does not.
        """
        if self._bus is not None:
            await self._bus.check()

    async def begin(self, session_id: str) -> None:
        """Miss nothing that is told of a session from now on."""
        if self._bus is not None:
            await self._bus.follow(session_id)

    def end(self, session_id: str) -> None:
        """Hear no more of a session that did not come to be loaded."""
        if self._bus is not None and self._loaded.find(session_id) is None:
            self._bus.unfollow(session_id)

    async def joined(self, session: Session) -> None:
        """Let a session that has just been loaded have the clock that the others have."""
        shared = await self._clock(session)
        if shared is not None and shared.clock.at_s >= session.record.clock.at_s:
            await session.take_clock(shared)

    async def may_search(self, session: Session) -> bool:
        """Whether this server is the one to look for a session's score in its song."""
        if self._bus is None:
            return True
        try:
            claimed = await self._bus.claim(_search_of(session), SEARCH_S)
        except InputError:
            # Done twice is better than not at all.
            return True
        if not claimed:
            self._await_search(session, 0.0)
        return claimed

    def tell_end(self, session_id: str) -> None:
        """Tell that a session is no more."""
        if self._bus is not None:
            self._bus.tell(session_id, SessionEnded(sender=self._bus.server_id))

    async def up_to_date(self, session: Session) -> None:
        """Let a session be as it is kept, for a request that has come by now.

        Those who come while it is asked share the next time that it is: what is seen then is no older than
        their requests. Where what is asked is away, a session is let be as it is.
        """
        if asyncio.get_running_loop().time() < self._away_until_s:
            return
        asking = self._asking.get(session.id)
        if asking is None:
            await asyncio.shield(self._ask_now(session))
            return
        following = self._asking_next.get(session.id)
        if following is None:
            following = asyncio.create_task(self._ask_after(session, asking))
            self._asking_next[session.id] = following
        await asyncio.shield(following)

    def _ask_now(self, session: Session) -> asyncio.Task[None]:
        asking = asyncio.create_task(self._ask(session))
        self._asking[session.id] = asking

        def forget(done: asyncio.Task[None]) -> None:
            if self._asking.get(session.id) is done:
                del self._asking[session.id]

        asking.add_done_callback(forget)
        return asking

    async def _ask_after(self, session: Session, asking: asyncio.Task[None]) -> None:
        await asyncio.wait([asking])
        # Whoever comes from now on waits for the time after this one.
        self._asking_next.pop(session.id, None)
        await self._ask_now(session)

    async def _ask(self, session: Session) -> None:
        """Ask what is kept of a session and where its clock is, and be so; what does not answer is let be."""
        try:
            async with asyncio.timeout(ASKING_S):
                version, shared = await asyncio.gather(
                    asyncio.to_thread(self._storage.version, session.id), self._clock(session)
                )
        except (InputError, TimeoutError) as error:
            # What is loaded plays on.
            self._away_until_s = asyncio.get_running_loop().time() + AWAY_S
            _log.warning("whether session %s was changed elsewhere is not known: %s", session.id, error)
            return
        try:
            if version is None:
                await self._forget(session)
            elif version != session.version:
                await self._catch_up(session)
            if shared is not None and session in self._loaded:
                await session.take_clock(shared)
        except InputError as error:
            _log.warning("what was changed of session %s elsewhere is not to be had: %s", session.id, error)

    async def _catch_up(self, session: Session) -> None:
        try:
            await self._edits.catch_up(session)
        except SessionEndedError:
            await self._forget(session)
        except ChangedElsewhereError:
            # It goes on being changed: the next notice comes.
            pass

    async def _clock(self, session: Session) -> SharedClock | None:
        if self._bus is None:
            return None
        try:
            return await self._bus.clock(session.id)
        except InputError:
            return None

    async def _forget(self, session: Session) -> None:
        """Let a session go that is not kept any more."""
        if session in self._loaded:
            await self._loaded.discard_songs(self._loaded.forget(session))

    # What is told

    def _tell_change(self, session: Session) -> None:
        if self._bus is not None:
            self._bus.tell(session.id, SessionChanged(sender=self._bus.server_id, version=session.version))

    def _tell_search(self, session: Session) -> None:
        if self._bus is None:
            return
        progress = session.alignment.progress if session.alignment.is_searching else None
        self._bus.tell(session.id, SearchProgress(sender=self._bus.server_id, progress=progress))
        if progress is not None:
            self._begin(self._claim_on(session))

    async def _claim_on(self, session: Session) -> None:
        if self._bus is not None:
            await self._bus.claim(_search_of(session), SEARCH_S)

    # What is heard

    def _hear(self, session_id: str, notice: Notice) -> None:
        session = self._loaded.find(session_id)
        if session is None:
            return
        match notice:
            case ClockSet(shared=shared):
                self._begin(session.take_clock(shared))
            case SessionChanged(version=version):
                if version != session.version:
                    self._begin(self._catch_up(session))
            case SessionEnded():
                self._begin(self._forget(session))
            case SearchProgress(progress=progress):
                if progress is None:
                    self._begin(self._end_search(session))
                else:
                    self._await_search(session, progress)

    def _ask_all(self) -> None:
        """Something may have been missed."""
        for session in self._loaded:
            self._begin(self._ask(session))
            if session.turn and self._bus is not None:
                self._begin(self._tell_clock(session))

    async def _tell_clock(self, session: Session) -> None:
        """Where the bus has lost what it held, the first who notices says where the clock is."""
        if self._bus is not None and await self._bus.clock(session.id) is None:
            await session.share_clock()

    def _await_search(self, session: Session, progress: float) -> None:
        self._await_no_search(session)
        session.alignment.elsewhere = progress
        session.tell_alignment()
        loop = asyncio.get_running_loop()
        self._takeovers[session.id] = loop.call_later(SEARCH_S, self._take_over, session)

    def _await_no_search(self, session: Session) -> None:
        timer = self._takeovers.pop(session.id, None)
        if timer is not None:
            timer.cancel()

    async def _end_search(self, session: Session) -> None:
        """Another server's search has come to its end: what it found is kept by then."""
        self._await_no_search(session)
        await self.up_to_date(session)
        session.alignment.elsewhere = None
        if session in self._loaded:
            session.tell_alignment()

    def _take_over(self, session: Session) -> None:
        self._takeovers.pop(session.id, None)
        session.alignment.elsewhere = None
        if session in self._loaded and session.alignment.alignment is None:
            self._edits.search_alignment(session)

    def _begin(self, work: Coroutine[object, object, None]) -> None:
        task = asyncio.create_task(self._done(work))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _done(self, work: Coroutine[object, object, None]) -> None:
        try:
            await work
        except InputError as error:
            _log.warning("what another server has changed is not to be had: %s", error)


def _search_of(session: Session) -> str:
    return f"search:{session.id}"
