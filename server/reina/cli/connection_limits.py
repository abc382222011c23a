"""How many connections there may be, and how long each may keep the server waiting."""

from __future__ import annotations

import resource
from dataclasses import dataclass

from reina.cli.environment import seconds, whole_number

MOST = 4096
"""Connections in all, where the file limit allows so many: 6 kB each while they are silent."""
MOST_AN_ADDRESS = 512
"""Of one address: a classroom behind one has six a browser and one that watches."""
HEADER_S = 10.0
IDLE_S = 30.0
STALL_S = 60.0
LEAST_BYTES_A_SECOND = 1000
SILENT_S = 40.0
MOST_FILES = 65_536
"""Beyond that the file limit is not raised, however high it may be."""
FILES_KEPT = 96
"""Files that connections do not get, and a quarter of all: those of sessions, of uploads, of workers."""


@dataclass(frozen=True)
class ConnectionLimits:
    """What connections are held to.

    Attributes:
        most: How many there may be in all.
        most_an_address: How many there may be from one address; loopback's are not counted.
        header_s: How long a request's head may take, from the connection's beginning or its own first byte.
        idle_s: How long a connection may wait for its next request.
        stall_s: How long a body that comes in, or an answer that goes out, may move more slowly than
            `least_bytes_a_second` on the average.
        least_bytes_a_second: The floor of both.
        silent_s: How long a viewer that answers no ping is there.
    """

    most: int = MOST
    most_an_address: int = MOST_AN_ADDRESS
    header_s: float = HEADER_S
    idle_s: float = IDLE_S
    stall_s: float = STALL_S
    least_bytes_a_second: int = LEAST_BYTES_A_SECOND
    silent_s: float = SILENT_S

    @property
    def floor_bytes(self) -> float:
        """Bytes that have to move within `stall_s`."""
        return self.stall_s * self.least_bytes_a_second

    @property
    def most_requests(self) -> int:
        """How many connections may have requests: a quarter stays free for those who come to watch."""
        return self.most - self.most // 4

    @property
    def most_watching(self) -> int:
        """How many may watch: a quarter stays free for requests."""
        return self.most - self.most // 4

    @classmethod
    def of_environment(cls, files: int) -> ConnectionLimits:
        """The limits as the environment sets them.

        Args:
            files: How many files the process may have open.

        Raises:
            InputError: One is no number that fits.
        """
        room = max(8, files - max(FILES_KEPT, files // 4))
        return cls(
            most=min(whole_number("REINA_MOST_CONNECTIONS", MOST), room),
            most_an_address=whole_number("REINA_MOST_CONNECTIONS_AN_ADDRESS", MOST_AN_ADDRESS),
            header_s=seconds("REINA_HEADER_S", HEADER_S),
            idle_s=seconds("REINA_IDLE_S", IDLE_S),
            stall_s=seconds("REINA_STALL_S", STALL_S),
            least_bytes_a_second=whole_number("REINA_LEAST_BYTES_A_SECOND", LEAST_BYTES_A_SECOND),
            silent_s=seconds("REINA_SILENT_S", SILENT_S),
        )


def raise_file_limit() -> int:
    """Let the process have as many files open as it is allowed to ask for; returns how many."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    most = MOST_FILES if hard == resource.RLIM_INFINITY else min(hard, MOST_FILES)
    if soft == resource.RLIM_INFINITY or soft >= most:
        return MOST_FILES if soft == resource.RLIM_INFINITY else soft
    try:
        resource.setrlimit(resource.RLIMIT_NOFILE, (most, hard))
    except (OSError, ValueError):
        # Some systems name a limit that they do not grant.
        return soft
    return most
