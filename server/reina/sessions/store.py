"""All sessions of a server: a bounded number in memory, all of them on disk."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import shutil
import time
from collections import OrderedDict
from contextlib import asynccontextmanager, contextmanager
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from reina.errors import InputError
from reina.instruments import Cast
from reina.music import ScoreError
from reina.sessions.clock_keeping import ClockKeeping
from reina.sessions.description import warned
from reina.sessions.file_role import LOOKED_AT_BYTES, OTHER_JSON, Role, role_of
from reina.sessions.file_role import SHOW as SHOW_DOCUMENT
from reina.sessions.folders import SCORE, SHOW, SessionFolders
from reina.sessions.memory_bound import MEMORY_BYTES, MemoryBound
from reina.sessions.record import SessionRecord, SongRecord, StanceRecord, created_now, new_id
from reina.sessions.session import Session, note_messages
from reina.sessions.show_revision import ShowRevision
from reina.sessions.sightings import Sightings, near_end
from reina.sessions.song import RenderedSong, Song, UploadedSong
from reina.sessions.staging import STAGING_BYTES, StagingRoom
from reina.sessions.usage import DiskBound
from reina.sessions.workers.reader import Reader
from reina.show import ShowError
from reina.skeleton import pose_of
from reina.sound.alignment.aligner_process import Aligner
from reina.sound.alignment.alignment import Alignment, MapPoint
from reina.sound.recording.as_flac import SUFFIX as FLAC_SUFFIX
from reina.sound.recording.decoder import SongDecoder
from reina.sound.recording.peaks import peaks_path
from reina.sound.recording.probe import Conversion
from reina.system.durable import write_durably
from reina.system.tokens import hash_token, new_token

if TYPE_CHECKING:
    from collections.abc import AsyncGenerator, Callable, Generator, Iterable
    from pathlib import Path

    from reina.sessions.note_messages import NoteMessages
    from reina.sessions.production import Production
    from reina.sessions.session_index import Entry
    from reina.sessions.stage import Stage
    from reina.sessions.usage import Usage
    from reina.show import ShowHistory
    from reina.sound.hearing import Hearing
    from reina.sound.recording.probe import AudioInfo
    from reina.sound.renderer import SongRenderer

Stances = tuple[StanceRecord, ...]

HEARD_TOLERANCE_S, HEARD_TOLERANCE = 1.0, 0.01
"""By how much what a page decoded may differ from the length that the song's headers say: s, and a share."""
LOWEST_HEARD_RATE = 8000
"""Fewer samples a second tell too little of notes."""

LOADED = 32
"""How many sessions are kept in memory; beyond that, the idle ones that were asked for least recently are put
away."""


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
        cast: Who plays what.
        in_time: Whether the score's seconds are the song's already, so that it need not be looked for.
        sender: Who sent it, as far as that is known; what is read of senders is read in turn.
        owner: The person whose it is, where people are known; controls it without a token.
    """

    folder: Path
    score: str
    score_filename: str | None = None
    song: str | None = None
    show: str | None = None
    title: str | None = None
    public: bool = False
    cast: Cast = field(default_factory=Cast)
    in_time: bool = False
    sender: str = ""
    owner: str | None = None


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
        memory_bytes: How many bytes the sessions in memory may weigh together.
        disk: How much may be kept.
        staging_bytes: How large what is being sent may be together.
        wall: The present, seconds since 1970.
        decoder: Tells what uploaded songs are.
        reader: Reads scores and shows.
        aligner: Finds scores in uploaded songs.
    """

    def __init__(
        self,
        data_dir: Path,
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
    ) -> None:
        self.stage = stage
        self.reader = reader or Reader(stage)
        self.decoder = decoder or SongDecoder()
        self._folders = SessionFolders(data_dir)
        self._renderer = renderer
        renderer.cache.in_use = self._listened_to
        self._aligner = aligner or Aligner()
        self._now = now
        self._wall = wall
        self._bound = MemoryBound(loaded, memory_bytes)
        self._coming = 0
        self._disk = disk or DiskBound()
        self.staged = StagingRoom(staging_bytes)
        """What is being sent."""
        self._clocks = ClockKeeping(self._keep_clock)
        self.sightings = Sightings(self._folders, wall=wall)
        """When sessions were seen."""
        self._pruning: set[asyncio.Task[None]] = set()
        self._sessions: OrderedDict[str, Session] = OrderedDict()
        self._loading: dict[str, asyncio.Task[Session | None]] = {}
        self._putting_away: dict[str, asyncio.Task[None]] = {}

    @property
    def loaded(self) -> int:
        """How many sessions are in memory."""
        return len(self._sessions)

    @property
    def viewers(self) -> int:
        """How many streams are open."""
        return sum(len(session.audience) for session in list(self._sessions.values()))

    @property
    def weight(self) -> int:
        """About how many bytes they take."""
        return sum(session.weight for session in self._sessions.values())

    def ends_at(self, session: Session, after_s: float) -> str | None:
        """When a session will be ended that nobody sees, if that is near: ISO 8601, UTC.

        Args:
            session: Which.
            after_s: How long after it was seen last sessions are ended; 0 for never.
        """
        if not after_s or len(session.audience):
            return None
        ends_s = self.sightings.ends_s(session.id, after_s)
        return None if ends_s is None else near_end(ends_s, self._wall(), after_s)

    @property
    def watched(self) -> list[str]:
        """The ids of those that somebody watches."""
        return [session.id for session in self._sessions.values() if len(session.audience)]

    async def end_unseen(self, after_s: float) -> int:
        """End the sessions that nobody has seen for so long, seconds; returns how many."""
        await self.sightings.keep(self.watched)
        ended, since_s = 0, self._wall() - after_s
        for session_id in await asyncio.to_thread(self._folders.unseen_since, since_s):
            loaded = self._sessions.get(session_id)
            if loaded is None and session_id not in self._loading:
                doomed = await asyncio.to_thread(self._folders.take_out, session_id)
                await asyncio.to_thread(shutil.rmtree, doomed, ignore_errors=True)
            elif loaded is not None and loaded.is_idle:
                await self.delete(loaded)
            else:
                continue
            ended += 1
        return ended

    @asynccontextmanager
    async def staging(self, sender: str = "") -> AsyncGenerator[Path]:
        """A new folder for a draft's files; what is not made a session of is removed at the end.

        Args:
            sender: Who sends them; `staged` counts them.
        """
        folder = await self.staging_folder(sender)
        try:
            yield folder
        finally:
            await self.discard_staged(folder)

    async def staging_folder(self, sender: str = "") -> Path:
        """A new folder; whoever asked for it has it discarded."""
        folder = await asyncio.to_thread(self._folders.stage)
        self.staged.begin(folder, sender)
        return folder

    async def discard_staged(self, folder: Path) -> None:
        """Remove a folder of `staging_folder`, if it is still there."""
        await asyncio.to_thread(shutil.rmtree, folder, ignore_errors=True)
        self.staged.end(folder)

    def usage(self, sender: str | None) -> Usage:
        """How many sessions came from a sender, or from all (None), and how large they are."""
        return self._folders.usage(sender)

    def require_disk(self, sender: str, adding: int = 0) -> None:
        """See that another session of a sender may be kept; what the sender is sending counts too.

        Raises:
            LimitError: It may not.
        """
        self._disk.require(self._folders.usage, sender, max(adding, self.staged.of(sender) if sender else 0))

    async def create(self, draft: Draft) -> tuple[Session, str]:
        """Make a session.

        Returns:
            The session, and its control token, which is not kept.

        Raises:
            InputError: Score, song or show cannot be used; nothing of the draft is kept then.
        """
        token = new_token()
        self.require_disk(draft.sender, self.staged.size(draft.folder))
        try:
            production = await self._plan(
                draft.folder / draft.score, draft.score_filename, draft.cast, owner=draft.sender
            )
        except ScoreError as error:
            if await asyncio.to_thread(_role_of_file, draft.folder / draft.score) == "show":
                raise ScoreError("this is a show; send it as the show, beside a score") from error
            raise
        song = None if draft.song is None else await self._keep_song(draft.folder / draft.song)
        if draft.show is not None:
            show_file = draft.folder / draft.show
            data = await asyncio.to_thread(show_file.read_bytes)
            try:
                show = await self.reader.show(data, production.registry, owner=draft.sender)
            except ShowError as error:
                sent = await asyncio.to_thread(role_of, data)
                if sent in {SHOW_DOCUMENT, OTHER_JSON}:
                    raise
                raise ShowError(f"this is {sent.name}, not a show") from error
            await asyncio.to_thread(show_file.unlink)
            production = await asyncio.to_thread(production.with_show, show)
        kept = await asyncio.to_thread(ShowRevision.begin, production.show)
        await self._clocks.written()
        with self._room_for(production.weight + kept.weight):
            made = await asyncio.to_thread(self._make, draft, production, kept, song, hash_token(token))
            in_time: Alignment | None = None
            if draft.in_time and song is not None and song.duration_s is not None:
                in_time = _in_time(production.score.duration_s, song.duration_s)
                await asyncio.to_thread(self._folders.write_alignment, made[0].id, in_time)
        session = self._admit(*made, in_time)
        if in_time is None:
            self.search_alignment(session)
        return session, token

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
            # It may have been ended or unloaded again before it was this one's turn.
            return await self.get(session_id)
        self._sessions.move_to_end(session_id)
        return session

    def listed(
        self, limit: int, after: str | None = None, *, owner: str | None = None
    ) -> tuple[list[Entry], str | None]:
        """Some of the sessions that are listed, or of a person's, newest first; see `SessionIndex.page`."""
        return self._folders.index.page(limit, after, owner=owner)

    async def renew_token(self, session: Session) -> str:
        """Give a session another control token, in place of the one before; returns it, which is not kept."""
        token = new_token()
        async with self._edit(session):
            record = session.record.model_copy(update={"token_sha256": hash_token(token)})
            await asyncio.to_thread(self._folders.write_record, record)
            session.record = record
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
        async with self._edit(session):
            record, kept = session.record.model_copy(update=changes), session.show_revision
            wanted = recast(record.cast) if recast else record.cast
            stances = restance(record.stances) if restance else record.stances
            if wanted != record.cast or stances != record.stances:
                another_piece = wanted.sequence not in {None, session.production.score.sequence}
                # Another piece is heard elsewhere, if at all.
                alignment = None if another_piece else session.alignment.alignment
                production, kept = await self._plan_other(session, wanted, alignment, stances)
                before, after = session.production.score.title, production.score.title
                titled = {"title": after} if title is None and record.title == before else {}
                record = record.model_copy(update={"cast": production.cast, "stances": stances, **titled})
                await session.change_cast(record, production)
                if kept is not session.show_revision:
                    await session.change_show(production, kept)
                    await asyncio.to_thread(_write_show, self._folders.folder(session.id), kept)
                if another_piece:
                    session.alignment.alignment = None
                    await asyncio.to_thread(self._folders.write_alignment, session.id, None)
                    self.search_alignment(session)
            await asyncio.to_thread(self._folders.write_record, record)
            session.record = record

    async def change_alignment(self, session: Session, step: Callable[[Alignment | None], Alignment]) -> None:
        """Say anew where a session's score is heard in its song; edits of a session follow one another.

        Args:
            session: Whose.
            step: What is known -> what is to be known. What it raises is raised on, and nothing is changed.
        """
        async with self._edit(session):
            before = session.alignment.alignment
            alignment = await asyncio.to_thread(step, before)
            if alignment == before:
                return
            if (before is None or not before.moves) and not alignment.moves:
                # Nothing is heard elsewhere than before.
                session.alignment.alignment = alignment
                session.tell_alignment()
            else:
                production, kept = await self._plan_other(
                    session, session.record.cast, alignment, session.record.stances
                )
                other_show = kept is not session.show_revision
                await session.change_alignment(production, kept, alignment)
                if other_show:
                    await asyncio.to_thread(_write_show, self._folders.folder(session.id), kept)
            await asyncio.to_thread(self._folders.write_alignment, session.id, alignment)

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
            self._folders.folder(session.id) / (song.heard or song.file),
            session.production.written_score,
            found=found,
            tell=session.tell_alignment,
        )
        return True

    async def hear_song(self, session: Session, sent: Path) -> None:
        """Take what a page decoded of a song that the server does not decode, and look for the score in it.

        Its length is the song's from then on, and its peaks are.

        Args:
            session: Whose.
            sent: The sound, in a folder of `staging`: WAV or anything else that is decoded here.

        Raises:
            InputError: It cannot be decoded, or not be that song.
        """
        heard = sent.with_name(f"heard{FLAC_SUFFIX}")
        info = await self.decoder.probe(sent, Conversion(heard, is_forced=True))
        async with self._edit(session):
            song = session.record.song
            if song is None:
                raise InputError("the session has no recording")
            _check_heard(info, song)
            folder = self._folders.folder(session.id)
            record = session.record.model_copy(
                update={"song": song.model_copy(update={"heard": heard.name, "duration_s": info.duration_s})}
            )

            def keep() -> None:
                heard.replace(folder / heard.name)
                peaks_path(sent).replace(peaks_path(folder / song.file))
                self._folders.write_record(record)

            await asyncio.to_thread(keep)
            session.alignment.is_heard = True
            await session.change_cast(record, session.production)
        self.search_alignment(session)

    async def change_show(self, session: Session, step: Callable[[ShowHistory], ShowHistory]) -> ShowRevision:
        """Take a session's show one step on or back, and keep it; edits of a session follow one another.

        Args:
            session: Whose.
            step: The history as it is -> as it is to be; runs on a thread. What it raises is raised on, and
                nothing is changed then.
        """
        async with self._edit(session):
            kept = await asyncio.to_thread(session.show_revision.then, step)
            if kept is not session.show_revision:
                production = await asyncio.to_thread(session.production.with_show, kept.show)
                self._make_room(kept.weight - session.show_revision.weight, staying=session)
                # Seen first, then kept: the answer waits for both.
                await session.change_show(production, kept)
                await asyncio.to_thread(_write_show, self._folders.folder(session.id), kept)
                await asyncio.to_thread(self._folders.note_size, session.id)
        return kept

    def original_song(self, session: Session) -> Path | None:
        """The recording as it was sent; None where there is none."""
        song = session.record.song
        return None if song is None else self._folders.folder(session.id) / (song.original or song.file)

    def score_file(self, session: Session) -> Path:
        """The file that a session was made of, as it was sent."""
        return self._folders.folder(session.id) / SCORE

    async def delete(self, session: Session) -> None:
        """End a session and remove everything of it.

        The song that was rendered for it goes too, unless a session that is loaded has the same; one that is
        not will have it rendered anew.
        """
        async with self._edit(session):
            del self._sessions[session.id]
            songs = session.heard.paths
            session.close()
            doomed = await asyncio.to_thread(self._folders.take_out, session.id)
        await asyncio.to_thread(shutil.rmtree, doomed, ignore_errors=True)
        if session.record.song is None and session.song.path is not None:
            songs.add(session.song.path)
        for path in songs - self.songs_in_use():
            await asyncio.to_thread(self._renderer.discard, path)

    async def prune_songs(self) -> None:
        """Remove the rendered songs that were not asked for the longest until the rest is small enough."""
        freed = await asyncio.to_thread(self._renderer.prune, in_use=self._listened_to())
        if freed:
            _log.info("removed %.0f MB of rendered songs", freed / 1e6)

    async def aclose(self) -> None:
        """Put every session away."""
        await self._clocks.aclose()
        await self.sightings.keep(self.watched)
        for session in list(self._sessions.values()):
            self._unload(session)
        await self._renderer.aclose()
        await self._aligner.aclose()
        await self.reader.aclose()
        for tasks in (self._pruning, self._putting_away.values()):
            if tasks:
                await asyncio.wait(tasks)
        with contextlib.suppress(OSError):
            # It only saves time at the next start; a full disk has no room for it.
            await asyncio.to_thread(self._folders.write_index)

    async def _keep_song(self, uploaded: Path) -> SongRecord:
        """Have a song decoded, and give it the name that its format has; its peaks stand beside it.

        What most browsers do not play is served as FLAC; the file as it came is kept.
        """
        served = uploaded.with_name(f"song{FLAC_SUFFIX}")
        info = await self.decoder.probe(uploaded, Conversion(served))
        song = uploaded.with_name(f"{'original' if info.is_converted else 'song'}{info.suffix}")
        await asyncio.to_thread(uploaded.rename, song)
        return SongRecord(
            file=served.name if info.is_converted else song.name,
            media_type=info.media_type,
            duration_s=info.duration_s,
            warnings=tuple(warned(info.warnings)),
            original=song.name if info.is_converted else None,
        )

    def _make(
        self,
        draft: Draft,
        production: Production,
        kept: ShowRevision,
        song: SongRecord | None,
        token_sha256: str,
    ) -> tuple[SessionRecord, Production, ShowRevision, NoteMessages]:
        (draft.folder / draft.score).rename(draft.folder / SCORE)
        _write_show(draft.folder, kept)
        record = SessionRecord(
            id=new_id(),
            title=draft.title or production.score.title,
            public=draft.public,
            created_at=created_now(),
            token_sha256=token_sha256,
            owner=draft.owner,
            cast=production.cast,
            score_filename=draft.score_filename,
            song=song,
            sender=draft.sender,
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
        await self._clocks.written()
        # Ended while it was read: it must not come back.
        if session_id not in self._folders:
            return None
        record, production, kept, notes, alignment = read
        session = self._admit(record, production, kept, notes, alignment)
        if alignment is None:
            # It was still being looked for when the server ended.
            self.search_alignment(session)
        return session

    async def _read(
        self, session_id: str
    ) -> tuple[SessionRecord, Production, ShowRevision, NoteMessages, Alignment | None]:
        folder = self._folders.folder(session_id)
        record = await asyncio.to_thread(self._folders.record, session_id)
        alignment = await asyncio.to_thread(self._folders.alignment, session_id)
        planned = await self._plan(
            folder / SCORE, record.score_filename, record.cast, alignment, record.stances, owner=session_id
        )
        data = await asyncio.to_thread((folder / SHOW).read_bytes)
        show = await self.reader.show(data, planned.registry, owner=session_id)

        def prepared() -> tuple[SessionRecord, Production, ShowRevision, NoteMessages, Alignment | None]:
            production = planned.with_show(show)
            return record, production, ShowRevision.begin(show), note_messages(production), alignment

        return await asyncio.to_thread(prepared)

    async def _plan(
        self,
        score: Path,
        filename: str | None,
        cast: Cast,
        alignment: Alignment | None = None,
        stances: Stances = (),
        *,
        owner: str,
    ) -> Production:
        """Read a score and plan how a cast plays it, with the show that is written for it."""
        heard = alignment if alignment is not None and alignment.moves else None
        poses = {stance.name: pose_of(stance.turns) for stance in stances}
        return await self.reader.production(
            score,
            filename=filename,
            cast=cast,
            alignment=heard,
            stances=poses,
            transposition=0 if heard is None else heard.played_higher,
            owner=owner,
        )

    async def _plan_other(
        self, session: Session, wanted: Cast, alignment: Alignment | None, stances: Stances
    ) -> tuple[Production, ShowRevision]:
        """Plan another cast, or the same heard elsewhere or with other stances, in place of the session's."""
        before, kept = session.production, session.show_revision
        path = self._folders.folder(session.id) / SCORE
        planned = await self._plan(
            path, session.record.score_filename, wanted, alignment, stances, owner=session.id
        )
        another = (
            planned.score.sequence != before.score.sequence
            or planned.places != before.places
            or alignment != session.alignment.alignment
        )
        if not another or not await asyncio.to_thread(lambda: before.has_default_show):
            planned = await asyncio.to_thread(planned.with_show, before.show)
        if planned.show is not kept.show:
            kept = await asyncio.to_thread(kept.then, lambda history: history.then(planned.show))
        growing = planned.weight + kept.weight - before.weight - session.show_revision.weight
        self._make_room(growing, staying=session)
        return planned, kept

    def _admit(
        self,
        record: SessionRecord,
        production: Production,
        kept: ShowRevision,
        notes: NoteMessages,
        alignment: Alignment | None = None,
    ) -> Session:
        self._make_room(production.weight + kept.weight)
        session = Session(
            record,
            production,
            kept,
            notes,
            self._song,
            self._heard,
            now=self._now,
            wall=self._wall,
            alignment=alignment,
            clock_changed=self._clocks.note,
        )
        self._sessions[session.id] = session
        return session

    def _song(self, session: Session) -> Song:
        record, production = session.record, session.production
        if record.song:
            return UploadedSong(self._folders.folder(record.id), record.song)
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
        return self._songs_of(session for session in self._sessions.values() if len(session.audience))

    def songs_in_use(self) -> set[Path]:
        """Files of songs that sessions have open, as everybody and as single viewers hear them."""
        return self._songs_of(self._sessions.values())

    @staticmethod
    def _songs_of(sessions: Iterable[Session]) -> set[Path]:
        paths: set[Path] = set()
        for session in sessions:
            paths |= session.heard.paths
            if session.song.path is not None:
                paths.add(session.song.path)
        return paths

    def _make_room(self, adding: int, *, staying: Session | None = None) -> None:
        """Unload what is idle, so that something more fits.

        Raises:
            LimitError: It does not, with all that is watched.
        """
        loaded = self._sessions.values()
        for session in self._bound.leaving(loaded, adding, coming=self._coming, staying=staying):
            self._unload(session)

    @contextmanager
    def _room_for(self, weight: int) -> Generator[None]:
        """Have room for a session that is being made.

        Raises:
            LimitError: There is none.
        """
        self._make_room(weight)
        self._coming += weight
        try:
            yield
        finally:
            self._coming -= weight

    async def _keep_clock(self, session: Session) -> None:
        async with session.editing:
            if self._sessions.get(session.id) is session:
                record = session.kept()
                await asyncio.to_thread(self._folders.write_record, record)
                session.is_kept(record)

    def _unload(self, session: Session) -> None:
        del self._sessions[session.id]
        record = session.kept()
        session.close()
        if record != session.record:
            writing = asyncio.create_task(asyncio.to_thread(self._folders.write_record, record))
            self._putting_away[session.id] = writing
            writing.add_done_callback(lambda _: self._putting_away.pop(session.id, None))


def _check_heard(info: AudioInfo, song: SongRecord) -> None:
    """Refuse what is not the sound of a song, as far as can be told.

    Raises:
        InputError: It is not.
    """
    if info.duration_s is None or info.sample_rate is None or not info.is_converted:
        raise InputError(
            f"{info.format} is not decoded here either: send the sound as WAV or FLAC, of one channel or two"
        )
    if info.sample_rate < LOWEST_HEARD_RATE:
        raise InputError(
            f"the sound has {info.sample_rate:,} samples a second; {LOWEST_HEARD_RATE:,} at least are needed "
            "to hear notes in it, 22,050 are enough"
        )
    if song.duration_s is None or song.heard is not None:
        return
    if abs(info.duration_s - song.duration_s) > HEARD_TOLERANCE_S + HEARD_TOLERANCE * song.duration_s:
        raise InputError(
            f"the sound lasts {info.duration_s:.2f} s, and the song {song.duration_s:.2f} s: it is not this "
            "song, or not all of it"
        )


def _in_time(score_duration_s: float, song_duration_s: float) -> Alignment:
    """Score and song go alike, and that is sure."""
    end_s = min(score_duration_s, song_duration_s)
    points = (MapPoint(0.0, 0.0, 1.0), MapPoint(end_s, end_s, 1.0))
    return Alignment(points, score_duration_s, song_duration_s)


def _write_show(folder: Path, kept: ShowRevision) -> None:
    write_durably(folder / SHOW, kept.text.text())


def _role_of_file(path: Path) -> Role | None:
    with path.open("rb") as file:
        return role_of(file.read(LOOKED_AT_BYTES)).role
