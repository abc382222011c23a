"""What goes wrong with what is kept."""

from __future__ import annotations

from reina.errors import InputError


class DatabaseError(InputError):
    """The database cannot be used as it is."""


class DatabaseAwayError(DatabaseError):
    """The database does not answer now; it may later."""


class SessionGoneError(InputError):
    """A session was to be changed that is not there."""


class ChangedElsewhereError(InputError):
    """A session was to be changed that another server has changed since it was read."""


class SessionDamagedError(InputError):
    """A session is kept, and cannot be read.

    Attributes:
        session_id: Which.
        token_sha256: Of the token that may end it; empty where that is not known either.
    """

    def __init__(self, session_id: str, why: str, token_sha256: str = "") -> None:
        super().__init__(
            f"the session {session_id!r} is kept and cannot be read: {why}; "
            "DELETE with its control token ends it, and a backup may have it whole"
        )
        self.session_id = session_id
        self.token_sha256 = token_sha256
