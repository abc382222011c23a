"""Edits of sessions: each is planned, kept, and shown then; those of one session follow one another."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from contextlib import asynccontextmanager
from dataclasses import replace
from typing import TYPE_CHECKING, Literal, TypeVar

from reina.errors import InputError
from reina.sessions.show_revision import ShowRevision
from reina.sessions.show_text import ShowText
from reina.sessions.sleeping_show import known_tracks, wake
from reina.sessions.storage.errors import ChangedElsewhereError, SessionDamagedError, SessionGoneError
from reina.sessions.storage.session_storage import UNCHANGED, ShowChange
from reina.show import ShowError, ShowHistory
from reina.sound.alignment.document import read_alignment, write_alignment
from reina.system.to_the_end import to_the_end
from reina.system.tokens import hash_token, new_token

if TYPE_CHECKING:
    from collections.abc import AsyncGenerator, Awaitable, Callable, Mapping
    from pathlib import Path

    from reina.instruments import Cast
    from reina.sessions.loaded_sessions import LoadedSessions
    from reina.sessions.production import Production
    from reina.sessions.record import SessionRecord
    from reina.sessions.session import Session
    from reina.sessions.session_reading import SessionReading, Stances
    from reina.sessions.storage.session_storage import SessionStorage
    from reina.sessions.storage.show_rows import KeptShow
    from reina.sessions.workers.reader import Reader
    from reina.show import Show
    from reina.sound.alignment.aligner_process import Aligner
    from reina.sound.alignment.alignment import Alignment

TRIES = 8
"""So often a change is tried anew that another server has come before."""

T = TypeVar("T")
_log = logging.getLogger(__name__)


class SessionEndedError(InputError):
    """A session was to be changed that has been ended meanwhile."""


class SessionEdits:
    """Changes sessions that are loaded.

    Args:
        storage: Keeps them.
        loaded: Those that are in memory.
        reading: Plans what they are to play.
        reader: Reads shows.
        aligner: Finds scores in uploaded songs.
    """

    def __init__(
        self,
        storage: SessionStorage,
        loaded: LoadedSessions,
        reading: SessionReading,
        reader: Reader,
        aligner: Aligner,
    ) -> None:
        self._storage = storage
        self._loaded = loaded
        self._reading = reading
        self._reader = reader
        self._aligner = aligner
        self.changed: Callable[[Session], None] = lambda _: None
        """Called when something of a session was changed, and is kept."""
        self.searching: Callable[[Session], None] = lambda _: None
        """Called when a search begins for a session's score in its song, while it goes on, and at its end."""

    async def renew_token(self, session: Session) -> str:
        """Give a session another control token, in place of the one before; returns it, which is not kept."""
        token = new_token()

        async def renew() -> None:
            async with self.held(session):
                record = session.record.model_copy(update={"token_sha256": hash_token(token)})
                await self.keep(session, record)

        await self.until_kept(session, renew)
        return token

    async def change(
        self,
        session: Session,
        *,
        title: str | None = None,
        public: bool | None = None,
        recast: Callable[[Cast], Cast] | None = None,
        restance: Callable[[Stances], Stances] | None = None,
    ) -> None:
        """Rename a session, list it or not, or change its cast or its own stances; None leaves as it is.

        A title and a show that are still those of another sequence give way to this one's.

        Args:
            session: Which.
            title: What to call it.
            public: Whether the list of sessions shows it.
            recast: The cast as it is -> as it is to be.
            restance: The session's own stances -> those that it is to have. What it raises is raised on.

        Raises:
            InputError: The cast names what there is not; nothing is changed then.
        """
        asked = {"title": title, "public": public}
        changes = {field: value for field, value in asked.items() if value is not None}
        await self.until_kept(session, lambda: self._change(session, changes, recast, restance))

    async def _change(
        self,
        session: Session,
        changes: Mapping[str, str | bool],
        recast: Callable[[Cast], Cast] | None,
        restance: Callable[[Stances], Stances] | None,
    ) -> None:
        async with self.held(session):
            record, before = session.record.model_copy(update=changes), session.show_revision
            wanted = recast(record.cast) if recast else record.cast
            stances = restance(record.stances) if restance else record.stances
            if wanted == record.cast and stances == record.stances:
                # Neither frames nor sound know of it.
                await self.keep(session, record)
                return
            another_piece = wanted.sequence not in {None, session.production.score.sequence}
            # Another piece is heard elsewhere, if at all.
            alignment = None if another_piece else session.alignment.alignment
            production, kept = await self._plan_other(session, wanted, alignment, stances)
            titles = session.production.score.title, production.score.title
            titled = {"title": titles[1]} if "title" not in changes and record.title == titles[0] else {}
            record = record.model_copy(update={"cast": production.cast, "stances": stances, **titled})

            async def show(record: SessionRecord) -> None:
                await session.change_cast(record, production)
                if kept is not before:
                    await session.change_show(production, kept)
                if another_piece:
                    session.alignment.alignment = None
                    self.search_alignment(session)

            heard = None if another_piece else UNCHANGED
            await self.keep(session, record, kept, heard, show=show)

    async def change_alignment(self, session: Session, step: Callable[[Alignment | None], Alignment]) -> None:
        """Say anew where a session's score is heard in its song; edits of a session follow one another.

        Args:
            session: Whose.
            step: What is known -> what is to be known. What it raises is raised on, and nothing is changed.
        """
        await self.until_kept(session, lambda: self._change_alignment(session, step))

    async def _change_alignment(
        self, session: Session, step: Callable[[Alignment | None], Alignment]
    ) -> None:
        async with self.held(session):
            before = session.alignment.alignment
            # As it will be read: this server plays it as any other will.
            alignment = await asyncio.to_thread(lambda: read_alignment(write_alignment(step(before))))
            if alignment == before:
                return
            if (before is None or not before.moves) and not alignment.moves:
                # Nothing is heard elsewhere than before.
                async def tell(_: SessionRecord) -> None:
                    session.alignment.alignment = alignment
                    session.tell_alignment()

                await self.keep(session, session.record, alignment=alignment, show=tell)
                return
            production, kept = await self._plan_other(
                session, session.record.cast, alignment, session.record.stances
            )

            async def show(_: SessionRecord) -> None:
                await session.change_alignment(production, kept, alignment)

            await self.keep(session, session.record, kept, alignment, show=show)

    def search_alignment(self, session: Session) -> bool:
        """Look for a session's score in its song, in the background.

        Returns:
            Whether there is a song to look in that the server can listen to.
        """
        song = session.record.song
        if song is None or not song.is_heard:
            return False

        async def found(alignment: Alignment) -> None:
            def beside_what_people_said(known: Alignment | None) -> Alignment:
                if known is None:
                    return alignment
                return replace(
                    alignment,
                    anchors=known.anchors,
                    offset_s=known.offset_s,
                    follows_key=known.follows_key,
                )

            with contextlib.suppress(SessionEndedError):
                await self.change_alignment(session, beside_what_people_said)

        session.alignment.search(
            self._aligner,
            lambda: self._storage.file(session.record, song.heard or song.file),
            session.production.written_score,
            found=found,
            tell=lambda: self._tell_search(session),
        )
        self.searching(session)
        return True

    def _tell_search(self, session: Session) -> None:
        session.tell_alignment()
        self.searching(session)

    async def until_kept(self, session: Session, change: Callable[[], Awaitable[T]]) -> T:
        """Make a change, and make it anew of what is there then where another server was first.

        Args:
            session: What is changed.
            change: Makes it, from the beginning each time.

        Raises:
            ChangedElsewhereError: Another server was first each time.
        """
        for _ in range(TRIES - 1):
            with contextlib.suppress(ChangedElsewhereError):
                return await change()
            await self.catch_up(session)
        return await change()

    async def catch_up(self, session: Session) -> None:
        """Let a session be as it is kept: another server has changed it.

        Raises:
            SessionEndedError: It is not there any more.
            SessionDamagedError: What is kept cannot be read.
        """
        async with self.held(session):
            kept = await asyncio.to_thread(self._storage.version, session.id)
            if kept == session.version:
                return
            before = session.record
            known = await asyncio.to_thread(known_tracks, session.show_revision.text)
            read = await asyncio.to_thread(self._storage.read, session.id, known)
            if read is None:
                self._loaded.forget(session)
                raise SessionEndedError(f"the session {session.id!r} was ended meanwhile")
            record = read.record
            replanned = (
                record.cast != before.cast
                or record.stances != before.stances
                or record.song != before.song
                or read.alignment != session.alignment.alignment
            )
            if replanned:
                await self._take_all(session)
            else:
                await self._take_show(session, read.show)
                session.record, session.version = record, read.version

    async def _take_all(self, session: Session) -> None:
        """Let a session be as it is kept, all of it; it is held by `held`."""
        read = await self._reading.kept(session.id)
        if read is None:
            self._loaded.forget(session)
            raise SessionEndedError(f"the session {session.id!r} was ended meanwhile")
        self._loaded.make_room(read.weight - session.weight, staying=session)
        session.alignment.is_heard = read.record.song is None or read.record.song.is_heard
        another_alignment = read.alignment != session.alignment.alignment
        session.alignment.alignment = read.alignment
        # The show goes with the players that it is read for: both are there before either is seen.
        await session.change_cast(read.record, read.production, follows=True)
        await session.change_show(read.production, read.revision)
        session.record, session.version = read.record, read.version
        if another_alignment:
            session.tell_alignment()

    async def _take_show(self, session: Session, kept: KeptShow) -> None:
        """Let a session have the show that is kept; it is held by `held`."""
        before = session.show_revision
        read = await self._reader.show(kept.text, session.production.registry, owner=session.id)
        digests = kept.digests
        if digests and read.time != before.text.show.time:
            # Tracks say the unit of their times only where it is not the show's.
            whole = await asyncio.to_thread(self._storage.read, session.id)
            if whole is None:
                return
            kept, digests = whole.show, ()
            read = await self._reader.show(kept.text, session.production.registry, owner=session.id)
        show = await asyncio.to_thread(wake, read, digests, before.text)
        text = await asyncio.to_thread(ShowText.of, show, before.text)
        revision = ShowRevision(
            ShowHistory(show), text, before.revision + 1, kept.weights, kept.earlier, kept.later
        )
        if text.etag == before.text.etag:
            if (revision.done, revision.undone) != (before.done, before.undone):
                session.show_revision = replace(revision, revision=before.revision)
            return
        production = await asyncio.to_thread(session.production.with_show, show)
        self._loaded.make_room(revision.weight - before.weight, staying=session)
        await session.change_show(production, revision)

    async def change_show(self, session: Session, step: Callable[[ShowHistory], ShowHistory]) -> ShowRevision:
        """Take a session's show one step on or back, and keep it; edits of a session follow one another.

        Args:
            session: Whose.
            step: The history as it is -> as it is to be; runs on a thread, and once more where another server
                has changed the show meanwhile. What it raises is raised on, and nothing is changed then.
        """
        return await self.until_kept(session, lambda: self._change_show(session, step))

    async def _change_show(
        self, session: Session, step: Callable[[ShowHistory], ShowHistory]
    ) -> ShowRevision:
        async with self.held(session):
            await self._wake(session)
            kept = await asyncio.to_thread(session.show_revision.then, step)
            if kept is not session.show_revision:
                production = await asyncio.to_thread(session.production.with_show, kept.show)
                self._loaded.make_room(kept.weight - session.show_revision.weight, staying=session)

                async def show(_: SessionRecord) -> None:
                    await session.change_show(production, kept)

                await self.keep(session, session.record, kept, show=show)
        return kept

    @asynccontextmanager
    async def held(self, session: Session) -> AsyncGenerator[None]:
        """Hold a session while it is changed, so that edits neither overtake one another nor outlive it.

        Raises:
            SessionEndedError: It was ended while this waited.
        """
        async with session.editing:
            if session not in self._loaded:
                raise SessionEndedError(f"the session {session.id!r} was ended meanwhile")
            yield

    async def keep(
        self,
        session: Session,
        record: SessionRecord,
        revision: ShowRevision | None = None,
        alignment: Alignment | Literal["unchanged"] | None = UNCHANGED,
        *,
        staged: dict[str, Path] | None = None,
        show: Callable[[SessionRecord], Awaitable[None]] | None = None,
    ) -> None:
        """Keep what a session is to be, then let it be seen: what is refused is seen by nobody.

        Args:
            session: Which; it is held by `held`.
            record: Its record.
            revision: Its show.
            alignment: Where its score is heard.
            staged: Further files.
            show: Lets it be seen; called with the record as it is kept.

        Raises:
            SessionEndedError: It is not there any more.
            ChangedElsewhereError: Another server has changed it; see `until_kept`.
        """
        before = session.show_revision
        change = None if revision is None or revision is before else ShowChange(before, revision)

        def write() -> SessionRecord:
            return self._storage.change(
                record, show=change, alignment=alignment, staged=staged, version=session.version
            )

        async def keep() -> None:
            kept = await asyncio.to_thread(write)
            session.version += 1
            self.changed(session)
            if show is not None:
                await show(kept)
            session.record = kept

        try:
            await to_the_end(keep())
        except SessionGoneError as error:
            self._loaded.forget(session)
            raise SessionEndedError(str(error)) from error

    async def _plan_other(
        self, session: Session, wanted: Cast, alignment: Alignment | None, stances: Stances
    ) -> tuple[Production, ShowRevision]:
        """Plan what is to take the place of what a session plays, and have room for it."""
        production, kept = await self._reading.other(session, wanted, alignment, stances)
        growing = production.weight + kept.weight - session.production.weight - session.show_revision.weight
        self._loaded.make_room(growing, staying=session)
        return production, kept

    async def _wake(self, session: Session) -> None:
        """Have the states at hand that undo and redo lead to; the session is held by `held`."""
        kept = session.show_revision
        if kept.earlier and not kept.history.past:
            earlier = await self._beside(session, -1)
            if earlier is None:
                kept = replace(kept, earlier=0, weights=kept.weights[kept.earlier :])
            else:
                kept = kept.with_earlier(earlier)
        if kept.later and not kept.history.future:
            later = await self._beside(session, 1)
            if later is None:
                kept = replace(kept, later=0, weights=kept.weights[: kept.done])
            else:
                kept = kept.with_later(later)
        session.show_revision = kept

    async def _beside(self, session: Session, steps: int) -> Show | None:
        """The state of a show before or after the present one; None where it cannot be read."""
        text, registry = session.show_revision.text, session.production.registry
        try:
            known = await asyncio.to_thread(known_tracks, text)
            for at_hand in (known, {}):
                data, digests = await asyncio.to_thread(
                    self._storage.state_beside, session.record, steps, at_hand
                )
                read = await self._reader.show(data, registry, owner=session.id)
                # Tracks say the unit of their times only where it is not the show's.
                if read.time == text.show.time or not at_hand:
                    return await asyncio.to_thread(wake, read, digests if at_hand else (), text)
        except (SessionDamagedError, ShowError) as error:
            _log.warning("session %s: what its show was is not to be had any more: %s", session.id, error)
        return None
