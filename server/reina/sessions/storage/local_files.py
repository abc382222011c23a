"""Large files in a folder of this machine."""

from __future__ import annotations

import contextlib
import errno
import hashlib
import re
import secrets
import threading
import time
from typing import TYPE_CHECKING

from reina.sessions.storage.file_store import StoredFile, StoredFileLostError, StoreFullError
from reina.system.disk_room import is_disk_full
from reina.system.durable import OWN_FILE, make_folder, open_own, put_in_place

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

DIGEST = re.compile(r"[0-9a-f]{64}")
AT_ONCE = 1_000_000
"""Bytes that are read and hashed at a time."""
DRAFT = ".draft-"
FORSAKEN_S = 86_400.0
"""A draft that nothing was written to for so long was left by a server that was killed, seconds."""

_Signature = tuple[int, int, int]
"""What changes with a file's content: inode, bytes, time of the last change in ns."""


class LocalFiles:
    """Files by their content: ``folder/ab/abcdef…`` holds what hashes to ``abcdef…``. For several threads.

    A file is read and compared with its name before it is first given to anybody, and again when its size or
    time are other than they were then. So neither a damaged disk nor a hand in the folder is taken for what
    was kept.

    Args:
        folder: Where they are; it is made. Staged files are best on the same file system: they are taken then
            without being copied.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._placing = threading.Lock()
        self._verified: dict[str, _Signature] = {}
        make_folder(folder)
        self._remove_forsaken()

    def keep(self, file: Path) -> StoredFile:
        """See `FileStore.keep`; the file is taken as it is where it stands on the same file system."""
        try:
            kept = self._take(file)
            return self._copy(file) if kept is None else kept
        except OSError as error:
            if is_disk_full(error):
                raise StoreFullError from error
            raise

    def path(self, digest: str) -> Path:
        """See `FileStore.path`."""
        path = self._path(digest)
        try:
            signature = _signature(path)
            if self._verified.get(digest) != signature:
                if measured(path).digest != digest:
                    raise StoredFileLostError(f"the file {digest[:16]}… is damaged; restore it from a backup")
                self._verified[digest] = signature
        except FileNotFoundError as error:
            self._verified.pop(digest, None)
            raise _lost(digest) from error
        return path

    def remove(self, digest: str) -> None:
        """See `FileStore.remove`."""
        if DIGEST.fullmatch(digest):
            with self._placing:
                self._verified.pop(digest, None)
                self._path(digest).unlink(missing_ok=True)

    def files(self) -> Iterator[StoredFile]:
        """See `FileStore.files`; what else lies in the folder is left out."""
        for folder in sorted(self._folder.iterdir()):
            for file in sorted(folder.iterdir()) if folder.is_dir() else ():
                if DIGEST.fullmatch(file.name) and file.name.startswith(folder.name):
                    # Removed since the folder was read.
                    with contextlib.suppress(FileNotFoundError):
                        yield StoredFile(file.name, file.stat().st_size)

    def _path(self, digest: str) -> Path:
        if not DIGEST.fullmatch(digest):
            raise _lost(digest)
        return self._folder / digest[:2] / digest

    def _take(self, file: Path) -> StoredFile | None:
        """Take a file as it is; None where it stands on another file system."""
        if file.stat().st_dev != self._folder.stat().st_dev:
            return None
        kept = measured(file)
        try:
            self._place(file, kept)
        except OSError as error:
            # One device may be mounted several times.
            if error.errno != errno.EXDEV:
                raise
            return None
        return kept

    def _place(self, draft: Path, kept: StoredFile) -> None:
        """Give a whole file its name."""
        path = self._path(kept.digest)
        with self._placing:
            is_new_folder = not path.parent.is_dir()
            try:
                make_folder(path.parent)
                draft.chmod(OWN_FILE)
                put_in_place(draft, path)
            except OSError:
                if is_new_folder:
                    with contextlib.suppress(OSError):
                        path.parent.rmdir()
                raise
            self._verified[kept.digest] = _signature(path)

    def _copy(self, file: Path) -> StoredFile:
        draft = self._folder / f"{DRAFT}{secrets.token_hex(8)}"
        try:
            digest = hashlib.sha256()
            with file.open("rb") as source, open_own(draft) as copy:
                while block := source.read(AT_ONCE):
                    digest.update(block)
                    copy.write(block)
                kept = StoredFile(digest.hexdigest(), copy.tell())
            self._place(draft, kept)
        finally:
            draft.unlink(missing_ok=True)
        return kept

    def _remove_forsaken(self) -> None:
        for draft in self._folder.glob(f"{DRAFT}*"):
            with contextlib.suppress(FileNotFoundError):
                if time.time() - draft.stat().st_mtime > FORSAKEN_S:
                    draft.unlink()


def measured(file: Path) -> StoredFile:
    """Digest and size of a file."""
    with file.open("rb") as content:
        digest = hashlib.file_digest(content, "sha256").hexdigest()
        return StoredFile(digest, content.tell())


def _signature(path: Path) -> _Signature:
    status = path.stat()
    return status.st_ino, status.st_size, status.st_mtime_ns


def _lost(digest: str) -> StoredFileLostError:
    return StoredFileLostError(f"the file {digest[:16]}… is not there any more; restore it from a backup")
