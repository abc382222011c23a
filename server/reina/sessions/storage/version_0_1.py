"""Sessions as version 0.1 kept them, a folder each, taken over."""

from __future__ import annotations

import hashlib
import logging
import os
import shutil
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pydantic import ValidationError

from reina.errors import InputError
from reina.sessions.record import SESSION_ID, SessionRecord
from reina.sessions.storage.errors import DatabaseError
from reina.sound.alignment.document import read_alignment

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

    from reina.sessions.storage.session_storage import SessionStorage

SESSIONS = "sessions"
"""The folder of the data directory that held one folder a session."""
INDEX = "sessions.json"
RECORD, SCORE, SHOW, ALIGNMENT = "session.json", "score", "show.json", "alignment.json"

_log = logging.getLogger(__name__)


@dataclass(frozen=True)
class TakenOver:
    """What came of it.

    Attributes:
        taken: How many sessions were taken over.
        left: Those that stay where they are: the name of the folder -> why.
    """

    taken: int
    left: Mapping[str, str]


class _LeftError(Exception):
    """A session cannot be taken over."""


def has_folders(data_dir: Path) -> bool:
    """Whether a data directory holds sessions of version 0.1."""
    folder = data_dir / SESSIONS
    return folder.is_dir() and any(folder.iterdir())


def take_over(storage: SessionStorage, told: Callable[[int, int], None] | None = None) -> TakenOver:
    """Take the sessions of version 0.1 over that the data directory holds.

    Each is kept in storage as a whole, read again and compared with what its folder holds; only then the
    folder is removed. So it may end at any point, and be begun again. What cannot be read stays where it is.

    Args:
        storage: Where they come to; of the same data directory.
        told: Called with how many are done, and of how many.

    Raises:
        StoreFullError: There is no room; what was taken over stays taken over.
        DatabaseAwayError: The database does not answer; the same.
    """
    folder = storage.data_dir / SESSIONS
    found = sorted(folder.iterdir()) if folder.is_dir() else []
    left: dict[str, str] = {}
    for done, old in enumerate(found):
        try:
            _take(storage, old)
        except _LeftError as error:
            left[old.name] = str(error)
            _log.warning("the session in %s stays there: %s", old, error)
        if told is not None:
            told(done + 1, len(found))
    if folder.is_dir() and not left:
        folder.rmdir()
        (storage.data_dir / INDEX).unlink(missing_ok=True)
    return TakenOver(len(found) - len(left), left)


def _take(storage: SessionStorage, old: Path) -> None:
    if not SESSION_ID.fullmatch(old.name) or not old.is_dir():
        raise _LeftError("it is no session's folder")
    record, show, alignment, files = _read(old)
    if record.id not in storage:
        staging = storage.stage()
        try:
            # The file store may take what it is given.
            staged = {name: _link(file, staging / name) for name, file in files.items()}
            storage.add(record, staged, show, alignment)
        finally:
            shutil.rmtree(staging, ignore_errors=True)
    _verify(storage, record, show, alignment, files)
    doomed = storage.stage() / old.name
    old.rename(doomed)
    shutil.rmtree(doomed.parent, ignore_errors=True)


def _read(old: Path) -> tuple[SessionRecord, bytes, bytes | None, dict[str, Path]]:
    try:
        record = SessionRecord.model_validate_json((old / RECORD).read_bytes())
        show = (old / SHOW).read_bytes()
        alignment = (old / ALIGNMENT).read_bytes() if (old / ALIGNMENT).exists() else None
        if alignment is not None:
            read_alignment(alignment)
        # What begins with a dot was being written when a server ended, and is no part of the session.
        files = {
            file.name: file
            for file in sorted(old.iterdir())
            if file.is_file() and not file.name.startswith(".") and file.name not in {RECORD, SHOW, ALIGNMENT}
        }
    except OSError as error:
        raise _LeftError(f"{error.filename} cannot be read: {error.strerror}") from error
    except ValidationError as error:
        fault = error.errors()[0]
        raise _LeftError(f"its record does not fit: {fault['msg']}") from error
    except (ValueError, InputError) as error:
        raise _LeftError(f"it cannot be read: {error}") from error
    if record.id != old.name:
        raise _LeftError(f"its record is of the session {record.id}")
    needed = [SCORE, *([record.song.file] if record.song is not None else [])]
    if missing := [name for name in needed if name not in files]:
        raise _LeftError(f"it has no file {', '.join(missing)}")
    return record, show, alignment, files


def _link(file: Path, to: Path) -> Path:
    try:
        os.link(file, to)
    except OSError:
        shutil.copyfile(file, to)
    return to


def _verify(
    storage: SessionStorage,
    record: SessionRecord,
    show: bytes,
    alignment: bytes | None,
    files: Mapping[str, Path],
) -> None:
    """See that storage holds all that a folder holds.

    Raises:
        _LeftError: It does not.
    """
    try:
        kept = storage.read(record.id)
        if kept is None or kept.record.model_copy(update={"files": ()}) != record:
            raise _LeftError("the session that is kept under its id is another one")
        if kept.show.text != show:
            raise _LeftError("its show came out otherwise")
        if alignment is not None and kept.alignment != read_alignment(alignment):
            raise _LeftError("its alignment came out otherwise")
        for name, file in files.items():
            if _digest(file) != _digest(storage.file(kept.record, name)):
                raise _LeftError(f"its file {name} came out otherwise")
    except DatabaseError:
        raise
    except InputError as error:
        raise _LeftError(f"it could not be read again: {error}") from error


def _digest(file: Path) -> str:
    with file.open("rb") as content:
        return hashlib.file_digest(content, "sha256").hexdigest()
