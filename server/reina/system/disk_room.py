"""Whether there is room on the disk, and what says that there is not."""

from __future__ import annotations

import errno
import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

FULL = frozenset({errno.ENOSPC, errno.EDQUOT})
NO_ROOM = (
    "there is no room on the server's disk for this, and nothing was changed: end sessions that nobody needs "
    "or have whoever runs the server make room; what is there already can be watched and heard meanwhile"
)
"""What whoever asked for a write is told."""
LEAST_BYTES = 1_000_000
"""With less room than that a disk counts as full: a show may be as long."""


def is_disk_full(error: BaseException) -> bool:
    """Whether an error says that there is no room: on the disk, or within a quota."""
    return isinstance(error, OSError) and error.errno in FULL


def has_room(folder: Path) -> bool:
    """Whether there is room on the disk that a folder is on; blocks as long as the disk takes to say."""
    status = os.statvfs(folder)
    return status.f_bavail * status.f_frsize >= LEAST_BYTES
