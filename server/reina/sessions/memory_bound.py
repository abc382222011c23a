"""Which sessions stay in memory: so many, and so many bytes together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from reina.sessions.limit_errors import PieceTooLargeError, ServerBusyError

if TYPE_CHECKING:
    from collections.abc import Iterable

    from reina.sessions.session import Session

MEGABYTE = 1_000_000
MEMORY_BYTES = 1000 * MEGABYTE
"""How many bytes the sessions in memory may weigh together, by `Session.weight`."""
IDLE_BYTES = 150 * MEGABYTE
"""How many of these the idle ones may have: one is loaded again when somebody comes."""
RETRY_S = 10
"""When to ask again: somebody may have stopped watching by then."""


@dataclass(frozen=True)
class MemoryBound:
    """How much may be loaded.

    Attributes:
        most_sessions: So many sessions; those that somebody watches or asks something of stay beyond it.
        most_bytes: So many bytes of them, of which nothing stays beyond it.
        most_idle_bytes: So many bytes of those that nobody watches or asks something of.
    """

    most_sessions: int
    most_bytes: int = MEMORY_BYTES
    most_idle_bytes: int = IDLE_BYTES

    def leaving(
        self, loaded: Iterable[Session], adding: int, *, coming: int = 0, staying: Session | None = None
    ) -> list[Session]:
        """Who has to go so that something more fits: idle ones, the least recently asked for first.

        Args:
            loaded: Those that are in memory, the least recently asked for first.
            adding: How many bytes come to them.
            coming: How many more are on their way.
            staying: A session that is not to go, whatever it does.

        Raises:
            PieceTooLargeError: It does not fit though there were nothing else.
            ServerBusyError: Too much of the rest is watched or asked for.
        """
        sessions = list(loaded)
        if adding > self.most_bytes:
            raise PieceTooLargeError(
                f"in memory this piece takes about {adding / MEGABYTE:.0f} MB, and all pieces together have "
                f"{self.most_bytes / MEGABYTE:.0f} MB (REINA_MEMORY_MB): send fewer notes or keyframes"
            )
        above = sum(session.weight for session in sessions) + adding + coming - self.most_bytes
        too_many = len(sessions) + (staying is None) - self.most_sessions
        idle = [session for session in sessions if session is not staying and session.is_idle]
        # What is new is idle until somebody joins it.
        new = adding + coming if staying is None else 0
        idle_above = sum(session.weight for session in idle) + new - self.most_idle_bytes
        leaving: list[Session] = []
        for session in idle:
            if above <= 0 and too_many <= 0 and idle_above <= 0:
                break
            leaving.append(session)
            above -= session.weight
            idle_above -= session.weight
            too_many -= 1
        if above > 0:
            raise ServerBusyError(
                f"the pieces that are being watched take all of the {self.most_bytes / MEGABYTE:.0f} MB that "
                "the server keeps pieces in; try again when somebody has stopped watching",
                retry_after_s=RETRY_S,
            )
        return leaving
