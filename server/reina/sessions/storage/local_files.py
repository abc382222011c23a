"""Files by their content, in a folder."""

from __future__ import annotations

import hashlib
import os
from typing import TYPE_CHECKING

from reina.sessions.storage.file_store import StoredFile, StoredFileLostError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


class LocalFiles:
    """Keeps files below a folder, each by its content.

    Args:
        folder: Where; it is made.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)

    def keep(self, file: Path) -> StoredFile:
        """See `FileStore.keep`."""
        with file.open("rb") as content:
            digest = hashlib.file_digest(content, "sha256").hexdigest()
            size = os.fstat(content.fileno()).st_size
            os.fchmod(content.fileno(), 0o600)
            os.fsync(content.fileno())
        kept = self._folder / digest
        file.replace(kept)
        folder = os.open(self._folder, os.O_RDONLY)
        try:
            os.fsync(folder)
        finally:
            os.close(folder)
        return StoredFile(digest, size)

    def path(self, digest: str) -> Path:
        """See `FileStore.path`."""
        kept = self._folder / digest
        if not kept.is_file():
            raise StoredFileLostError(f"the file {digest} is not in {self._folder}")
        return kept

    def remove(self, digest: str) -> None:
        """See `FileStore.remove`."""
        (self._folder / digest).unlink(missing_ok=True)

    def files(self) -> Iterator[StoredFile]:
        """See `FileStore.files`."""
        for file in self._folder.iterdir():
            yield StoredFile(file.name, file.stat().st_size)
