"""What the server keeps, and where."""

from __future__ import annotations

import os
import shutil
import tempfile
from typing import TYPE_CHECKING

from reina.cli.doctor.finding import fail, ok, warn
from reina.sessions.storage.directory_lock import LOCK

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from reina.cli.doctor.finding import Finding

LEAST_ROOM_BYTES, GOOD_ROOM_BYTES = 100_000_000, 3_000_000_000
"""With less uploads fail soon; with less than the other the cache of rendered songs does not fit."""
OTHERS = 0o077
ANOTHER_DIRECTORY = "name one that is this user's with --data-dir or REINA_DATA_DIR, or give it to this user"


def data_checks(data_dir: Path) -> Iterator[Finding]:
    """The data directory; nothing is made or changed that stays."""
    directory = data_dir.absolute()
    nearest = next(folder for folder in (directory, *directory.parents) if folder.exists())
    try:
        with tempfile.TemporaryFile(dir=nearest) as file:
            file.write(bytes(4096))
            file.flush()
    except OSError as error:
        yield fail("data directory", f"{data_dir}: {error.strerror}", ANOTHER_DIRECTORY)
        return
    if nearest == directory:
        yield ok("data directory", f"{data_dir} can be written to")
        yield _mode(directory)
    else:
        yield ok("data directory", f"{data_dir} will be made")
    yield _room(nearest)
    yield _lock(directory / LOCK)


def _lock(path: Path) -> Finding:
    """Whether a server works in the directory."""
    try:
        import fcntl
    except ImportError:  # not on Windows
        return ok("lock", "not known here")
    try:
        with path.open("rb") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
            except BlockingIOError:
                holder = file.read(20).decode("ascii", "replace").strip()
                return ok("lock", f"a server works in it: the process {holder or 'unknown'}")
    except FileNotFoundError:
        return ok("lock", "no server works in it")
    except OSError as error:
        return fail("lock", f"{path}: {error.strerror}", ANOTHER_DIRECTORY)
    return ok("lock", "no server works in it")


def _mode(directory: Path) -> Finding:
    stat = directory.stat()
    if hasattr(os, "geteuid") and stat.st_uid != os.geteuid() and os.geteuid() != 0:
        return warn(
            "owner", f"{directory} is user {stat.st_uid}'s, and this is {os.geteuid()}", ANOTHER_DIRECTORY
        )
    if os.name == "posix" and stat.st_mode & OTHERS:
        detail = f"{directory} can be read by other users of this machine ({stat.st_mode & 0o777:03o})"
        return warn("owner", detail, f"chmod 700 {directory}")
    return ok("owner", "the data directory is this user's alone")


def _room(folder: Path) -> Finding:
    free = shutil.disk_usage(folder).free
    detail = f"{free / 1e9:,.1f} GB are free"
    if free < LEAST_ROOM_BYTES:
        return fail("room", detail, "make room: uploads are refused soon")
    if free < GOOD_ROOM_BYTES:
        to_do = "make room, or let rendered songs take less by REINA_SONG_CACHE_MB"
        return warn("room", detail, to_do)
    return ok("room", detail)
