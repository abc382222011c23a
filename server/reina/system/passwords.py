"""Passwords: what is kept of one, and whether another is the same."""

from __future__ import annotations

import base64
import hashlib
import hmac
import re
import secrets

COST, BLOCK, LANES = 2**15, 8, 1
"""scrypt's N, r and p: 32 MB and about a tenth of a second for each password that is tried."""
MEMORY_BYTES = 64 * 1024 * 1024
MOST_COST = 2**17
UNMATCHED = f"scrypt${COST}${'A' * 22}${'A' * 43}"
"""In the form of a hash, but of no password that anybody knows: to try one against takes as long as any."""
_HASH = re.compile(r"scrypt\$(\d{1,7})\$([A-Za-z0-9_-]{22})\$([A-Za-z0-9_-]{43})")


def is_password_hash(text: str) -> bool:
    """Whether a text is what `hash_password` gives, and not a password itself."""
    match = _HASH.fullmatch(text)
    return match is not None and _is_cost(int(match[1]))


def hash_password(password: str) -> str:
    """What is kept of a password: ``scrypt$<N>$<salt>$<hash>``; takes a tenth of a second."""
    salt = secrets.token_bytes(16)
    return f"scrypt${COST}${_text(salt)}${_text(_derived(password, salt, COST))}"


def password_matches(stored: str, password: str) -> bool:
    """Whether a password is the one that a hash was made of; takes a tenth of a second.

    Raises:
        ValueError: `stored` is no hash.
    """
    match = _HASH.fullmatch(stored)
    if match is None or not _is_cost(int(match[1])):
        raise ValueError("this is no hash of a password")
    derived = _derived(password, base64.urlsafe_b64decode(f"{match[2]}=="), int(match[1]))
    return hmac.compare_digest(_text(derived), match[3])


def _is_cost(cost: int) -> bool:
    return 1024 <= cost <= MOST_COST and cost & (cost - 1) == 0


def _derived(password: str, salt: bytes, cost: int) -> bytes:
    memory = MEMORY_BYTES * max(1, cost // COST)
    return hashlib.scrypt(
        password.encode("utf-8", "surrogatepass"),
        salt=salt,
        n=cost,
        r=BLOCK,
        p=LANES,
        maxmem=memory,
        dklen=32,
    )


def _text(data: bytes) -> str:
    return base64.urlsafe_b64encode(data).decode().rstrip("=")
