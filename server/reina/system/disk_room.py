"""Whether there is room on the disk, and what says that there is not."""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
import threading
import time
from typing import TYPE_CHECKING

from reina.system.durable import open_own

if TYPE_CHECKING:
    from pathlib import Path

FULL = frozenset({errno.ENOSPC, errno.EDQUOT})
NO_ROOM = (
    "there is no room on the server's disk for this, and nothing was changed: end sessions that nobody needs "
    "or have whoever runs the server make room; what is there already can be watched and heard meanwhile"
)
"""What whoever asked for a write is told."""
LEAST_BYTES = 1_000_000
"""With less room than that a disk counts as full: an edit of a large show may be as long."""
PROBE_BYTES = 65_536
PROBED_EVERY_S = 1.0


def is_disk_full(error: BaseException) -> bool:
    """Whether an error says that there is no room: on the disk, or within a quota."""
    return isinstance(error, OSError) and error.errno in FULL


class DiskRoom:
    """Tells whether a folder can be written to. For several threads.

    A disk with room may still refuse, as by a quota. So after a write was refused it is tried out whether a
    small one is taken, until it is.

    Args:
        folder: Where is written; a probe is made in it.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._probing = threading.Lock()
        self._refused = False
        self._probed_s = -PROBED_EVERY_S

    def refused(self) -> None:
        """A write was refused for lack of room."""
        self._refused = True

    def is_there(self) -> bool:
        """Whether there is room; blocks as long as the disk takes."""
        status = os.statvfs(self._folder)
        if status.f_bavail * status.f_frsize < LEAST_BYTES:
            return False
        with self._probing:
            if self._refused and time.monotonic() - self._probed_s >= PROBED_EVERY_S:
                self._probed_s = time.monotonic()
                self._refused = not self._is_taken()
            return not self._refused

    def _is_taken(self) -> bool:
        probe = self._folder / f".probe-{secrets.token_hex(4)}"
        try:
            with open_own(probe) as file:
                file.write(bytes(PROBE_BYTES))
                file.flush()
                os.fsync(file.fileno())
        except OSError:
            return False
        else:
            return True
        finally:
            with contextlib.suppress(OSError):
                probe.unlink(missing_ok=True)
