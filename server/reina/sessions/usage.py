"""How much of the disk sessions take, of all senders and of one; and how much they may."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from reina.sessions.limit_errors import NoRoomError, SenderLimitError

if TYPE_CHECKING:
    from collections.abc import Callable

MEGABYTE = 1_000_000
RETRY_S = 3600
"""When to ask again where others' sessions may have been ended by then."""


@dataclass(frozen=True)
class Usage:
    """What there is.

    Attributes:
        sessions: How many sessions.
        bytes: How large their files are together.
    """

    sessions: int
    bytes: int


@dataclass(frozen=True)
class DiskBound:
    """How much there may be; 0 is no bound.

    Attributes:
        most_bytes: All sessions' files together.
        most_bytes_of_sender: Those that came from one address.
        most_sessions_of_sender: How many sessions may come from one address.
    """

    most_bytes: int = 20_000 * MEGABYTE
    most_bytes_of_sender: int = 5_000 * MEGABYTE
    most_sessions_of_sender: int = 500

    def require(self, usage: Callable[[str | None], Usage], sender: str, adding: int) -> None:
        """See that another session of a sender may be kept.

        Args:
            usage: What there is of a sender, or of all (None).
            sender: Who sends it; "" where that is not known, and nobody is counted.
            adding: How large it is, as far as it has come.

        Raises:
            SenderLimitError: The sender has as much as one may have.
            NoRoomError: All together have.
        """
        own = usage(sender) if sender else Usage(0, 0)
        if self.most_sessions_of_sender and own.sessions >= self.most_sessions_of_sender:
            raise SenderLimitError(
                f"{own.sessions} sessions came from your address, and {self.most_sessions_of_sender} is the "
                "most that one may keep here: end some of them"
            )
        if self.most_bytes_of_sender and own.bytes + adding > self.most_bytes_of_sender:
            raise SenderLimitError(
                f"sessions from your address take {_shown(own.bytes)}, this one {_shown(adding)} so far, and "
                f"{_shown(self.most_bytes_of_sender)} is the most that one may keep here: end some of them"
            )
        if self.most_bytes and (taken := usage(None).bytes) + adding > self.most_bytes:
            raise NoRoomError(
                f"all sessions take {_shown(taken)}, this one {_shown(adding)} so far, and the server keeps "
                f"{_shown(self.most_bytes)} at most: try again when some have been ended",
                retry_after_s=RETRY_S,
            )


def _shown(count: int) -> str:
    return f"{count / MEGABYTE:,.1f} MB"
