"""Sessions as they are kept: in a database, with their files in a file store."""

from __future__ import annotations

import secrets
import shutil
import time
import zlib
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from pydantic import ValidationError
from sqlalchemy import delete, func, insert, select, update

from reina.errors import InputError
from reina.sessions.record import SESSION_ID, SessionRecord, with_files
from reina.sessions.storage.database import Database, database_url
from reina.sessions.storage.errors import ChangedElsewhereError, SessionDamagedError, SessionGoneError
from reina.sessions.storage.file_store import StoredFileLostError, StoreFullError
from reina.sessions.storage.held_files import HeldFiles
from reina.sessions.storage.open_files import files_at
from reina.sessions.storage.schema import ALIGNMENTS, SESSION_FILES, SESSIONS
from reina.sessions.storage.show_pieces import ShowUnreadableError, show_text, state_of, state_of_text
from reina.sessions.storage.show_rows import (
    KeptShow,
    Moved,
    add_show,
    append_state,
    moved_by,
    read_show,
    read_state,
)
from reina.sessions.usage import Usage
from reina.sound.alignment.document import read_alignment, write_alignment
from reina.system.reserve import Reserve

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping
    from pathlib import Path

    from sqlalchemy import Connection

    from reina.sessions.show_revision import ShowRevision
    from reina.sessions.show_text import ShowText
    from reina.sessions.storage.file_store import FileStore
    from reina.sound.alignment.alignment import Alignment

STAGING, SONGS = "staging", "songs"
"""Folders of the data directory: of uploads under way, of rendered songs."""
AT_ONCE = 500
"""So many ids are asked for in one statement."""
UNCHANGED: Literal["unchanged"] = "unchanged"


@dataclass(frozen=True)
class KeptSession:
    """A session as it was read."""

    record: SessionRecord
    show: KeptShow
    alignment: Alignment | None
    version: int


@dataclass(frozen=True)
class Listed:
    """What the list of sessions says of one.

    Attributes:
        id: Its id.
        title: Its title.
        created_at: ISO 8601, UTC.
    """

    id: str
    title: str
    created_at: str


@dataclass(frozen=True)
class ShowChange:
    """A step of a show that is to be kept: from one revision to the next."""

    before: ShowRevision
    after: ShowRevision


class SessionStorage:
    """Everything that is kept of all sessions. Its methods block: they are for threads.

    A session is there as a whole or not at all: its files are kept first, then one transaction names them.
    What a method has written when it returns survives a power cut.

    Args:
        data_dir: Holds what is under way, rendered songs, and what has no other place.
        database: Holds records and shows.
        files: Holds scores and songs.

    Raises:
        DatabaseError: The database cannot be used.
    """

    def __init__(self, data_dir: Path, database: Database, files: FileStore) -> None:
        self.data_dir = data_dir
        self._database = database
        self._store = files
        self._files = HeldFiles(files, self._is_named, database.file_locks)
        self._staging = data_dir / STAGING
        shutil.rmtree(self._staging, ignore_errors=True)
        for folder in (self._staging, data_dir / SONGS):
            folder.mkdir(parents=True, exist_ok=True, mode=0o700)
            folder.chmod(0o700)
        self._reserve = Reserve(data_dir)

    @classmethod
    def open(cls, data_dir: Path, database: str = "", files: FileStore | str | None = None) -> SessionStorage:
        """Open what is kept in a data directory, which is made if need be.

        Args:
            data_dir: The directory.
            database: The address of another database than the embedded one.
            files: Another file store than a folder of the directory, or its address as of `files_at`.

        Raises:
            DatabaseError: The database cannot be used.
            InputError: The file store cannot.
        """
        data_dir.mkdir(parents=True, exist_ok=True, mode=0o700)
        store = files_at(files, data_dir) if files is None or isinstance(files, str) else files
        return cls(data_dir, Database(database_url(data_dir, database)), store)

    def close(self) -> None:
        """Give back what is open."""
        self._database.close()

    def check(self) -> None:
        """See that the database answers.

        Raises:
            DatabaseError: It does not.
        """
        with self._database.reading() as connection:
            connection.execute(select(1)).scalar_one()

    # What is under way

    def stage(self) -> Path:
        """A new folder to make a session in; whoever asked for it removes it."""
        folder = self._staging / secrets.token_hex(16)
        folder.mkdir(mode=0o700)
        return folder

    # One session

    def __contains__(self, session_id: str) -> bool:
        if not SESSION_ID.fullmatch(session_id):
            return False
        with self._database.reading() as connection:
            asked = select(SESSIONS.c.id).where(SESSIONS.c.id == session_id)
            return connection.execute(asked).first() is not None

    def add(
        self,
        record: SessionRecord,
        staged: Mapping[str, Path],
        show: ShowText | bytes,
        alignment: Alignment | bytes | None = None,
    ) -> SessionRecord:
        """Keep a new session.

        Args:
            record: What is known of it.
            staged: Its files by name; they may be gone afterwards.
            show: Its show, or the text of one, which is kept as it is.
            alignment: Where its score is heard in its song, or the text of it.

        Returns:
            The record with its files.

        Raises:
            StoreFullError: There is no room; nothing is kept then.
            DatabaseAwayError: The database does not answer; nothing is kept then.
        """
        state, tracks = state_of_text(show) if isinstance(show, bytes) else state_of(show)
        with self._files.keep(staged) as kept:
            record = with_files(record, kept)
            with self._database.writing() as connection:
                connection.execute(
                    insert(SESSIONS).values(
                        show_bytes=0,
                        show_state=0,
                        seen_at=time.time(),
                        **_columns(record),
                    )
                )
                _name_files(connection, record)
                size = add_show(connection, record.id, state, tracks)
                connection.execute(update(SESSIONS).where(SESSIONS.c.id == record.id).values(show_bytes=size))
                _write_alignment(connection, record.id, alignment)
        return record

    def version(self, session_id: str) -> int | None:
        """How often a session was changed; None where there is none."""
        with self._database.reading() as connection:
            return connection.execute(select(SESSIONS.c.version).where(SESSIONS.c.id == session_id)).scalar()

    def read(self, session_id: str, known: Collection[bytes] = ()) -> KeptSession | None:
        """Read a session; None where there is none.

        Args:
            session_id: Which.
            known: Digests of tracks whose texts are not wanted.

        Raises:
            SessionDamagedError: It is there, and cannot be read.
            DatabaseAwayError: The database does not answer.
        """
        if not SESSION_ID.fullmatch(session_id):
            return None
        with self._database.reading() as connection:
            row = connection.execute(
                select(SESSIONS.c.record, SESSIONS.c.token_sha256, SESSIONS.c.version).where(
                    SESSIONS.c.id == session_id
                )
            ).first()
            if row is None:
                return None
            try:
                record = SessionRecord.model_validate_json(row.record)
                if record.id != session_id:
                    raise ValueError("its record is another session's")  # noqa: TRY301
                show = read_show(connection, session_id, known)
                return KeptSession(record, show, _alignment(connection, session_id), row.version)
            except (ValueError, zlib.error, InputError) as error:
                raise SessionDamagedError(session_id, _why(error), row.token_sha256) from error

    def change(
        self,
        record: SessionRecord,
        *,
        show: ShowChange | None = None,
        alignment: Alignment | Literal["unchanged"] | None = UNCHANGED,
        staged: Mapping[str, Path] | None = None,
        version: int | None = None,
    ) -> SessionRecord:
        """Keep what has changed of a session, all of it or nothing; its version is one more then.

        Args:
            record: What is known of it now.
            show: What its show was and is.
            alignment: Where its score is heard in its song; None: that is not known any more.
            staged: Further files by name; they may be gone afterwards.
            version: The one that is changed; any when None.

        Returns:
            The record with its files.

        Raises:
            SessionGoneError: It is not there.
            ChangedElsewhereError: It has another version; nothing is changed then.
            SessionDamagedError: Its show is not there any more.
            StoreFullError: There is no room; nothing is changed then.
            DatabaseAwayError: The database does not answer; nothing is changed then.
        """
        if show is not None:
            # Tracks are cut before anybody has to wait for it.
            state_of(show.after.text)
        replaced = {file.digest for file in record.files if file.name in (staged or {})}
        with self._files.keep(staged or {}) as kept:
            record = with_files(record, kept)
            with self._database.writing() as connection:
                _next_version(connection, record.id, version)
                columns = _columns(record)
                if show is not None:
                    moved = _write_show(connection, record, show.before, show.after)
                    columns["show_state"] = moved.number
                    columns["show_bytes"] = SESSIONS.c.show_bytes + moved.more_bytes
                connection.execute(update(SESSIONS).where(SESSIONS.c.id == record.id).values(**columns))
                if kept:
                    connection.execute(delete(SESSION_FILES).where(SESSION_FILES.c.session_id == record.id))
                    _name_files(connection, record)
                if alignment != UNCHANGED:
                    _write_alignment(connection, record.id, alignment)
        if replaced:
            self._files.remove_unnamed(replaced)
        return record

    def keep_clock(self, record: SessionRecord, version: int) -> bool:
        """Keep where a session's clock stands; nobody has to take note of it.

        Args:
            record: What is known of it, with the clock.
            version: Which the rest of the record is of.

        Returns:
            False where it has another version, or is not there: nothing is kept then.
        """
        own = (SESSIONS.c.id == record.id) & (SESSIONS.c.version == version)
        with self._database.writing() as connection:
            row = update(SESSIONS).where(own).values(record=record.model_dump_json())
            return bool(connection.execute(row).rowcount)

    def state_beside(
        self, record: SessionRecord, steps: int, known: Mapping[bytes, object]
    ) -> tuple[bytes, tuple[bytes, ...]]:
        """Another state of a session's show than the present one.

        Args:
            record: Whose.
            steps: How far from the present one; negative: before it.
            known: Tracks by their digests that are at hand.

        Returns:
            The show as JSON with those of its tracks that are not at hand, and the digests of all.

        Raises:
            SessionDamagedError: It is not there, or not as it was.
        """
        try:
            with self._database.reading() as connection:
                state, texts = read_state(connection, record.id, steps, known)
        except ShowUnreadableError as error:
            raise SessionDamagedError(record.id, _why(error), record.token_sha256) from error
        return show_text(state, texts), () if state.head is None else state.tracks

    def file(self, record: SessionRecord, name: str) -> Path:
        """Where a file of a session can be read; nobody may write to it.

        Raises:
            SessionDamagedError: It is not there.
        """
        try:
            digest = next(file.digest for file in record.files if file.name == name)
            return self._store.path(digest)
        except (StopIteration, StoredFileLostError) as error:
            why = f"its file {name} is lost"
            raise SessionDamagedError(record.id, why, record.token_sha256) from error

    def remove(self, session_id: str) -> None:
        """Remove a session with everything of it; nothing happens where it is not there.

        A database on a full disk cannot even forget: it is given what is set aside for that.
        """
        try:
            self._remove(session_id)
        except StoreFullError:
            with self._reserve.given_up():
                self._remove(session_id)

    def _remove(self, session_id: str) -> None:
        with self._database.writing() as connection:
            asked = select(SESSION_FILES.c.digest).where(SESSION_FILES.c.session_id == session_id)
            digests = set(connection.execute(asked).scalars())
            connection.execute(delete(SESSIONS).where(SESSIONS.c.id == session_id))
        self._files.remove_unnamed(digests)

    # All sessions

    def page(
        self, limit: int, after: str | None = None, *, owner: str | None = None
    ) -> tuple[list[Listed], str | None]:
        """Some of the sessions that are listed, or of a person's, the newest first.

        Args:
            limit: How many at most.
            after: What the page before gave; None for the first page.
            owner: Whose, listed or not; None for those that are listed.

        Returns:
            The sessions, and what the next page is asked for with; None when there are no more.
        """
        place = SESSIONS.c.place
        wanted = SESSIONS.c.public if owner is None else SESSIONS.c.owner == _fit(owner)
        asked = select(SESSIONS.c.id, SESSIONS.c.title, SESSIONS.c.created_at, place).where(wanted)
        if after is not None:
            asked = asked.where(place < _fit(after))
        with self._database.reading() as connection:
            rows = connection.execute(asked.order_by(place.desc()).limit(limit + 1)).all()
        following = rows[limit - 1].place if limit and len(rows) > limit else None
        return [Listed(row.id, row.title, row.created_at) for row in rows[:limit]], following

    def usage(self, sender: str | None = None) -> Usage:
        """How much is kept, of one sender or of all."""
        size = func.coalesce(func.sum(SESSIONS.c.file_bytes + SESSIONS.c.show_bytes), 0)
        asked = select(func.count(), size)
        if sender is not None:
            asked = asked.where(SESSIONS.c.sender == _fit(sender))
        with self._database.reading() as connection:
            count, total = connection.execute(asked).one()
        return Usage(int(count), int(total))

    def note_seen(self, ids: Collection[str], when: float) -> None:
        """Note that sessions were watched or changed.

        Args:
            ids: Which.
            when: Seconds since 1970.
        """
        ordered = sorted(ids)
        with self._database.writing() as connection:
            for at in range(0, len(ordered), AT_ONCE):
                some = SESSIONS.c.id.in_(ordered[at : at + AT_ONCE])
                connection.execute(update(SESSIONS).where(some).values(seen_at=when))

    def seen_s(self, session_id: str) -> float | None:
        """When a session was seen last, seconds since 1970; None where there is none."""
        with self._database.reading() as connection:
            asked = select(SESSIONS.c.seen_at).where(SESSIONS.c.id == session_id)
            return connection.execute(asked).scalar()

    def unseen_since(self, when: float) -> list[str]:
        """Ids of the sessions that nobody has watched or changed since, those first that wait longest.

        Args:
            when: Seconds since 1970.
        """
        asked = select(SESSIONS.c.id).where(SESSIONS.c.seen_at < when).order_by(SESSIONS.c.seen_at)
        with self._database.reading() as connection:
            return list(connection.execute(asked).scalars())

    @property
    def is_shared(self) -> bool:
        """Whether other servers may write to the same database."""
        return not self._database.is_embedded

    def orphans(self) -> set[str]:
        """Files that no session names, as a server leaves them that ends in the middle of an upload."""
        with self._database.reading() as connection:
            named = set(connection.execute(select(SESSION_FILES.c.digest)).scalars())
        return {file.digest for file in self._store.files()} - named

    def remove_files(self, digests: set[str]) -> int:
        """Remove those of some files that no session names and nobody is about to.

        Returns:
            How many these were.
        """
        return self._files.remove_unnamed(digests)

    def _is_named(self, digest: str) -> bool:
        with self._database.reading() as connection:
            asked = select(SESSION_FILES.c.name).where(SESSION_FILES.c.digest == digest).limit(1)
            return connection.execute(asked).first() is not None


def _columns(record: SessionRecord) -> dict[str, object]:
    """A record's row, as far as it follows from the record."""
    place = f"{record.created_at.removesuffix('+00:00')}Z_{record.id}"
    return {
        "id": record.id,
        "record": record.model_dump_json(),
        "title": _fit(record.title),
        "public": record.public,
        "created_at": record.created_at,
        "token_sha256": record.token_sha256,
        "place": place,
        "owner": None if record.owner is None else _fit(record.owner),
        "sender": _fit(record.sender),
        "file_bytes": sum(file.size for file in record.files),
    }


def _next_version(connection: Connection, session_id: str, version: int | None) -> None:
    """Count a change; whoever changes the same session elsewhere waits for the end of this one.

    Raises:
        SessionGoneError: It is not there.
        ChangedElsewhereError: It has another version.
    """
    own = SESSIONS.c.id == session_id
    wanted = own if version is None else own & (SESSIONS.c.version == version)
    if connection.execute(update(SESSIONS).where(wanted).values(version=SESSIONS.c.version + 1)).rowcount:
        return
    if connection.execute(select(SESSIONS.c.id).where(own)).first() is None:
        raise SessionGoneError(f"the session {session_id!r} was ended meanwhile")
    raise ChangedElsewhereError(f"the session {session_id!r} was changed on another server; try again")


def _fit(text: str) -> str:
    """A text that every database takes: without NUL, and without half a character."""
    return text.replace("\0", "�").encode("utf-8", "replace").decode()


def _name_files(connection: Connection, record: SessionRecord) -> None:
    if record.files:
        rows = [{"session_id": record.id, **file.model_dump()} for file in record.files]
        connection.execute(insert(SESSION_FILES), rows)


def _write_show(
    connection: Connection, record: SessionRecord, before: ShowRevision, after: ShowRevision
) -> Moved:
    try:
        steps = after.steps_from(before)
        if steps:
            return moved_by(connection, record.id, steps)
        state, tracks = state_of(after.text)
        weight, is_last = after.weights[-1] if after.weights else 0, not before.undone
        return append_state(
            connection, record.id, state, tracks, weight=weight, kept=after.done, is_last=is_last
        )
    except ShowUnreadableError as error:
        raise SessionDamagedError(record.id, _why(error), record.token_sha256) from error


def _write_alignment(connection: Connection, session_id: str, alignment: Alignment | bytes | None) -> None:
    connection.execute(delete(ALIGNMENTS).where(ALIGNMENTS.c.session_id == session_id))
    if alignment is not None:
        text = alignment if isinstance(alignment, bytes) else write_alignment(alignment)
        connection.execute(insert(ALIGNMENTS).values(session_id=session_id, data=zlib.compress(text)))


def _alignment(connection: Connection, session_id: str) -> Alignment | None:
    asked = select(ALIGNMENTS.c.data).where(ALIGNMENTS.c.session_id == session_id)
    data = connection.execute(asked).scalar()
    return None if data is None else read_alignment(zlib.decompress(data))


def _why(error: Exception) -> str:
    if isinstance(error, ValidationError):
        fault = error.errors()[0]
        place = "/".join(map(str, fault["loc"]))
        return (
            f"its record does not fit at {place}: {fault['msg']}" if place else f"its record: {fault['msg']}"
        )
    return str(error)
