"""All sessions of a server: a bounded number in memory, all of them in storage."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import shutil
import time
from collections import OrderedDict
from contextlib import asynccontextmanager, contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeVar

from reina.errors import InputError
from reina.instruments import Cast
from reina.music import ScoreError
from reina.sessions.clock_keeping import ClockKeeping
from reina.sessions.description import warned
from reina.sessions.file_role import LOOKED_AT_BYTES, OTHER_JSON, Role, role_of
from reina.sessions.file_role import SHOW as SHOW_DOCUMENT
from reina.sessions.memory_bound import MEMORY_BYTES, MemoryBound
from reina.sessions.record import SessionRecord, SongRecord, StanceRecord, created_now, new_id
from reina.sessions.session import Session, note_messages
from reina.sessions.show_revision import ShowRevision
from reina.sessions.sightings import Sightings, near_end
from reina.sessions.sleeping_show import known_tracks, wake
from reina.sessions.song import RenderedSong, Song, UploadedSong
from reina.sessions.staging import STAGING_BYTES, StagingRoom
from reina.sessions.storage.errors import DatabaseError, SessionDamagedError, SessionGoneError
from reina.sessions.storage.session_storage import UNCHANGED, SessionStorage, ShowChange
from reina.sessions.usage import DiskBound
from reina.sessions.workers.reader import Reader
from reina.show import ShowError
from reina.skeleton import pose_of
from reina.sound.alignment.aligner_process import Aligner
from reina.sound.alignment.alignment import Alignment, MapPoint
from reina.sound.recording.as_flac import SUFFIX as FLAC_SUFFIX
from reina.sound.recording.decoder import SongDecoder
from reina.sound.recording.peaks import Peaks, peaks_path, read_peaks
from reina.sound.recording.probe import Conversion
from reina.system.tokens import hash_token, new_token

if TYPE_CHECKING:
    from collections.abc import AsyncGenerator, Awaitable, Callable, Coroutine, Generator, Iterable

    from reina.sessions.note_messages import NoteMessages
    from reina.sessions.production import Production
    from reina.sessions.stage import Stage
    from reina.sessions.storage.session_storage import Listed
    from reina.sessions.usage import Usage
    from reina.show import Show, ShowHistory
    from reina.sound.hearing import Hearing
    from reina.sound.recording.probe import AudioInfo
    from reina.sound.renderer import SongRenderer

SHARED_GRACE_S = 600.0
"""Where other servers write to the same database, a file that no session has is left for so long."""
SCORE = "score"
"""What a session calls its score's file."""

T = TypeVar("T")
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


@dataclass(frozen=True)
class _Read:
    """What a session is made of."""

    record: SessionRecord
    production: Production
    revision: ShowRevision
    notes: NoteMessages
    alignment: Alignment | None
    song: Path | None
    """The recording, where there is one."""


class SessionStore:
    """Makes, finds, keeps and ends sessions.

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
    ) -> None:
        self.stage = stage
        self.reader = reader or Reader(stage)
        self.decoder = decoder or SongDecoder()
        self.storage = storage if isinstance(storage, SessionStorage) else SessionStorage.open(storage)
        """Everything that is kept of them."""
        self._renderer = renderer
        renderer.cache.in_use = self._listened_to
        self._aligner = aligner or Aligner()
        self._blocks_origin = blocks_origin
        self._now = now
        self._wall = wall
        self._bound = MemoryBound(loaded, memory_bytes)
        self._coming = 0
        self._disk = disk or DiskBound()
        self.staged = StagingRoom(staging_bytes)
        """What is being sent."""
        self._clocks = ClockKeeping(self._keep_clock)
        self.sightings = Sightings(self.storage, wall=wall)
        """When sessions were seen."""
        self._pruning: set[asyncio.Task[None]] = set()
        self._sessions: OrderedDict[str, Session] = OrderedDict()
        self._loading: dict[str, asyncio.Task[Session | None]] = {}
        self._putting_away: dict[str, asyncio.Task[None]] = {}
        self._collecting: asyncio.Task[None] | None = None

    def begin(self) -> None:
        """Begin what goes on in the background: what an earlier server left half done is removed."""
        self._collecting = asyncio.create_task(self._remove_orphans())

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

    async def check(self) -> None:
        """See that what keeps the sessions answers.

        Raises:
            DatabaseError: It does not.
        """
        await asyncio.to_thread(self.storage.check)

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

    @property
    def watched(self) -> list[str]:
        """The ids of those that somebody watches."""
        return [session.id for session in self._sessions.values() if len(session.audience)]

    async def end_unseen(self, after_s: float) -> int:
        """End the sessions that nobody has seen for so long, seconds; returns how many."""
        await self.sightings.keep(self.watched)
        ended, since_s = 0, self._wall() - after_s
        for session_id in await asyncio.to_thread(self.storage.unseen_since, since_s):
            loaded = self._sessions.get(session_id)
            if loaded is None and session_id not in self._loading:
                await _to_the_end(asyncio.to_thread(self.storage.remove, session_id))
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
        folder = await asyncio.to_thread(self.storage.stage)
        self.staged.begin(folder, sender)
        return folder

    async def discard_staged(self, folder: Path) -> None:
        """Remove a folder of `staging_folder`, if it is still there."""
        await asyncio.to_thread(shutil.rmtree, folder, ignore_errors=True)
        self.staged.end(folder)

    async def usage(self, sender: str | None) -> Usage:
        """How many sessions came from a sender, or from all (None), and how large they are."""
        return await asyncio.to_thread(self.storage.usage, sender)

    async def require_disk(self, sender: str, adding: int = 0) -> None:
        """See that another session of a sender may be kept; what the sender is sending counts too.

        Raises:
            LimitError: It may not.
        """
        sending = self.staged.of(sender) if sender else 0
        await asyncio.to_thread(self._disk.require, self.storage.usage, sender, max(adding, sending))

    async def create(self, draft: Draft) -> tuple[Session, str]:
        """Make a session.

        Returns:
            The session, and its control token, which is not kept.

        Raises:
            InputError: Score, song or show cannot be used; nothing of the draft is kept then.
        """
        token = new_token()
        await self.require_disk(draft.sender, self.staged.size(draft.folder))
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
        in_time: Alignment | None = None
        if draft.in_time and song is not None and song.duration_s is not None:
            in_time = _in_time(production.score.duration_s, song.duration_s)

        async def make() -> Session:
            await self._clocks.written()
            with self._room_for(production.weight + kept.weight):
                token_sha256 = hash_token(token)
                made = await asyncio.to_thread(
                    self._make, draft, production, kept, song, in_time, token_sha256
                )
            return self._admit(made)

        session = await _to_the_end(make())
        if in_time is None:
            self.search_alignment(session)
        return session, token

    async def get(self, session_id: str) -> Session | None:
        """A session, loaded if need be; None where there is none.

        Raises:
            SessionDamagedError: It is kept, and cannot be read.
            DatabaseAwayError: What keeps it does not answer.
        """
        session = self._sessions.get(session_id)
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
        self._sessions.move_to_end(session_id)
        return session

    async def listed(
        self, limit: int, after: str | None = None, *, owner: str | None = None
    ) -> tuple[list[Listed], str | None]:
        """Some of the sessions that are listed, or of a person's, newest first; see `SessionStorage.page`."""
        return await asyncio.to_thread(self.storage.page, limit, after, owner=owner)

    async def renew_token(self, session: Session) -> str:
        """Give a session another control token, in place of the one before; returns it, which is not kept."""
        token = new_token()
        async with self._edit(session):
            record = session.record.model_copy(update={"token_sha256": hash_token(token)})
            await self._keep(session, record)
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
            record, before = session.record.model_copy(update=changes), session.show_revision
            wanted = recast(record.cast) if recast else record.cast
            stances = restance(record.stances) if restance else record.stances
            if wanted == record.cast and stances == record.stances:
                # Neither frames nor sound know of it.
                await self._keep(session, record)
                return
            another_piece = wanted.sequence not in {None, session.production.score.sequence}
            # Another piece is heard elsewhere, if at all.
            alignment = None if another_piece else session.alignment.alignment
            production, kept = await self._plan_other(session, wanted, alignment, stances)
            titles = session.production.score.title, production.score.title
            titled = {"title": titles[1]} if title is None and record.title == titles[0] else {}
            record = record.model_copy(update={"cast": production.cast, "stances": stances, **titled})

            async def show(record: SessionRecord) -> None:
                await session.change_cast(record, production)
                if kept is not before:
                    await session.change_show(production, kept)
                if another_piece:
                    session.alignment.alignment = None
                    self.search_alignment(session)

            heard = None if another_piece else UNCHANGED
            await self._keep(session, record, kept, heard, show=show)

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
                async def tell(_: SessionRecord) -> None:
                    session.alignment.alignment = alignment
                    session.tell_alignment()

                await self._keep(session, session.record, alignment=alignment, show=tell)
                return
            production, kept = await self._plan_other(
                session, session.record.cast, alignment, session.record.stances
            )

            async def show(_: SessionRecord) -> None:
                await session.change_alignment(production, kept, alignment)

            await self._keep(session, session.record, kept, alignment, show=show)

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
            lambda: self.storage.file(session.record, song.heard or song.file),
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
            record = session.record.model_copy(
                update={"song": song.model_copy(update={"heard": heard.name, "duration_s": info.duration_s})}
            )

            async def show(record: SessionRecord) -> None:
                session.alignment.is_heard = True
                await session.change_cast(record, session.production)

            staged = {heard.name: heard, _peaks_name(song): peaks_path(sent)}
            await self._keep(session, record, staged=staged, show=show)
        self.search_alignment(session)

    async def peaks(self, session: Session) -> Peaks | None:
        """The peaks of a session's recording, decoded where they are not kept; None where they cannot be.

        Raises:
            InputError: It cannot be decoded any more.
        """
        song = session.record.song
        if song is None:
            return None
        name = _peaks_name(song)
        with contextlib.suppress(SessionDamagedError):
            return await asyncio.to_thread(lambda: read_peaks(self.storage.file(session.record, name)))
        if not song.is_heard:
            return None
        async with self.staging() as folder:
            # What is decoded is written beside what looks like the file.
            link = folder / (song.heard or song.file)
            path = await asyncio.to_thread(self.storage.file, session.record, link.name)
            await asyncio.to_thread(link.symlink_to, path.absolute())
            await self.decoder.probe(link)
            peaks = await asyncio.to_thread(read_peaks, peaks_path(link))
            if peaks is not None:
                async with self._edit(session):
                    await self._keep(session, session.record, staged={name: peaks_path(link)})
        return peaks

    async def change_show(self, session: Session, step: Callable[[ShowHistory], ShowHistory]) -> ShowRevision:
        """Take a session's show one step on or back, and keep it; edits of a session follow one another.

        Args:
            session: Whose.
            step: The history as it is -> as it is to be; runs on a thread. What it raises is raised on, and
                nothing is changed then.
        """
        async with self._edit(session):
            await self._wake(session)
            kept = await asyncio.to_thread(session.show_revision.then, step)
            if kept is not session.show_revision:
                production = await asyncio.to_thread(session.production.with_show, kept.show)
                self._make_room(kept.weight - session.show_revision.weight, staying=session)

                async def show(_: SessionRecord) -> None:
                    await session.change_show(production, kept)

                await self._keep(session, session.record, kept, show=show)
        return kept

    async def song_file(self, session: Session, *, is_original: bool = False) -> Path | None:
        """The recording of a session, or what it was sent as; None where there is none.

        Raises:
            SessionDamagedError: The file is lost.
        """
        song = session.record.song
        if song is None:
            return None
        name = (song.original or song.file) if is_original else song.file
        return await asyncio.to_thread(self.storage.file, session.record, name)

    async def score_file(self, session: Session) -> Path:
        """The file that a session was made of, as it was sent.

        Raises:
            SessionDamagedError: It is lost.
        """
        return await asyncio.to_thread(self.storage.file, session.record, SCORE)

    async def delete(self, session: Session) -> None:
        """End a session and remove everything of it.

        The song that was rendered for it goes too, unless a session that is loaded has the same; one that is
        not will have it rendered anew.
        """
        async with self._edit(session):

            async def remove() -> set[Path]:
                await asyncio.to_thread(self.storage.remove, session.id)
                return self._forget(session)

            songs = await _to_the_end(remove())
        if session.record.song is None and session.song.path is not None:
            songs.add(session.song.path)
        for path in songs - self.songs_in_use():
            await asyncio.to_thread(self._renderer.discard, path)

    async def delete_damaged(self, damaged: SessionDamagedError) -> None:
        """End a session that cannot be read, and remove everything of it."""
        await _to_the_end(asyncio.to_thread(self.storage.remove, damaged.session_id))

    async def prune_songs(self) -> None:
        """Remove the rendered songs that were not asked for the longest until the rest is small enough."""
        freed = await asyncio.to_thread(self._renderer.prune, in_use=self._listened_to())
        if freed:
            _log.info("removed %.0f MB of rendered songs", freed / 1e6)

    async def aclose(self) -> None:
        """Put every session away."""
        if self._collecting is not None:
            self._collecting.cancel()
            await asyncio.wait([self._collecting])
        await self._clocks.aclose()
        try:
            await self.sightings.keep(self.watched)
        except InputError as error:
            _log.warning("when sessions were seen is not kept: %s", error)
        for session in list(self._sessions.values()):
            self._unload(session)
        await self._renderer.aclose()
        await self._aligner.aclose()
        await self.reader.aclose()
        for tasks in (self._pruning, self._putting_away.values()):
            if tasks:
                await asyncio.wait(tasks)
        await asyncio.to_thread(self.storage.close)

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
        alignment: Alignment | None,
        token_sha256: str,
    ) -> _Read:
        notes = note_messages(production)
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
        staged = {SCORE: draft.folder / draft.score}
        if song is not None:
            names = (song.file, song.original, _peaks_name(song))
            files = {name: draft.folder / name for name in names if name is not None}
            staged |= {name: file for name, file in files.items() if file.is_file()}
        record = self.storage.add(record, staged, kept.text, alignment)
        return _Read(record, production, kept, notes, alignment, self._song_path(record))

    def _song_path(self, record: SessionRecord) -> Path | None:
        return None if record.song is None else self.storage.file(record, record.song.file)

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

    async def _keep(
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
            session: Which; it is held by `_edit`.
            record: Its record.
            revision: Its show.
            alignment: Where its score is heard.
            staged: Further files.
            show: Lets it be seen; called with the record as it is kept.

        Raises:
            SessionEndedError: It is not there any more.
        """
        before = session.show_revision
        change = None if revision is None or revision is before else ShowChange(before, revision)

        def write() -> SessionRecord:
            return self.storage.change(record, show=change, alignment=alignment, staged=staged)

        async def keep() -> None:
            kept = await asyncio.to_thread(write)
            if show is not None:
                await show(kept)
            session.record = kept

        try:
            await _to_the_end(keep())
        except SessionGoneError as error:
            self._forget(session)
            raise SessionEndedError(str(error)) from error

    def _forget(self, session: Session) -> set[Path]:
        """Let a session go that is not kept any more; returns the songs that were made for its viewers."""
        self._sessions.pop(session.id, None)
        songs = session.heard.paths
        session.close()
        return songs

    async def _wake(self, session: Session) -> None:
        """Have the states at hand that undo and redo lead to; the session is held by `_edit`."""
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
                    self.storage.state_beside, session.record, steps, at_hand
                )
                read = await self.reader.show(data, registry, owner=session.id)
                # Tracks say the unit of their times only where it is not the show's.
                if read.time == text.show.time or not at_hand:
                    return await asyncio.to_thread(wake, read, digests if at_hand else (), text)
        except (SessionDamagedError, ShowError) as error:
            _log.warning("session %s: what its show was is not to be had any more: %s", session.id, error)
        return None

    async def _load(self, session_id: str) -> Session | None:
        # What was kept of it last is what is read.
        if session_id in self._putting_away:
            await asyncio.wait([self._putting_away[session_id]])
        try:
            read = await self._read(session_id)
        except SessionDamagedError:
            if await asyncio.to_thread(self.storage.__contains__, session_id):
                raise
            # Nothing is damaged: it was ended meanwhile.
            return None
        await self._clocks.written()
        # Ended while it was read: it must not come back.
        if read is None or not await asyncio.to_thread(self.storage.__contains__, session_id):
            return None
        session = self._admit(read)
        if read.alignment is None:
            # It was still being looked for when the server ended.
            self.search_alignment(session)
        return session

    async def _read(self, session_id: str) -> _Read | None:
        kept = await asyncio.to_thread(self.storage.read, session_id)
        if kept is None:
            return None
        record, alignment = kept.record, kept.alignment
        try:
            song = await asyncio.to_thread(self._song_path, record)
            score = await asyncio.to_thread(self.storage.file, record, SCORE)
            planned = await self._plan(
                score, record.score_filename, record.cast, alignment, record.stances, owner=session_id
            )
            show = await self.reader.show(kept.show.text, planned.registry, owner=session_id)
        except (DatabaseError, SessionDamagedError):
            raise
        except (InputError, FileNotFoundError) as error:
            # It was fine when it was made; or a file went since it was asked for.
            raise SessionDamagedError(session_id, str(error), record.token_sha256) from error

        def prepared() -> _Read:
            production = planned.with_show(show)
            revision = ShowRevision.begin(
                show, earlier=kept.show.earlier, later=kept.show.later, weights=kept.show.weights
            )
            return _Read(record, production, revision, note_messages(production), alignment, song)

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
        planned = await self._plan(
            await self.score_file(session),
            session.record.score_filename,
            wanted,
            alignment,
            stances,
            owner=session.id,
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

    def _admit(self, read: _Read) -> Session:
        self._make_room(read.production.weight + read.revision.weight)
        session = Session(
            read.record,
            read.production,
            read.revision,
            read.notes,
            lambda session: self._song(session, read.song),
            self._heard,
            now=self._now,
            wall=self._wall,
            alignment=read.alignment,
            clock_changed=self._clocks.note,
            blocks_origin=self._blocks_origin,
        )
        self._sessions[session.id] = session
        return session

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

    def songs_in_use(self) -> set[Path]:
        """Files of songs that sessions have open, as everybody and as single viewers hear them."""
        return self._songs_of(self._sessions.values())

    def _listened_to(self) -> set[Path]:
        """Files of songs of sessions that somebody watches."""
        return self._songs_of(session for session in self._sessions.values() if len(session.audience))

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
                await asyncio.to_thread(self.storage.change, record)
                session.is_kept(record)

    def _unload(self, session: Session) -> None:
        del self._sessions[session.id]
        record = session.kept()
        session.close()
        if record != session.record:
            writing = asyncio.create_task(self._put_away(record))
            self._putting_away[session.id] = writing
            writing.add_done_callback(lambda _: self._putting_away.pop(session.id, None))

    async def _put_away(self, record: SessionRecord) -> None:
        try:
            await asyncio.to_thread(self.storage.change, record)
        except InputError as error:
            _log.warning("session %s: where its clock stood is not kept: %s", record.id, error)


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


def _peaks_name(song: SongRecord) -> str:
    """What a session calls the peaks of its recording."""
    return peaks_path(Path(song.file).with_stem("song")).name


async def _to_the_end(work: Coroutine[Any, Any, T]) -> T:
    """Have something done that must not stop half-way: whoever gives up waits for its end, too."""
    task = asyncio.ensure_future(work)
    try:
        return await asyncio.shield(task)
    except asyncio.CancelledError:
        while not task.done():
            with contextlib.suppress(asyncio.CancelledError):
                await asyncio.wait([task])
        if not task.cancelled():
            task.exception()
        raise


def _role_of_file(path: Path) -> Role | None:
    with path.open("rb") as file:
        return role_of(file.read(LOOKED_AT_BYTES)).role
