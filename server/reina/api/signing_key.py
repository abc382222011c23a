"""The key that a server signs with: its own, or one that several share."""

from __future__ import annotations

import hashlib
import secrets
from typing import TYPE_CHECKING

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
