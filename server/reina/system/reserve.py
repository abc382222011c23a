"""Room on the disk for what makes room: to end something on a full disk takes a little of it first."""

from __future__ import annotations

import contextlib
import os
import threading
from contextlib import contextmanager
from typing import TYPE_CHECKING

from reina.system.durable import open_own

if TYPE_CHECKING:
    from collections.abc import Generator
    from pathlib import Path

RESERVE = "reserve"
BYTES = 8_000_000


class Reserve:
    """A file that holds nothing but room. For several threads.

    Args:
        folder: Where it is, on the disk that may be full.
        size_bytes: How much it holds; less than that is none.
    """

    def __init__(self, folder: Path, size_bytes: int = BYTES) -> None:
        self._file = folder / RESERVE
        self._size_bytes = size_bytes
        self._using = threading.Lock()
        self._set_aside()

    @contextmanager
    def given_up(self) -> Generator[None]:
        """Let something have the room; afterwards it is set aside again, if it is there then."""
        with self._using:
            self._file.unlink(missing_ok=True)
            try:
                yield
            finally:
                self._set_aside()

    def _set_aside(self) -> None:
        if self._file.is_file() and self._file.stat().st_size == self._size_bytes:
            return
        try:
            self._file.unlink(missing_ok=True)
            with open_own(self._file) as file:
                os.posix_fallocate(file.fileno(), 0, self._size_bytes)
        except OSError:
            # There is no room for it now; the next time there may be.
            with contextlib.suppress(OSError):
                self._file.unlink(missing_ok=True)
