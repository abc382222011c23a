"""What a browser keeps of a sign-in: a text that only the server can have written."""

from __future__ import annotations

import base64
import hashlib
import hmac
import json
import secrets
from typing import TYPE_CHECKING, Any

from reina.errors import InputError
from reina.sessions.storage.archive import SIGNING_KEY

if TYPE_CHECKING:
    from pathlib import Path

KEY_BYTES = 32


def signing_key(data_dir: Path, shared: Path | None = None) -> bytes:
    """The server's own key, made when it is needed first, for nobody else to read; or several servers'.

    Args:
        data_dir: Has its own.
        shared: The file of a secret that all of them have.

    Raises:
        InputError: That file cannot be read, or holds too little to be a secret.
    """
    if shared is not None:
        return _shared_key(shared)
    path = data_dir / SIGNING_KEY
    try:
        key = path.read_bytes()
    except FileNotFoundError:
        key = b""
    if len(key) == KEY_BYTES:
        return key
    path.unlink(missing_ok=True)
    path.touch(mode=0o600)
    key = secrets.token_bytes(KEY_BYTES)
    path.write_bytes(key)
    return key


def _shared_key(path: Path) -> bytes:
    try:
        secret = path.read_bytes().strip()
    except OSError as error:
        raise InputError(f"REINA_SIGNING_KEY_FILE={path} cannot be read: {error.strerror}") from error
    if len(secret) < KEY_BYTES:
        raise InputError(
            f"REINA_SIGNING_KEY_FILE={path} holds {len(secret)} bytes; a secret has {KEY_BYTES} at least: "
            "openssl rand -hex 32 makes one"
        )
    return hashlib.sha256(secret).digest()


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
