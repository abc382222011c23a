"""What is kept of a session beside its files."""

from __future__ import annotations

import hashlib
import hmac
import re
import secrets
from datetime import UTC, datetime
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from reina.protocol.resources import Warned  # noqa: TC001 - pydantic reads it
from reina.sessions.production import PLAYER

SESSION_ID = re.compile(r"[A-Za-z0-9_-]{22}")
"""128 random bits, base64url."""


class SongRecord(BaseModel):
    """An uploaded song, as it was decoded."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    file: str
    media_type: str
    duration_s: float | None
    warnings: tuple[Warned, ...] = ()
    """What its sender should know."""


class SessionRecord(BaseModel):
    """session.json."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    id: Annotated[str, Field(pattern=f"^{SESSION_ID.pattern}$")]
    title: str
    public: bool
    created_at: str
    token_sha256: str
    instrument: str
    part: int
    transposition: int
    written: bool = False
    """Whether the part is notated for the instrument."""
    player: str = PLAYER
    """Who plays."""
    octave_fit: bool = False
    """Whether the part is moved into range by octaves."""
    joined_parts: tuple[int, ...] = ()
    """Further parts that the player plays together with it."""
    sequence: int | None = None
    """Which of the score's sequences; None: nobody chose, and the first is played."""
    score_filename: str | None
    """The name that the score was uploaded under."""
    song: SongRecord | None
    """None: the server renders the score."""
    song_time_s: float = 0.0
    """Where the clock stood when the session was last put away."""


def new_id() -> str:
    """An id that cannot be guessed: who has it may watch."""
    return secrets.token_urlsafe(16)


def new_token() -> str:
    """A control token: who has it may change the session."""
    return secrets.token_urlsafe(32)


def hash_token(token: str) -> str:
    """What is stored of a token. It is random already, so that a plain digest cannot be searched."""
    return hashlib.sha256(token.encode()).hexdigest()


def token_matches(record: SessionRecord, token: str) -> bool:
    """Whether a token is the session's, in constant time."""
    return hmac.compare_digest(hash_token(token), record.token_sha256)


def created_now() -> str:
    """The present as ISO 8601, UTC."""
    return datetime.now(UTC).isoformat(timespec="seconds")
