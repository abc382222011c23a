"""One server a data directory."""

from __future__ import annotations

import fcntl
import os
from contextlib import contextmanager
from typing import TYPE_CHECKING

from reina.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Generator
    from pathlib import Path

LOCK = "lock"
"""The file in the data directory that is locked by whoever works in it; it says who that is."""


class DirectoryInUseError(InputError):
    """Somebody else works in the data directory."""


@contextmanager
def locked(data_dir: Path) -> Generator[None]:
    """Work in a data directory alone. The lock ends with the process, however that ends.

    Args:
        data_dir: The directory; it is there.

    Raises:
        DirectoryInUseError: Another process does already; the message says which.
    """
    try:
        handle = os.open(data_dir / LOCK, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
    except OSError as error:
        raise DirectoryInUseError(
            f"the data directory {data_dir} cannot be locked: {error.strerror}"
        ) from error
    try:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            holder = os.pread(handle, 100, 0).decode(errors="replace").strip() or "unknown"
            raise DirectoryInUseError(
                f"another server works in the data directory {data_dir}: the process {holder}; stop it, or "
                "name another directory with --data-dir or REINA_DATA_DIR"
            ) from None
        os.ftruncate(handle, 0)
        os.pwrite(handle, f"{os.getpid()}\n".encode(), 0)
        yield
    finally:
        os.close(handle)
