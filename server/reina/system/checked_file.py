"""Files for libraries that swallow what a disk answers."""

from __future__ import annotations

import os
from contextlib import contextmanager
from io import FileIO
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Generator
    from pathlib import Path

    from _typeshed import ReadableBuffer


class CheckedFile(FileIO):
    """A file that a library writes by a callback, in which no error can be raised."""

    refused: OSError | None = None
    """What the first write that failed was answered with."""

    def write(self, data: ReadableBuffer, /) -> int:
        """Write all of it, or note why that failed; how many bytes were written."""
        left = memoryview(data)
        try:
            while left:
                left = left[super().write(left) :]
        except OSError as error:
            self.refused = self.refused or error
        return memoryview(data).nbytes - left.nbytes


@contextmanager
def checked_file(path: Path) -> Generator[CheckedFile]:
    """Open a new file for a library to write; at the end the disk holds all of it.

    Raises:
        OSError: It could not be written, whatever the library made of that.
    """
    with CheckedFile(path, "w+") as file:
        try:
            yield file
        finally:
            if file.refused is not None:
                raise file.refused
        os.fsync(file.fileno())
