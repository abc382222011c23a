"""What the machine gives the server."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from reina.cli.doctor.finding import fail, ok, warn

if TYPE_CHECKING:
    from collections.abc import Iterator

    from reina.cli.doctor.finding import Finding

LEAST_FILES, GOOD_FILES = 256, 4096
"""Open files: each viewer is one, each process some."""
LEAST_MEMORY_BYTES, GOOD_MEMORY_BYTES = 500_000_000, 2_000_000_000
MEMORY = Path("/proc/meminfo")
CONTAINER_MEMORY = Path("/sys/fs/cgroup/memory.max")


def machine_checks() -> Iterator[Finding]:
    """How many files may be open, how much memory there is, how many processors."""
    yield files_finding(_most_files())
    yield memory_finding(_memory_bytes())
    count = os.cpu_count() or 1
    if count < 2:
        yield warn("processors", "1", "two or more let uploads be read while frames are sent")
    else:
        yield ok("processors", str(count))


def files_finding(most: int | None) -> Finding:
    """What a bound of open files means; None where there is none to be known."""
    if most is None:
        return ok("open files", "no bound is known")
    to_do = "raise the bound: `ulimit -Hn 65536`, or LimitNOFILE= of a systemd unit"
    if most < LEAST_FILES:
        return fail("open files", f"{most} at most", to_do)
    if most < GOOD_FILES:
        return warn("open files", f"{most} at most, so many viewers and less", to_do)
    return ok("open files", f"{most:,} at most")


def memory_finding(total: int | None) -> Finding:
    """What so much memory means, bytes; None where it is not known."""
    if total is None:
        return ok("memory", "not known here")
    detail = f"{total / 1e9:.1f} GB"
    if total < LEAST_MEMORY_BYTES:
        return fail("memory", detail, "half a gigabyte at least is needed, two for large scores")
    if total < GOOD_MEMORY_BYTES:
        return warn("memory", detail, "two gigabytes let large scores be read and songs be rendered")
    return ok("memory", detail)


def _most_files() -> int | None:
    try:
        import resource
    except ImportError:  # not on Windows
        return None
    # The server raises its own bound up to this one.
    _, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    return None if hard == resource.RLIM_INFINITY else hard


def _memory_bytes() -> int | None:
    """Memory of the machine, or of the container where that has less."""
    try:
        line = next(line for line in MEMORY.read_text().splitlines() if line.startswith("MemTotal:"))
    except (OSError, StopIteration):
        return None
    total = int(line.split()[1]) * 1024
    try:
        bound = CONTAINER_MEMORY.read_text().strip()
    except OSError:
        return total
    return min(total, int(bound)) if bound.isdecimal() else total
