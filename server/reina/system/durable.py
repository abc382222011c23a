"""Files and folders that survive a power cut, and are never there by halves.

A file's bytes are safe once the file is synced, its name once its folder is, and the folder's name once the
folder above is: each is synced before whatever relies on it is said to be done.
"""

from __future__ import annotations

import os
import secrets
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from io import BufferedWriter
    from pathlib import Path

OWN_FILE, OWN_FOLDER = 0o600, 0o700
"""What is kept is for the server's own user alone."""


def sync(path: Path) -> None:
    """Have the disk hold what a file holds, or which names a folder has."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def make_folder(folder: Path) -> None:
    """Make a folder, and those above it that are missing; each name survives a power cut."""
    missing = [folder]
    while not missing[-1].parent.is_dir():
        missing.append(missing[-1].parent)
    for each in reversed(missing):
        each.mkdir(OWN_FOLDER, exist_ok=True)
        # One that was there may just have been made by another, who has not synced it yet.
        sync(each.parent)


def put_in_place(draft: Path, path: Path) -> None:
    """Give a file that is whole its name, in the place of what has it; both survive a power cut.

    Args:
        draft: The file; it stays where it is if this fails.
        path: Its name, on the same file system.
    """
    sync(draft)
    draft.replace(path)
    sync(path.parent)


def write_durably(path: Path, data: bytes) -> None:
    """Write a file that is there as a whole or, after a crash or a power cut, as it was before.

    Raises:
        OSError: It could not be written, as where the disk is full; it is as it was before then.
    """
    draft = path.with_name(f".{path.name}.{secrets.token_hex(4)}")
    try:
        with open_own(draft) as file:
            file.write(data)
        put_in_place(draft, path)
    finally:
        draft.unlink(missing_ok=True)


def open_own(path: Path) -> BufferedWriter:
    """Open a new file to write to that only the server's own user may read.

    Raises:
        FileExistsError: There is one.
    """
    return open(path, "xb", opener=_own)


def _own(path: str, flags: int) -> int:
    return os.open(path, flags, OWN_FILE)
