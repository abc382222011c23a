"""Sessions on disk: one folder each, which is there as a whole or not at all."""

from __future__ import annotations

import logging
import secrets
import shutil
from contextlib import contextmanager
from typing import TYPE_CHECKING

from reina.sessions.atomic_write import write_atomically
from reina.sessions.record import SESSION_ID, SessionRecord

if TYPE_CHECKING:
    from collections.abc import Generator
    from pathlib import Path

RECORD = "session.json"
SCORE = "score"
SHOW = "show.json"
_log = logging.getLogger(__name__)


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
            folder.mkdir(parents=True, exist_ok=True)

    def __contains__(self, session_id: str) -> bool:
        # The pattern has no dots and slashes: an id never leads out of the folder.
        return bool(SESSION_ID.fullmatch(session_id)) and (self._sessions / session_id).is_dir()

    @contextmanager
    def staging(self) -> Generator[Path]:
        """A new folder to make a session in; what is still there at the end was not wanted and is removed."""
        folder = self._staging / secrets.token_hex(16)
        folder.mkdir()
        try:
            yield folder
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def adopt(self, staged: Path, record: SessionRecord) -> Path:
        """Turn a staged folder into a session's; returns where it then stands."""
        write_atomically(staged / RECORD, record.model_dump_json(indent=2).encode())
        folder = self.folder(record.id)
        staged.rename(folder)
        return folder

    def folder(self, session_id: str) -> Path:
        """Where a session's files stand."""
        return self._sessions / session_id

    def record(self, session_id: str) -> SessionRecord:
        """Read a session's record."""
        return SessionRecord.model_validate_json((self.folder(session_id) / RECORD).read_bytes())

    def write_record(self, record: SessionRecord) -> None:
        """Replace a session's record."""
        write_atomically(self.folder(record.id) / RECORD, record.model_dump_json(indent=2).encode())

    def records(self) -> list[SessionRecord]:
        """The records of all sessions, newest first."""
        records: list[SessionRecord] = []
        for folder in self._sessions.iterdir():
            try:
                records.append(self.record(folder.name))
            except (OSError, ValueError) as error:
                # One that was just ended, or was damaged from outside; the others are still to be listed.
                _log.warning("session %s cannot be read: %s", folder.name, error)
        return sorted(records, key=lambda record: record.created_at, reverse=True)

    def take_out(self, session_id: str) -> Path:
        """Take a session out of the sessions, at once; what is returned is still to be removed."""
        doomed = self._staging / f"{session_id}-{secrets.token_hex(4)}"
        self.folder(session_id).rename(doomed)
        return doomed
