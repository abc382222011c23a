"""How processes that the server starts for long work behave."""

import os
import sys

NICENESS = 5
"""They yield to the server, whose frames are due."""


def end_with_parent() -> None:
    """Wait until standard input is closed, which tells that the server is gone, and end the process then."""
    # Past Python's buffer, whose lock a waiting reader would still hold when the process ends.
    while os.read(sys.stdin.fileno(), 1):
        pass
    os._exit(2)
