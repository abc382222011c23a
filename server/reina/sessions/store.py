"""All sessions of a server: a bounded number in memory, all of them on disk."""

from __future__ import annotations

import asyncio
import json
from collections import OrderedDict
from dataclasses import dataclass
from typing import TYPE_CHECKING

from reina.music import read_score
from reina.sessions.folders import SCORE, SHOW, SessionFolders, write_atomically
from reina.sessions.production import Production, read_show
from reina.sessions.record import SessionRecord, SongRecord, created_now, hash_token, new_id, new_token
from reina.sessions.session import Session
from reina.sessions.song import RenderedSong, Song, UploadedSong
from reina.sessions.sound import SongRenderer, probe_audio

if TYPE_CHECKING:
    from collections.abc import Callable
    from contextlib import AbstractContextManager
    from pathlib import Path

    from reina.keyframes import Show
    from reina.sessions.production import Stage

LOADED = 32
"""How many sessions are kept in memory; beyond that, the idle ones that were asked for least recently are put
away."""


@dataclass(frozen=True)
class Draft:
    """What a new session is made of.

    Attributes:
        folder: A folder of `SessionStore.staging` that holds the files named here.
        score: Name of the score's file in it.
        score_filename: What the sender calls the score.
        song: Name of the song's file, or None.
        show: Name of the show's file, or None.
        title: What to call the session; the score's own title when None.
        public: Whether the list of sessions shows it.
        part: The part that the player plays; the best when None.
        transposition: Semitones by which it is moved.
    """

    folder: Path
    score: str
    score_filename: str | None = None
    song: str | None = None
    show: str | None = None
    title: str | None = None
    public: bool = False
    part: int | None = None
    transposition: int = 0


class SessionStore:
    """Makes, finds, keeps and ends sessions.

    Reading and planning happen on threads; sessions themselves live on the event loop.

    Args:
        data_dir: Where sessions and rendered songs are kept.
        stage: Who plays on what.
        renderer: Makes songs for scores that come without.
        now: Server time, seconds; never goes back.
        loaded: How many sessions are kept in memory.
    """

    def __init__(
        self,
        data_dir: Path,
        stage: Stage,
        renderer: SongRenderer,
        *,
        now: Callable[[], float],
        loaded: int = LOADED,
    ) -> None:
        self.stage = stage
        self._folders = SessionFolders(data_dir)
        self._renderer = renderer
        self._now = now
        self._most_loaded = loaded
        self._sessions: OrderedDict[str, Session] = OrderedDict()
        self._loading: dict[str, asyncio.Task[Session]] = {}

    @property
    def loaded(self) -> int:
        """How many sessions are in memory."""
        return len(self._sessions)

    def staging(self) -> AbstractContextManager[Path]:
        """A new folder for a draft's files; what is not made a session of is removed at the end."""
        return self._folders.staging()

    async def create(self, draft: Draft) -> tuple[Session, str]:
        """Make a session.

        Returns:
            The session, and its control token, which is not kept.

        Raises:
            InputError: Score, song or show cannot be used; nothing of the draft is kept then.
        """
        token = new_token()
        record, production = await asyncio.to_thread(self._make, draft, hash_token(token))
        return self._admit(record, production), token

    async def get(self, session_id: str) -> Session | None:
        """A session, loaded if need be; None where there is none."""
        session = self._sessions.get(session_id)
        if session is None:
            if session_id not in self._folders:
                return None
            # Those who ask at the same time share one loading.
            loading = self._loading.get(session_id)
            if loading is None:
                loading = asyncio.create_task(self._load(session_id))
                self._loading[session_id] = loading
                loading.add_done_callback(lambda _: self._loading.pop(session_id, None))
            session = await asyncio.shield(loading)
        self._sessions.move_to_end(session_id)
        return session

    async def public(self) -> list[SessionRecord]:
        """The records of the sessions that are listed, newest first."""
        records = await asyncio.to_thread(self._folders.records)
        return [record for record in records if record.public]

    async def change(
        self,
        session: Session,
        *,
        title: str | None = None,
        public: bool | None = None,
        part: int | None = None,
        transposition: int | None = None,
    ) -> None:
        """Rename a session, list it or not, or let the player play another part; None leaves as it is.

        Raises:
            InputError: There is no such part.
        """
        asked = {"title": title, "public": public, "part": part, "transposition": transposition}
        changes = {field: value for field, value in asked.items() if value is not None}
        async with session.editing:
            record = session.record.model_copy(update=changes)
            production = session.production
            plays_other = (record.part, record.transposition) != (production.part, production.transposition)
            if plays_other:
                production = await asyncio.to_thread(
                    Production.plan,
                    self.stage,
                    production.score,
                    production.show,
                    part=record.part,
                    transposition=record.transposition,
                )
                session.change_part(record, production)
                session.song.close()
                session.song = self._song(session)
            session.record = record
            await asyncio.to_thread(self._folders.write_record, record)

    async def set_show(self, session: Session, edit: Callable[[Show], Show], *, path: str | None) -> Show:
        """Change a session's show and keep it.

        Args:
            session: Whose.
            edit: The show as it is -> as it is to be; may raise ShowError.
            path: The track that is edited, or None for the whole show.
        """
        async with session.editing:
            show = edit(session.production.show)
            production = await asyncio.to_thread(session.production.with_show, show)
            # Seen first, then kept: the answer waits for both.
            session.change_show(production, path=path)
            folder = self._folders.folder(session.id)
            await asyncio.to_thread(_write_show, folder, show)
        return show

    async def delete(self, session: Session) -> None:
        """End a session and remove everything of it."""
        self._sessions.pop(session.id, None)
        session.close()
        await asyncio.to_thread(self._folders.delete, session.id)

    async def aclose(self) -> None:
        """Put every session away."""
        for session in list(self._sessions.values()):
            self._put_away(session)
        await self._renderer.aclose()

    def _make(self, draft: Draft, token_sha256: str) -> tuple[SessionRecord, Production]:
        score = read_score((draft.folder / draft.score).read_bytes(), filename=draft.score_filename)
        song: SongRecord | None = None
        if draft.song is not None:
            info = probe_audio(draft.folder / draft.song)
            named = f"song{info.suffix}"
            (draft.folder / draft.song).rename(draft.folder / named)
            song = SongRecord(file=named, media_type=info.media_type, duration_s=info.duration_s)
        show = self.stage.show
        if draft.show is not None:
            show = read_show((draft.folder / draft.show).read_bytes(), self.stage.registry)
            (draft.folder / draft.show).unlink()
        production = Production.plan(
            self.stage, score, show, part=draft.part, transposition=draft.transposition
        )
        (draft.folder / draft.score).rename(draft.folder / SCORE)
        _write_show(draft.folder, show)
        record = SessionRecord(
            id=new_id(),
            title=draft.title or score.title,
            public=draft.public,
            created_at=created_now(),
            token_sha256=token_sha256,
            instrument=self.stage.instrument.name,
            part=production.part,
            transposition=production.transposition,
            score_filename=draft.score_filename,
            song=song,
        )
        self._folders.adopt(draft.folder, record)
        return record, production

    async def _load(self, session_id: str) -> Session:
        record, production = await asyncio.to_thread(self._read, session_id)
        return self._admit(record, production)

    def _read(self, session_id: str) -> tuple[SessionRecord, Production]:
        record = self._folders.record(session_id)
        folder = self._folders.folder(session_id)
        score = read_score((folder / SCORE).read_bytes(), filename=record.score_filename)
        show = read_show((folder / SHOW).read_bytes(), self.stage.registry)
        production = Production.plan(
            self.stage, score, show, part=record.part, transposition=record.transposition
        )
        return record, production

    def _admit(self, record: SessionRecord, production: Production) -> Session:
        session = Session(record, production, self._song, now=self._now)
        self._sessions[session.id] = session
        self._make_room()
        return session

    def _song(self, session: Session) -> Song:
        record, production = session.record, session.production
        if record.song:
            return UploadedSong(self._folders.folder(record.id), record.song)
        return RenderedSong(self._renderer, production.score, production.part, ready=session.tell_song)

    def _make_room(self) -> None:
        *others, _ = self._sessions.values()
        idle = [session for session in others if session.is_idle]
        for session in idle[: max(0, len(self._sessions) - self._most_loaded)]:
            self._put_away(session)

    def _put_away(self, session: Session) -> None:
        del self._sessions[session.id]
        record = session.record.model_copy(update={"song_time_s": session.clock.state().song_time_s})
        if record != session.record:
            self._folders.write_record(record)
        session.close()


def _write_show(folder: Path, show: Show) -> None:
    write_atomically(folder / SHOW, json.dumps(show.to_document(), indent=1).encode())
