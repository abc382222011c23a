"""What keeps large files: each by its content, so that the same file stands once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from reina.errors import InputError
from reina.system.disk_room import NO_ROOM

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


class StoredFileLostError(InputError):
    """A file that was kept is not there any more, or is not what it was."""


class StoreFullError(InputError):
    """There is no room: for a file, or for anything else that is to be kept."""

    def __init__(self, detail: str = NO_ROOM) -> None:
        super().__init__(detail)


class StoreAwayError(InputError):
    """What keeps the files does not answer, or does not let the server in; it may later."""


@dataclass(frozen=True)
class StoredFile:
    """A file that is kept.

    Attributes:
        digest: SHA-256 of its content, 64 hexadecimal digits.
        size: Bytes.
    """

    digest: str
    size: int


class FileStore(Protocol):
    """Keeps files by their content. Its methods block: they are for threads."""

    def keep(self, file: Path) -> StoredFile:
        """Keep a copy of a file, or the file itself; what is returned survives a power cut.

        Args:
            file: It may be gone afterwards; the store may take it as it is.

        Raises:
            StoreFullError: There is no room; the file is where it was then, and nothing of it is kept.
            StoreAwayError: The store does not answer.
        """
        ...

    def path(self, digest: str) -> Path:
        """Where a file can be read on this machine, fetched first if need be. Nobody may write to it.

        What was fetched may be put away again to make room for others: ask anew each time it is opened.

        Raises:
            StoredFileLostError: It is not there, or not what it was.
            StoreAwayError: The store does not answer.
            StoreFullError: There is no room to fetch it to.
        """
        ...

    def remove(self, digest: str) -> None:
        """Forget a file; nothing happens where it is not there.

        Raises:
            StoreAwayError: The store does not answer.
        """
        ...

    def files(self) -> Iterator[StoredFile]:
        """All files that are kept.

        Raises:
            StoreAwayError: The store does not answer.
        """
        ...
