"""Memory that was freed goes back to the system."""

from __future__ import annotations

import ctypes
import sys

M_MMAP_THRESHOLD = -3
"""Of malloc.h."""
LARGE_BYTES = 256 * 1024
"""A block of so many bytes is a mapping of its own. What is evaluated for each frame is smaller."""


def return_large_blocks() -> bool:
    """Have each large block go back to the system as soon as it is freed; returns whether it will.

    By itself glibc takes its bound for these blocks from what is freed, up to 32 MB (mallopt(3)). After the
    first large body it would keep all that was needed for others, since something small lies behind it.
    """
    if sys.platform != "linux":
        return False
    mallopt = getattr(ctypes.CDLL(None), "mallopt", None)
    return mallopt is not None and bool(mallopt(M_MMAP_THRESHOLD, LARGE_BYTES))
