"""The file store, with care for files that no session names yet, and for those that none names any more."""

from __future__ import annotations

import logging
import threading
from collections import Counter
from contextlib import AbstractContextManager, contextmanager, nullcontext
from typing import TYPE_CHECKING, Protocol

from reina.errors import InputError
from reina.sessions.record import FileRecord
from reina.sessions.storage.local_files import measured

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Generator, Mapping
    from pathlib import Path

    from reina.sessions.storage.file_store import FileStore

_log = logging.getLogger(__name__)


class FileLocks(Protocol):
    """What keeps a server from removing a file that another is about to name."""

    def naming(self, digests: Collection[str]) -> AbstractContextManager[None]:
        """Held from before files are kept until they are named, or are not to be."""
        ...

    def removing(self, digest: str) -> AbstractContextManager[bool]:
        """Held while a file that nothing names is removed; False where somebody is about to name it."""
        ...


class HeldFiles:
    """Keeps files and removes them; never one that somebody is about to name. For threads.

    Args:
        files: Where they are kept.
        is_named: Whether a session names a file, by its digest.
        locks: What servers that have the same files hold while they name some or remove one; None where no
            other has them.
    """

    def __init__(
        self, files: FileStore, is_named: Callable[[str], bool], locks: FileLocks | None = None
    ) -> None:
        self._files = files
        self._is_named = is_named
        self._locks = locks
        self._looking = threading.Lock()
        self._held = Counter[str]()
        self._keeping = 0
        self._doubtful: set[str] = set()

    @contextmanager
    def keep(self, staged: Mapping[str, Path]) -> Generator[tuple[FileRecord, ...]]:
        """Keep files, which are to be named by the end; those that are not are removed.

        Args:
            staged: Name within the session -> file; it may be gone afterwards.

        Raises:
            StoreFullError: There is no room.
        """
        kept: list[FileRecord] = []
        unnamed: set[str] = set()
        try:
            with self._naming(staged.values()):
                for name, file in staged.items():
                    kept.append(self._keep(name, file))
                yield tuple(kept)
        except BaseException:
            unnamed = {file.digest for file in kept}
            raise
        finally:
            with self._looking:
                self._held.subtract(file.digest for file in kept)
            if unnamed or self._doubtful:
                self.remove_unnamed(unnamed)

    def remove_unnamed(self, digests: set[str]) -> int:
        """Remove those files that no session names; returns how many these were.

        What somebody may be about to name, or cannot be told or removed now, is looked at again later.
        """
        removed = 0
        with self._looking:
            digests = digests | self._doubtful
            self._doubtful = set()
        for digest in digests:
            with self._looking:
                if self._keeping:
                    # It may be the one that is just being kept.
                    self._doubtful.add(digest)
                    continue
                try:
                    with self._removing(digest) as may_be:
                        if not may_be:
                            self._doubtful.add(digest)
                        elif self._held[digest] <= 0 and not self._is_named(digest):
                            self._files.remove(digest)
                            removed += 1
                except (InputError, OSError) as error:
                    self._doubtful.add(digest)
                    _log.warning("the file %s is left for now: %s", digest, error)
        return removed

    def _naming(self, files: Collection[Path]) -> AbstractContextManager[None]:
        if self._locks is None or not files:
            return nullcontext()
        return self._locks.naming({measured(file).digest for file in files})

    def _removing(self, digest: str) -> AbstractContextManager[bool]:
        return nullcontext(True) if self._locks is None else self._locks.removing(digest)

    def _keep(self, name: str, file: Path) -> FileRecord:
        with self._looking:
            self._keeping += 1
        try:
            stored = self._files.keep(file)
            with self._looking:
                self._held[stored.digest] += 1
        finally:
            with self._looking:
                self._keeping -= 1
        return FileRecord(name=name, digest=stored.digest, size=stored.size)
