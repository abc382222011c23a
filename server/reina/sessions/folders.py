"""Sessions on disk: one folder each, which is there as a whole or not at all."""

from __future__ import annotations

import os
import secrets
import shutil
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING

from reina.sessions.record import SESSION_ID, SessionRecord
from reina.sessions.session_index import INDEX, Entry, SessionIndex
from reina.sound.alignment.document import read_alignment, write_alignment
from reina.system.durable import make_folder, sync, write_durably

if TYPE_CHECKING:
    from collections.abc import Generator, Iterable
    from pathlib import Path

    from reina.sessions.usage import Usage
    from reina.sound.alignment.alignment import Alignment

RECORD = "session.json"
SCORE = "score"
SHOW = "show.json"
ALIGNMENT = "alignment.json"
SEEN = "seen"
"""An empty file; it was written last when the session was seen last."""


class SessionFolders:
    """The data directory.

    A session is made in `staging` and renamed into `sessions` when it is whole; it is renamed back out before
    it is deleted. Files are replaced by renaming. So whatever happens, `sessions` holds whole sessions only.
    """

    def __init__(self, data_dir: Path) -> None:
        self.songs = data_dir / "songs"
        """Rendered songs, shared by sessions of the same score."""
        self._sessions = data_dir / "sessions"
        self._staging = data_dir / "staging"
        shutil.rmtree(self._staging, ignore_errors=True)
        for folder in (self._sessions, self._staging, self.songs):
            make_folder(folder)
        self.index = SessionIndex()
        """Of all sessions, to list them by."""
        self._index_file = data_dir / INDEX
        self.index.fill(
            self._sessions.iterdir(),
            RECORD,
            self.record,
            self._index_file,
            size_of=self._size,
            seen_of=self._seen,
        )

    def __contains__(self, session_id: str) -> bool:
        # The pattern has no dots and slashes: an id never leads out of the folder.
        return bool(SESSION_ID.fullmatch(session_id)) and (self._sessions / session_id).is_dir()

    def stage(self) -> Path:
        """A new folder to make a session in."""
        folder = self._staging / secrets.token_hex(16)
        folder.mkdir()
        return folder

    @contextmanager
    def staging(self) -> Generator[Path]:
        """A new folder to make a session in; what is still there at the end was not wanted and is removed."""
        folder = self.stage()
        try:
            yield folder
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def adopt(self, staged: Path, record: SessionRecord) -> Path:
        """Turn a staged folder into a session's; returns where it then stands."""
        write_durably(staged / RECORD, record.model_dump_json(indent=2).encode())
        for file in staged.iterdir():
            sync(file)
        sync(staged)
        folder = self.folder(record.id)
        staged.rename(folder)
        sync(self._sessions)
        self._note(record)
        return folder

    def folder(self, session_id: str) -> Path:
        """Where a session's files stand."""
        return self._sessions / session_id

    def record(self, session_id: str) -> SessionRecord:
        """Read a session's record."""
        return SessionRecord.model_validate_json((self.folder(session_id) / RECORD).read_bytes())

    def write_record(self, record: SessionRecord) -> None:
        """Replace a session's record."""
        write_durably(self.folder(record.id) / RECORD, record.model_dump_json(indent=2).encode())
        self._note(record)

    def alignment(self, session_id: str) -> Alignment | None:
        """Where a session's score is heard in its song; None where that is not known."""
        try:
            return read_alignment((self.folder(session_id) / ALIGNMENT).read_bytes())
        except FileNotFoundError:
            return None

    def write_alignment(self, session_id: str, alignment: Alignment | None) -> None:
        """Keep where a session's score is heard in its song, or forget it."""
        file = self.folder(session_id) / ALIGNMENT
        if alignment is None:
            file.unlink(missing_ok=True)
            sync(file.parent)
        else:
            write_durably(file, write_alignment(alignment))

    def usage(self, sender: str | None) -> Usage:
        """How many sessions came from a sender, or from all (None), and how large they are."""
        return self.index.usage(sender)

    def note_size(self, session_id: str) -> None:
        """Measure a session's files anew."""
        self.index.change(session_id, size_bytes=self._size(session_id))

    def note_seen(self, session_ids: Iterable[str], when: float) -> None:
        """Somebody has seen these sessions; those that are gone are left out.

        Args:
            session_ids: Which.
            when: Seconds since 1970.
        """
        for session_id in session_ids:
            with suppress(FileNotFoundError):
                file = self.folder(session_id) / SEEN
                file.touch()
                os.utime(file, (when, when))
                self.index.change(session_id, seen_s=when)

    def seen_s(self, session_id: str) -> float | None:
        """When a session was seen last, seconds since 1970; None where there is none."""
        entry = self.index.entry(session_id)
        return None if entry is None else entry.seen_s

    def unseen_since(self, when: float) -> list[str]:
        """The sessions that nobody has seen since a time, seconds since 1970."""
        return self.index.unseen_since(when)

    def write_index(self) -> None:
        """Keep the index for the next start."""
        if len(self.index):
            write_durably(self._index_file, self.index.text().encode())
        else:
            self._index_file.unlink(missing_ok=True)

    def take_out(self, session_id: str) -> Path:
        """Take a session out of the sessions, at once; what is returned is still to be removed."""
        self.index.remove(session_id)
        doomed = self._staging / f"{session_id}-{secrets.token_hex(4)}"
        self.folder(session_id).rename(doomed)
        sync(self._sessions)
        return doomed

    def _note(self, record: SessionRecord) -> None:
        modified_ns = (self.folder(record.id) / RECORD).stat().st_mtime_ns
        seen_s = self.seen_s(record.id) or 0.0
        self.index.put(Entry.of(record, modified_ns, self._size(record.id), seen_s))

    def _size(self, session_id: str) -> int:
        size = 0
        with suppress(FileNotFoundError), os.scandir(self.folder(session_id)) as files:
            for file in files:
                with suppress(FileNotFoundError):  # replaced just now
                    size += file.stat().st_size
        return size

    def _seen(self, session_id: str) -> float:
        with suppress(OSError):
            return (self.folder(session_id) / SEEN).stat().st_mtime
        return 0.0
