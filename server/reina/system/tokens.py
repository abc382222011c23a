"""Tokens that cannot be guessed, and what is kept of them."""

from __future__ import annotations

import hashlib
import hmac
import secrets


def new_token() -> str:
    """256 random bits as text."""
    return secrets.token_urlsafe(32)


def hash_token(token: str) -> str:
    """What is stored of a token. It is random already, so that a plain digest cannot be searched."""
    return hashlib.sha256(token.encode()).hexdigest()


def token_matches(sha256: str, token: str) -> bool:
    """Whether a token is the one whose hash was stored, in constant time."""
    return hmac.compare_digest(hash_token(token), sha256)
