"""Reads and plans sessions: of what was sent, of what is kept, and anew where another cast is to play."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from reina.errors import InputError
from reina.music import ScoreError
from reina.sessions.description import warned
from reina.sessions.file_role import LOOKED_AT_BYTES, OTHER_JSON, SHOW, Role, role_of
from reina.sessions.record import SessionRecord, SongRecord, StanceRecord, created_now, new_id
from reina.sessions.session import note_messages
from reina.sessions.show_revision import ShowRevision
from reina.sessions.storage.errors import DatabaseError, SessionDamagedError
from reina.show import ShowError
from reina.skeleton import pose_of
from reina.sound.alignment.alignment import Alignment, MapPoint
from reina.sound.recording.as_flac import SUFFIX as FLAC_SUFFIX
from reina.sound.recording.peaks import peaks_path
from reina.sound.recording.probe import Conversion

if TYPE_CHECKING:
    from reina.instruments import Cast
    from reina.sessions.draft import Draft
    from reina.sessions.note_messages import NoteMessages
    from reina.sessions.production import Production
    from reina.sessions.session import Session
    from reina.sessions.storage.session_storage import SessionStorage
    from reina.sessions.workers.reader import Reader
    from reina.sound.recording.decoder import SongDecoder

SCORE = "score"
"""What a session calls its score's file."""

Stances = tuple[StanceRecord, ...]


@dataclass(frozen=True)
class ReadDraft:
    """A draft that can be made a session of.

    Attributes:
        draft: What was sent.
        production: How its score is played.
        revision: The show around it.
        song: The recording, where there is one.
        alignment: Where the score is heard in it, where that need not be looked for.
    """

    draft: Draft
    production: Production
    revision: ShowRevision
    song: SongRecord | None
    alignment: Alignment | None

    @property
    def weight(self) -> int:
        """About how many bytes the session will take in memory."""
        return self.production.weight + self.revision.weight


@dataclass(frozen=True)
class ReadSession:
    """What a session is made of that is kept.

    Attributes:
        record: What is known of it.
        production: How its score is played.
        revision: The show around it.
        notes: What is told of its notes while they are played.
        alignment: Where the score is heard in the song, as far as that is known.
        song: Where the recording is, where there is one.
        version: How often it was changed.
    """

    record: SessionRecord
    production: Production
    revision: ShowRevision
    notes: NoteMessages
    alignment: Alignment | None
    song: Path | None
    version: int = 0

    @property
    def weight(self) -> int:
        """About how many bytes the session will take in memory."""
        return self.production.weight + self.revision.weight


class SessionReading:
    """Reads and plans sessions; what takes long is done on threads and in processes.

    Args:
        storage: Keeps them.
        reader: Reads scores and shows.
        decoder: Tells what uploaded songs are.
    """

    def __init__(self, storage: SessionStorage, reader: Reader, decoder: SongDecoder) -> None:
        self._storage = storage
        self._reader = reader
        self._decoder = decoder

    async def draft(self, draft: Draft) -> ReadDraft:
        """Read what was sent.

        Raises:
            InputError: Score, song or show cannot be used.
        """
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
                show = await self._reader.show(data, production.registry, owner=draft.sender)
            except ShowError as error:
                sent = await asyncio.to_thread(role_of, data)
                if sent in {SHOW, OTHER_JSON}:
                    raise
                raise ShowError(f"this is {sent.name}, not a show") from error
            await asyncio.to_thread(show_file.unlink)
            production = await asyncio.to_thread(production.with_show, show)
        kept = await asyncio.to_thread(ShowRevision.begin, production.show)
        in_time: Alignment | None = None
        if draft.in_time and song is not None and song.duration_s is not None:
            in_time = _in_time(production.score.duration_s, song.duration_s)
        return ReadDraft(draft, production, kept, song, in_time)

    def keep(self, read: ReadDraft, token_sha256: str) -> ReadSession:
        """Keep a draft as a session; takes a while.

        Args:
            read: The draft; its files become the session's.
            token_sha256: Of the control token.
        """
        draft, production, song = read.draft, read.production, read.song
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
            names = (song.file, song.original, peaks_name(song))
            files = {name: draft.folder / name for name in names if name is not None}
            staged |= {name: file for name, file in files.items() if file.is_file()}
        record = self._storage.add(record, staged, read.revision.text, read.alignment)
        return ReadSession(record, production, read.revision, notes, read.alignment, self._song_path(record))

    async def kept(self, session_id: str) -> ReadSession | None:
        """Read a session that is kept; None where none is of that name.

        Raises:
            SessionDamagedError: It cannot be read.
        """
        kept = await asyncio.to_thread(self._storage.read, session_id)
        if kept is None:
            return None
        record, alignment = kept.record, kept.alignment
        try:
            song = await asyncio.to_thread(self._song_path, record)
            planned = await self._plan(
                await self.score_file(record),
                record.score_filename,
                record.cast,
                alignment,
                record.stances,
                owner=session_id,
            )
            show = await self._reader.show(kept.show.text, planned.registry, owner=session_id)
        except (DatabaseError, SessionDamagedError):
            raise
        except (InputError, FileNotFoundError) as error:
            # It was fine when it was made; or a file went since it was asked for.
            raise SessionDamagedError(session_id, str(error), record.token_sha256) from error

        def prepared() -> ReadSession:
            production = planned.with_show(show)
            revision = ShowRevision.begin(
                show, earlier=kept.show.earlier, later=kept.show.later, weights=kept.show.weights
            )
            notes = note_messages(production)
            return ReadSession(record, production, revision, notes, alignment, song, kept.version)

        return await asyncio.to_thread(prepared)

    async def other(
        self, session: Session, wanted: Cast, alignment: Alignment | None, stances: Stances
    ) -> tuple[Production, ShowRevision]:
        """Plan another cast, or the same heard elsewhere or with other stances, in place of the session's.

        Raises:
            InputError: The cast names what there is not.
        """
        before, kept = session.production, session.show_revision
        planned = await self._plan(
            await self.score_file(session.record),
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
        return planned, kept

    async def score_file(self, record: SessionRecord) -> Path:
        """The file that a session was made of, as it was sent.

        Raises:
            SessionDamagedError: It is lost.
        """
        return await asyncio.to_thread(self._storage.file, record, SCORE)

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
        return await self._reader.production(
            score,
            filename=filename,
            cast=cast,
            alignment=heard,
            stances=poses,
            transposition=0 if heard is None else heard.played_higher,
            owner=owner,
        )

    async def _keep_song(self, uploaded: Path) -> SongRecord:
        """Have a song decoded, and give it the name that its format has; its peaks stand beside it.

        What most browsers do not play is served as FLAC; the file as it came is kept.
        """
        served = uploaded.with_name(f"song{FLAC_SUFFIX}")
        info = await self._decoder.probe(uploaded, Conversion(served))
        song = uploaded.with_name(f"{'original' if info.is_converted else 'song'}{info.suffix}")
        await asyncio.to_thread(uploaded.rename, song)
        return SongRecord(
            file=served.name if info.is_converted else song.name,
            media_type=info.media_type,
            duration_s=info.duration_s,
            warnings=tuple(warned(info.warnings)),
            original=song.name if info.is_converted else None,
        )

    def _song_path(self, record: SessionRecord) -> Path | None:
        return None if record.song is None else self._storage.file(record, record.song.file)


def peaks_name(song: SongRecord) -> str:
    """What a session calls the peaks of its recording."""
    return peaks_path(Path(song.file).with_stem("song")).name


def _in_time(score_duration_s: float, song_duration_s: float) -> Alignment:
    """Score and song go alike, and that is sure."""
    end_s = min(score_duration_s, song_duration_s)
    points = (MapPoint(0.0, 0.0, 1.0), MapPoint(end_s, end_s, 1.0))
    return Alignment(points, score_duration_s, song_duration_s)


def _role_of_file(path: Path) -> Role | None:
    with path.open("rb") as file:
        return role_of(file.read(LOOKED_AT_BYTES)).role
