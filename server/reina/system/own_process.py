"""How processes that the server starts for long work behave."""

import os
import sys
from collections.abc import Callable
from types import TracebackType
from typing import BinaryIO

from reina.system.failure import failure_of

NICENESS = 5
"""They yield to the server, whose frames are due."""


def yield_to_server() -> None:
    """Let the server have the processor when it wants it, also where it was given real-time priority."""
    if hasattr(os, "sched_setscheduler"):
        os.sched_setscheduler(0, os.SCHED_BATCH, os.sched_param(0))
    if hasattr(os, "nice"):
        os.nice(NICENESS)


def complain_in_a_line() -> None:
    """Say what ends the process in one line on standard error, which the server reads."""
    sys.excepthook = _complain


def _complain(kind: type[BaseException], error: BaseException, _trace: TracebackType | None) -> None:
    failure = failure_of(error)
    if not issubclass(kind, KeyboardInterrupt):
        print(f"{failure.kind}: {failure.message} ({failure.place})", file=sys.stderr)  # noqa: T201


def end_with_parent() -> None:
    """Wait until standard input is closed, which tells that the server is gone, and end the process then."""
    # Past Python's buffer, whose lock a waiting reader would still hold when the process ends.
    while os.read(sys.stdin.fileno(), 1):
        pass
    os._exit(2)


def read_from_parent(count: int) -> bytes:
    """Read so many bytes from standard input and none more, so that `follow_parent` misses nothing."""
    parts: list[bytes] = []
    while count and (part := os.read(sys.stdin.fileno(), min(count, 1 << 20))):
        parts.append(part)
        count -= len(part)
    return b"".join(parts)


def follow_parent(take: Callable[[int], None]) -> None:
    """Hand on the numbers that come on standard input, one a line; end the process when it is closed."""
    pending = b""
    while part := os.read(sys.stdin.fileno(), 256):
        *lines, pending = (pending + part).split(b"\n")
        for line in lines:
            take(int(line))
    os._exit(2)


def take_output() -> BinaryIO:
    """Standard output for answers alone: what a library prints goes to standard error."""
    told = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    return told


def bound_memory(most_bytes: int) -> None:
    """Hold the process to so much address space, most of it libraries; what wants more fails."""
    try:
        import resource
    except ImportError:  # not on Windows
        return
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (most_bytes, hard))
