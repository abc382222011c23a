"""How much memory one call takes at most, for a fuzz that `tracemalloc` would make six times as slow."""

from __future__ import annotations

import os
import resource
import tracemalloc
from pathlib import Path

CLEAR = "/proc/self/clear_refs"
RESET_PEAK = b"5"
"""What makes Linux forget how much was resident at most (proc_pid_clear_refs(5))."""
ALLOWED_BYTES = 2**30
"""How much more the process may ask for, touched or not: what a file merely claims is refused here."""


class PeakMemory:
    """Measures from `begin` to `used`: what is resident on Linux, else what Python and NumPy allocate."""

    def __init__(self) -> None:
        self._before = 0
        self._clear: int | None = None
        try:
            self._clear = os.open(CLEAR, os.O_WRONLY)
            os.write(self._clear, RESET_PEAK)
        except OSError:
            self._clear = None
            tracemalloc.start()
        else:
            pages = int(Path("/proc/self/statm").read_text().split()[0])
            most = pages * resource.getpagesize() + ALLOWED_BYTES
            resource.setrlimit(resource.RLIMIT_AS, (most, resource.getrlimit(resource.RLIMIT_AS)[1]))

    def begin(self) -> None:
        """Begin to measure."""
        if self._clear is None:
            tracemalloc.reset_peak()
            self._before = tracemalloc.get_traced_memory()[0]
        else:
            os.write(self._clear, RESET_PEAK)
            self._before = _most_resident()

    def used(self) -> int:
        """The most bytes since then that were in use beyond what was before."""
        most = _most_resident() if self._clear is not None else tracemalloc.get_traced_memory()[1]
        return most - self._before


def _most_resident() -> int:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
