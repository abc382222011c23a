"""What is refused because there is no room for it, though nothing is wrong with it."""

from __future__ import annotations

from reina.errors import InputError


class LimitError(InputError):
    """A bound of the server's is reached.

    Args:
        message: Which, how much there is, and what would help.
        retry_after_s: After how many seconds it may be worth trying again; None where only somebody's doing
            helps.
    """

    def __init__(self, message: str, *, retry_after_s: int | None = None) -> None:
        super().__init__(message)
        self.retry_after_s = retry_after_s


class ServerBusyError(LimitError):
    """The server has too much at hand at present."""


class NoRoomError(LimitError):
    """The server's disk, or what its operator gives of it, is full."""


class SenderLimitError(LimitError):
    """One sender has as much as one may have."""


class PieceTooLargeError(LimitError):
    """A piece needs more than the server will ever have."""
