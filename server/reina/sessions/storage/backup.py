"""A consistent copy of a data directory, made while a server works on it."""

from __future__ import annotations

import contextlib
import hashlib
import io
import os
import secrets
import shutil
import sqlite3
import tarfile
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import reina
from reina.sessions.storage.archive import (
    CONTENT_NAMED,
    DATABASE,
    FOLDERS,
    FORMAT,
    MANIFEST,
    SIGNING_KEY,
    VERSION,
    ArchiveError,
    ArchiveManifest,
    Entry,
    is_kept,
)
from reina.system.durable import OWN_FOLDER

if TYPE_CHECKING:
    from collections.abc import Generator, Iterator
    from typing import IO

STAGING = "staging"
PATIENCE_S = 60.0
"""How long the database may be written to by one writer."""


@dataclass
class BackedUp:
    """What went into a backup.

    Attributes:
        files: How many files.
        size: Their bytes.
        has_database: Whether the sessions' database is among them.
        damaged: Files that were not any more what their names say; they are in the backup as they are.
    """

    files: int = 0
    size: int = 0
    has_database: bool = False
    damaged: list[str] = field(default_factory=list[str])


def back_up(data_dir: Path, to: IO[bytes]) -> BackedUp:
    """Write what a data directory keeps as a tar file, in one go from its beginning to its end.

    First every file is given a second name, so that none that the database names goes before it is written;
    then the database is copied as it is at one moment, and what came in between is named too. It is copied
    again where it speaks of a file that came and went in between. So the copy has every file that its
    database speaks of, but for those that are lost or kept elsewhere.

    Args:
        data_dir: A server may be at work on it.
        to: Where the archive goes; it need not be seekable.

    Raises:
        ArchiveError: There is nothing to back up, or the database is damaged.
        OSError: Something cannot be read or written.
    """
    if not data_dir.is_dir():
        raise ArchiveError(f"there is no data directory {data_dir}")
    done = BackedUp()
    manifest: dict[str, Entry] = {}
    with _still(data_dir) as still, tarfile.open(fileobj=to, mode="w|", format=tarfile.PAX_FORMAT) as archive:
        for path in sorted(still.rglob("*")):
            name = path.relative_to(still).as_posix()
            if not path.is_file() or not is_kept(name):
                continue
            entry = _add(archive, path, name)
            manifest[name] = entry
            done.files += 1
            done.size += entry.size
            done.has_database |= name == DATABASE
            named = CONTENT_NAMED.fullmatch(name)
            if named and named[1] != entry.sha256:
                done.damaged.append(name)
        if not manifest:
            raise ArchiveError(f"the data directory {data_dir} keeps nothing yet")
        text = ArchiveManifest(
            format=FORMAT,
            version=VERSION,
            reina=reina.__version__,
            created_at=time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()),
            files=manifest,
        ).model_dump_json()
        _add_bytes(archive, text.encode(), MANIFEST)
    return done


@contextlib.contextmanager
def _still(data_dir: Path) -> Generator[Path]:
    """A folder that holds what the data directory keeps as it is now, which nothing changes any more."""
    staging = data_dir / STAGING
    staging.mkdir(exist_ok=True)
    still = staging / f"backup-{secrets.token_hex(8)}"
    still.mkdir(OWN_FOLDER)
    try:
        if (data_dir / SIGNING_KEY).is_file():
            shutil.copyfile(data_dir / SIGNING_KEY, still / SIGNING_KEY)
        for folder in FOLDERS:
            _name_again(data_dir / folder, still / folder)
        if (data_dir / DATABASE).is_file():
            before: set[str] | None = None
            while before != (missing := _copied(data_dir, still)):
                # Sessions that came and went meanwhile are in no further copy; what is missing from two is
                # lost, or kept elsewhere.
                if not missing:
                    break
                before = missing
        yield still
    finally:
        shutil.rmtree(still, ignore_errors=True)


def _copied(data_dir: Path, still: Path) -> set[str]:
    """Copy the database, then name what came until then; returns digests that it names and are not there."""
    copy = still / DATABASE
    copy.unlink(missing_ok=True)
    _copy_database(data_dir / DATABASE, copy)
    for folder in FOLDERS:
        _name_again(data_dir / folder, still / folder)
    with contextlib.closing(sqlite3.connect(copy)) as database:
        try:
            named = {str(digest) for (digest,) in database.execute("SELECT digest FROM session_files")}
        except sqlite3.OperationalError:  # no server has made its tables yet
            return set()
    return {digest for digest in named if not (still / "files" / digest[:2] / digest).is_file()}


def _name_again(folder: Path, beside: Path) -> None:
    """Give every file in a folder and below another name, in the same place below another folder.

    Files of a data directory are replaced, and never written to once they are there.
    """
    for path in _files(folder):
        name = beside / path.relative_to(folder)
        name.parent.mkdir(mode=OWN_FOLDER, parents=True, exist_ok=True)
        # It may be gone since it was seen; and in the second round most have their name already.
        with contextlib.suppress(FileNotFoundError, FileExistsError):
            try:
                os.link(path, name)
            except FileExistsError:
                raise
            except OSError:
                # A file system without second names.
                shutil.copyfile(path, name)


def _files(folder: Path) -> Iterator[Path]:
    for place, _, names in os.walk(folder):
        for name in names:
            # What begins with a dot is still being written.
            if not name.startswith("."):
                yield Path(place, name)


def _copy_database(path: Path, to: Path) -> None:
    """Copy a SQLite database as it is at one moment, without holding up whoever writes to it.

    Raises:
        ArchiveError: It is damaged, or no database.
    """
    source = f"file:{path.absolute()}?mode=ro"
    try:
        with (
            contextlib.closing(sqlite3.connect(source, uri=True, timeout=PATIENCE_S)) as live,
            contextlib.closing(sqlite3.connect(to)) as copy,
        ):
            live.backup(copy)
            # One file, without a log beside it.
            copy.execute("PRAGMA journal_mode=DELETE").fetchone()
            [(found,)] = copy.execute("PRAGMA quick_check(1)").fetchall()
    except sqlite3.Error as error:
        raise ArchiveError(f"the database {path} cannot be copied: {error}") from error
    if found != "ok":
        raise ArchiveError(f"the database {path} is damaged: {found}")


class _Hashed(io.RawIOBase):
    """A file whose digest is known when it has been read."""

    def __init__(self, file: IO[bytes]) -> None:
        self._file = file
        self.digest = hashlib.sha256()

    def readable(self) -> bool:
        return True

    def read(self, size: int = -1, /) -> bytes:
        data = self._file.read(size)
        self.digest.update(data)
        return data


def _add(archive: tarfile.TarFile, path: Path, name: str) -> Entry:
    with path.open("rb") as file:
        info = tarfile.TarInfo(name)
        stat = os.fstat(file.fileno())
        info.size, info.mtime, info.mode = stat.st_size, int(stat.st_mtime), 0o600
        hashed = _Hashed(file)
        archive.addfile(info, hashed)  # type: ignore[arg-type]
    return Entry(size=info.size, sha256=hashed.digest.hexdigest())


def _add_bytes(archive: tarfile.TarFile, data: bytes, name: str) -> None:
    info = tarfile.TarInfo(name)
    info.size, info.mtime, info.mode = len(data), int(time.time()), 0o600
    archive.addfile(info, io.BytesIO(data))
