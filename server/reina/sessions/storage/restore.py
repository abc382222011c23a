"""A data directory made again from a backup: all of it, and what it was, or nothing."""

from __future__ import annotations

import contextlib
import hashlib
import os
import secrets
import shutil
import tarfile
import zlib
from pathlib import Path
from typing import TYPE_CHECKING

from pydantic import ValidationError

from reina.sessions.storage.archive import (
    AT_ONCE,
    FOLDERS,
    FORMAT,
    LARGEST_MANIFEST,
    MANIFEST,
    VERSION,
    ArchiveError,
    ArchiveManifest,
    Entry,
    is_kept,
)
from reina.system.durable import OWN_FOLDER, make_folder, open_own, sync

if TYPE_CHECKING:
    from collections.abc import Generator
    from typing import IO


def restore(archive: IO[bytes], data_dir: Path) -> ArchiveManifest:
    """Unpack a backup into a data directory that holds nothing.

    Every file is compared with its digest before any of them is in its place.

    Args:
        archive: As `back_up` wrote it, packed by gzip or not; it need not be seekable.
        data_dir: Not there yet, or empty.

    Returns:
        What it holds.

    Raises:
        ArchiveError: The directory is not empty, or the archive is damaged or none; nothing is left then.
        OSError: Something cannot be written.
    """
    if data_dir.exists() and (not data_dir.is_dir() or any(data_dir.iterdir())):
        raise ArchiveError(f"{data_dir} is not empty: name a directory that is not there yet")
    data_dir.parent.mkdir(parents=True, exist_ok=True)
    with _staged(data_dir) as staged:
        try:
            manifest = _unpack(archive, staged)
        except (tarfile.TarError, EOFError, zlib.error) as error:
            raise ArchiveError(f"the backup is damaged or none: {error}") from error
        _sync_folders(staged)
        _put_in_place(staged, data_dir)
    return manifest


@contextlib.contextmanager
def _staged(data_dir: Path) -> Generator[Path]:
    """A folder on the same file system: inside where the directory is there, as it may be a mount's root."""
    place = data_dir if data_dir.is_dir() else data_dir.parent
    staged = place / f".restoring-{secrets.token_hex(8)}"
    staged.mkdir(OWN_FOLDER)
    try:
        yield staged
    finally:
        shutil.rmtree(staged, ignore_errors=True)


def _unpack(archive: IO[bytes], staged: Path) -> ArchiveManifest:
    found: dict[str, Entry] = {}
    manifest: ArchiveManifest | None = None
    with tarfile.open(fileobj=archive, mode="r|*") as members:
        for member in members:
            content = members.extractfile(member) if member.isreg() else None
            if content is None or manifest is not None:
                raise _does_not_belong(member.name)
            if member.name == MANIFEST:
                manifest = _manifest(content.read(LARGEST_MANIFEST))
            elif is_kept(member.name) and member.name not in found:
                found[member.name] = _write(content, staged / member.name)
            else:
                raise _does_not_belong(member.name)
    if manifest is None:
        raise ArchiveError("the backup is not whole: its end is missing")
    for name, entry in manifest.files.items():
        if found.get(name) != entry:
            what = "is not what it was" if name in found else "is missing"
            raise ArchiveError(f"the backup is damaged: {name} {what}")
    if len(found) > len(manifest.files):
        raise ArchiveError("the backup is damaged: it holds more than was put into it")
    return manifest


def _does_not_belong(name: str) -> ArchiveError:
    return ArchiveError(f"the backup is damaged or none: {name[:100]!r} does not belong in it")


def _manifest(text: bytes) -> ArchiveManifest:
    try:
        manifest = ArchiveManifest.model_validate_json(text)
    except ValidationError as error:
        raise ArchiveError("the backup is damaged: its list of files cannot be read") from error
    if manifest.format != FORMAT or manifest.version != VERSION:
        raise ArchiveError(
            f"this is a {manifest.format[:40]!r} of version {manifest.version}; "
            f"this Reina reads {FORMAT!r} of version {VERSION}"
        )
    return manifest


def _write(content: IO[bytes], path: Path) -> Entry:
    make_folder(path.parent)
    digest, size = hashlib.sha256(), 0
    with open_own(path) as file:
        while part := content.read(AT_ONCE):
            file.write(part)
            digest.update(part)
            size += len(part)
        file.flush()
        os.fsync(file.fileno())
    return Entry(size=size, sha256=digest.hexdigest())


def _sync_folders(folder: Path) -> None:
    """Have the names in a folder, and in those below, outlive a power cut."""
    for place, _, _ in os.walk(folder):
        sync(Path(place))


def _put_in_place(staged: Path, data_dir: Path) -> None:
    if not data_dir.is_dir():
        staged.rename(data_dir)
        sync(data_dir.parent)
        return
    # The database comes last: without it there is nothing that a server would take for sessions.
    entries = sorted(staged.iterdir(), key=lambda entry: entry.name not in FOLDERS)
    for entry in entries:
        entry.rename(data_dir / entry.name)
        sync(data_dir)
