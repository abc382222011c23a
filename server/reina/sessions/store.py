"""All sessions of a server: a bounded number in memory, all of them on disk."""

from __future__ import annotations

import asyncio
import logging
import shutil
from collections import OrderedDict
from contextlib import asynccontextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

from reina.errors import InputError
from reina.sessions.description import warned
from reina.sessions.folders import SCORE, SHOW, SessionFolders, write_atomically
from reina.sessions.kept_show import KeptShow
from reina.sessions.production import PLAYER
from reina.sessions.reader import Playing, Reader
from reina.sessions.record import SessionRecord, SongRecord, created_now, hash_token, new_id, new_token
from reina.sessions.session import DECIDES_THE_SOUND, Session, note_messages
from reina.sessions.song import RenderedSong, Song, UploadedSong
from reina.sessions.sound_decoder import SongDecoder

if TYPE_CHECKING:
    from collections.abc import AsyncGenerator, Callable, Sequence
    from pathlib import Path

    from reina.keyframes import ShowHistory
    from reina.sessions.note_messages import NoteMessages
    from reina.sessions.production import Production, Stage
    from reina.sessions.session_index import Entry
    from reina.sessions.sound import SongRenderer

SONG_CACHE_BYTES = 2_000_000_000
"""How large the rendered songs may be together; beyond that, those that were asked for least recently go."""

LOADED = 32
"""How many sessions are kept in memory; beyond that, the idle ones that were asked for least recently are put
away."""


DECIDES_WHAT_IS_PLAYED = (*DECIDES_THE_SOUND, "player")
"""Fields of a record."""

_log = logging.getLogger(__name__)


class SessionEndedError(InputError):
    """A session was to be changed that has been ended meanwhile."""


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
        written: Whether it is notated for the instrument.
        octave_fit: Whether it is moved into range by octaves.
        joined_parts: Further parts that the player plays together with it.
        sequence: Which of the score's sequences; the first when None.
        player: Name of who plays.
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
    written: bool = False
    octave_fit: bool = False
    joined_parts: tuple[int, ...] = ()
    sequence: int | None = None
    player: str = PLAYER


class SessionStore:
    """Makes, finds, keeps and ends sessions.

    Reading, planning and writing happen on threads and in processes; sessions themselves live on the event
    loop.

    Args:
        data_dir: Where sessions and rendered songs are kept.
        stage: Who plays on what.
        renderer: Makes songs for scores that come without.
        now: Server time, seconds; never goes back.
        loaded: How many sessions are kept in memory.
        song_cache_bytes: How large the rendered songs may be together.
        decoder: Tells what uploaded songs are.
        reader: Reads scores and shows.
    """

    def __init__(
        self,
        data_dir: Path,
        stage: Stage,
        renderer: SongRenderer,
        *,
        now: Callable[[], float],
        loaded: int = LOADED,
        song_cache_bytes: int = SONG_CACHE_BYTES,
        decoder: SongDecoder | None = None,
        reader: Reader | None = None,
    ) -> None:
        self.stage = stage
        self.reader = reader or Reader(stage)
        self.decoder = decoder or SongDecoder()
        self._folders = SessionFolders(data_dir)
        self._renderer = renderer
        self._now = now
        self._most_loaded = loaded
        self._song_cache_bytes = song_cache_bytes
        self._pruning: set[asyncio.Task[None]] = set()
        self._sessions: OrderedDict[str, Session] = OrderedDict()
        self._loading: dict[str, asyncio.Task[Session | None]] = {}
        self._putting_away: dict[str, asyncio.Task[None]] = {}

    @property
    def loaded(self) -> int:
        """How many sessions are in memory."""
        return len(self._sessions)

    @asynccontextmanager
    async def staging(self) -> AsyncGenerator[Path]:
        """A new folder for a draft's files; what is not made a session of is removed at the end."""
        folder = await asyncio.to_thread(self._folders.stage)
        try:
            yield folder
        finally:
            await asyncio.to_thread(shutil.rmtree, folder, ignore_errors=True)

    async def create(self, draft: Draft) -> tuple[Session, str]:
        """Make a session.

        Returns:
            The session, and its control token, which is not kept.

        Raises:
            InputError: Score, song or show cannot be used; nothing of the draft is kept then.
        """
        token = new_token()
        production = await self._plan(draft.folder / draft.score, draft, part=draft.part)
        song = None if draft.song is None else await self._keep_song(draft.folder / draft.song)
        if draft.show is not None:
            show_file = draft.folder / draft.show
            show = await self.reader.show(await asyncio.to_thread(show_file.read_bytes))
            await asyncio.to_thread(show_file.unlink)
            production = await asyncio.to_thread(production.with_show, show)
        return self._admit(
            *await asyncio.to_thread(self._make, draft, production, song, hash_token(token))
        ), token

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
            if await asyncio.shield(loading) is None:
                return None
            # It may have been ended or put away again before it was this one's turn.
            return await self.get(session_id)
        self._sessions.move_to_end(session_id)
        return session

    def listed(self, limit: int, after: str | None = None) -> tuple[list[Entry], str | None]:
        """Some of the sessions that are listed, newest first; see `SessionIndex.page`."""
        return self._folders.index.page(limit, after)

    async def change(
        self,
        session: Session,
        *,
        title: str | None = None,
        public: bool | None = None,
        part: int | None = None,
        transposition: int | None = None,
        written: bool | None = None,
        octave_fit: bool | None = None,
        joined_parts: Sequence[int] | None = None,
        sequence: int | None = None,
        player: str | None = None,
    ) -> None:
        """Rename a session, list it or not, or let the player play something else; None leaves as it is.

        Of another sequence the part that suits best is played, unless one is named with it. Another part is
        played alone, unless `joined_parts` says otherwise. A title and a show that are still those of the
        sequence before give way to its own.

        Raises:
            InputError: There is no such part, sequence or player, or a part cannot be joined; nothing is
                changed then.
        """
        asked = {
            "title": title,
            "public": public,
            "part": part,
            "transposition": transposition,
            "written": written,
            "octave_fit": octave_fit,
            "joined_parts": None if joined_parts is None else tuple(joined_parts),
            "sequence": sequence,
            "player": player,
        }
        changes = {field: value for field, value in asked.items() if value is not None}
        async with self._edit(session):
            if joined_parts is None and _names_another_part(session, part, sequence):
                changes["joined_parts"] = ()
            record, kept = session.record.model_copy(update=changes), session.kept_show
            if any(
                getattr(record, field) != getattr(session.record, field) for field in DECIDES_WHAT_IS_PLAYED
            ):
                production, kept = await self._plan_other(session, record, names_part=part is not None)
                before, after = session.production.score.title, production.score.title
                titled = {"title": after} if title is None and record.title == before else {}
                joined = production.played.joined_parts
                record = record.model_copy(update={"part": production.part, "joined_parts": joined, **titled})
                await session.change_part(record, production)
                if kept is not session.kept_show:
                    await session.change_show(production, kept)
                    await asyncio.to_thread(_write_show, self._folders.folder(session.id), kept)
            session.record = record
            await asyncio.to_thread(self._folders.write_record, record)

    async def change_show(self, session: Session, step: Callable[[ShowHistory], ShowHistory]) -> KeptShow:
        """Take a session's show one step on or back, and keep it; edits of a session follow one another.

        Args:
            session: Whose.
            step: The history as it is -> as it is to be; runs on a thread. What it raises is raised on, and
                nothing is changed then.
        """
        async with self._edit(session):
            kept = await asyncio.to_thread(session.kept_show.then, step)
            if kept is not session.kept_show:
                production = await asyncio.to_thread(session.production.with_show, kept.show)
                # Seen first, then kept: the answer waits for both.
                await session.change_show(production, kept)
                await asyncio.to_thread(_write_show, self._folders.folder(session.id), kept)
        return kept

    async def delete(self, session: Session) -> None:
        """End a session and remove everything of it.

        The song that was rendered for it goes too, unless a session that is loaded has the same; one that is
        not will have it rendered anew.
        """
        async with self._edit(session):
            del self._sessions[session.id]
            session.close()
            doomed = await asyncio.to_thread(self._folders.take_out, session.id)
        await asyncio.to_thread(shutil.rmtree, doomed, ignore_errors=True)
        if session.record.song is None and session.song.path not in self._songs_in_use():
            await asyncio.to_thread(self._renderer.discard, session.song.path)

    async def prune_songs(self) -> None:
        """Remove the rendered songs that were not asked for the longest until the rest is small enough."""
        freed = await asyncio.to_thread(
            self._renderer.prune, self._song_cache_bytes, in_use=self._songs_in_use()
        )
        if freed:
            _log.info("removed %.0f MB of rendered songs", freed / 1e6)

    async def aclose(self) -> None:
        """Put every session away."""
        for session in list(self._sessions.values()):
            self._put_away(session)
        await self._renderer.aclose()
        await self.reader.aclose()
        for tasks in (self._pruning, self._putting_away.values()):
            if tasks:
                await asyncio.wait(tasks)
        await asyncio.to_thread(self._folders.write_index)

    async def _keep_song(self, uploaded: Path) -> SongRecord:
        """Have a song decoded, and give it the name that its format has; its peaks stand beside it."""
        info = await self.decoder.probe(uploaded)
        song = uploaded.with_name(f"song{info.suffix}")
        await asyncio.to_thread(uploaded.rename, song)
        return SongRecord(
            file=song.name,
            media_type=info.media_type,
            duration_s=info.duration_s,
            warnings=tuple(warned(info.warnings)),
        )

    def _make(
        self, draft: Draft, production: Production, song: SongRecord | None, token_sha256: str
    ) -> tuple[SessionRecord, Production, KeptShow, NoteMessages]:
        (draft.folder / draft.score).rename(draft.folder / SCORE)
        kept = KeptShow.begin(production.show)
        _write_show(draft.folder, kept)
        record = SessionRecord(
            id=new_id(),
            title=draft.title or production.score.title,
            public=draft.public,
            created_at=created_now(),
            token_sha256=token_sha256,
            instrument=self.stage.instrument.name,
            part=production.part,
            transposition=production.transposition,
            written=production.written,
            octave_fit=production.octave_fit,
            joined_parts=production.played.joined_parts,
            sequence=draft.sequence,
            player=production.player,
            score_filename=draft.score_filename,
            song=song,
        )
        self._folders.adopt(draft.folder, record)
        return record, production, kept, note_messages(production)

    @asynccontextmanager
    async def _edit(self, session: Session) -> AsyncGenerator[None]:
        """Hold a session while it is changed, so that edits neither overtake one another nor outlive it.

        Raises:
            SessionEndedError: It was ended while this waited.
        """
        async with session.editing:
            if self._sessions.get(session.id) is not session:
                raise SessionEndedError(f"the session {session.id!r} was ended meanwhile")
            yield

    async def _load(self, session_id: str) -> Session | None:
        # What was kept of it last is what is read.
        if session_id in self._putting_away:
            await asyncio.wait([self._putting_away[session_id]])
        try:
            read = await self._read(session_id)
        except FileNotFoundError:
            if session_id in self._folders:
                raise
            return None
        # Ended while it was read: it must not come back.
        return self._admit(*read) if session_id in self._folders else None

    async def _read(self, session_id: str) -> tuple[SessionRecord, Production, KeptShow, NoteMessages]:
        folder = self._folders.folder(session_id)
        record = await asyncio.to_thread(self._folders.record, session_id)
        show = await self.reader.show(await asyncio.to_thread((folder / SHOW).read_bytes))
        planned = await self._plan(folder / SCORE, record, part=record.part)

        def prepared() -> tuple[SessionRecord, Production, KeptShow, NoteMessages]:
            production = planned.with_show(show)
            return record, production, KeptShow.begin(show), note_messages(production)

        return await asyncio.to_thread(prepared)

    async def _plan(self, score: Path, wanted: Draft | SessionRecord, *, part: int | None) -> Production:
        """Read a score and plan what is wanted of it, with the show that is written for it."""
        playing = Playing(
            part=part,
            transposition=wanted.transposition,
            written=wanted.written,
            octave_fit=wanted.octave_fit,
            joined_parts=wanted.joined_parts,
            player=wanted.player,
        )
        return await self.reader.production(
            score, filename=wanted.score_filename, sequence=wanted.sequence, playing=playing
        )

    async def _plan_other(
        self, session: Session, record: SessionRecord, *, names_part: bool
    ) -> tuple[Production, KeptShow]:
        """Plan what `record` asks for in place of what the session plays."""
        before, kept = session.production, session.kept_show
        another = record.sequence not in (None, before.score.sequence)
        part = None if another and not names_part else record.part
        planned = await self._plan(self._folders.folder(record.id) / SCORE, record, part=part)
        if another and await asyncio.to_thread(lambda: before.has_default_show):
            return planned, await asyncio.to_thread(kept.then, lambda history: history.then(planned.show))
        return await asyncio.to_thread(planned.with_show, before.show), kept

    def _admit(
        self, record: SessionRecord, production: Production, kept: KeptShow, notes: NoteMessages
    ) -> Session:
        session = Session(record, production, kept, notes, self._song, now=self._now)
        self._sessions[session.id] = session
        self._make_room()
        return session

    def _song(self, session: Session) -> Song:
        record, production = session.record, session.production
        if record.song:
            return UploadedSong(self._folders.folder(record.id), record.song)
        return RenderedSong(
            self._renderer, production.score, production.played, ready=lambda: self._song_made(session)
        )

    def _song_made(self, session: Session) -> None:
        session.tell_song()
        pruning = asyncio.create_task(self.prune_songs())
        self._pruning.add(pruning)
        pruning.add_done_callback(self._pruning.discard)

    def _songs_in_use(self) -> set[Path]:
        return {session.song.path for session in self._sessions.values() if session.song.path is not None}

    def _make_room(self) -> None:
        *others, _ = self._sessions.values()
        idle = [session for session in others if session.is_idle]
        for session in idle[: max(0, len(self._sessions) - self._most_loaded)]:
            self._put_away(session)

    def _put_away(self, session: Session) -> None:
        del self._sessions[session.id]
        record = session.record.model_copy(update={"song_time_s": session.clock.state().song_time_s})
        session.close()
        if record != session.record:
            writing = asyncio.create_task(asyncio.to_thread(self._folders.write_record, record))
            self._putting_away[session.id] = writing
            writing.add_done_callback(lambda _: self._putting_away.pop(session.id, None))


def _names_another_part(session: Session, part: int | None, sequence: int | None) -> bool:
    """Whether another part than is played is asked for, or another sequence, whose parts are others."""
    another_sequence = sequence not in (None, session.production.score.sequence)
    return another_sequence or part not in (None, session.record.part)


def _write_show(folder: Path, kept: KeptShow) -> None:
    write_atomically(folder / SHOW, kept.text.text.encode())
