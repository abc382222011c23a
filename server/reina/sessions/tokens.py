"""Control tokens: who has a session's may change it."""

from __future__ import annotations

import hashlib
import hmac
import secrets
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from reina.sessions.record import SessionRecord


def new_token() -> str:
    """A control token: who has it may change the session."""
    return secrets.token_urlsafe(32)


def hash_token(token: str) -> str:
    """What is stored of a token. It is random already, so that a plain digest cannot be searched."""
    return hashlib.sha256(token.encode()).hexdigest()


def token_matches(record: SessionRecord, token: str) -> bool:
    """Whether a token is the session's, in constant time."""
    return hmac.compare_digest(hash_token(token), record.token_sha256)
