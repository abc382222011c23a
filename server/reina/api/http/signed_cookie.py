"""What a browser keeps of a sign-in: a text that only the server can have written."""

from __future__ import annotations

import base64
import hashlib
import hmac
import json
from typing import Any


def sealed(key: bytes, said: dict[str, Any], beside: str) -> str:
    """A text that holds what is said, and a signature.

    Args:
        key: The server's.
        said: JSON.
        beside: What is signed with it, and has to be the same when it is read.
    """
    text = base64.urlsafe_b64encode(json.dumps(said).encode()).decode().rstrip("=")
    return f"{text}.{_signature(key, text, beside)}"


def claimed(cookie: str) -> dict[str, Any] | None:
    """What a text says, whoever wrote it; None where it says nothing."""
    text, _, _ = cookie.partition(".")
    try:
        said: object = json.loads(base64.urlsafe_b64decode(text + "=" * (-len(text) % 4)))
    except (ValueError, RecursionError):
        return None
    return said if isinstance(said, dict) else None  # pyright: ignore[reportUnknownVariableType] - of JSON


def is_sealed(key: bytes, cookie: str, beside: str) -> bool:
    """Whether the server wrote it, in constant time."""
    text, _, signature = cookie.partition(".")
    return hmac.compare_digest(_signature(key, text, beside).encode(), signature.encode())


def _signature(key: bytes, text: str, beside: str) -> str:
    return hmac.new(key, f"{text}\0{beside}".encode(), hashlib.sha256).hexdigest()
