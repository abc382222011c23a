"""What a backup is: a tar file of what a data directory keeps, and at its end every file's digest."""

from __future__ import annotations

import re
from pathlib import PurePosixPath

from pydantic import BaseModel, ConfigDict

from reina.errors import InputError
from reina.sessions.storage.database import FILE as DATABASE

MANIFEST = "manifest.json"
FORMAT = "reina-backup"
VERSION = 1
SIGNING_KEY = "signing-key"
"""What the server signs with; without it everybody is signed out."""
FOLDERS = ("files", "sessions")
"""What is kept beside the database. Rendered songs are made anew, and staging is of uploads under way."""
LARGEST_MANIFEST = 500_000_000
AT_ONCE = 1_000_000
"""Bytes that are read, hashed and written at a time."""
CONTENT_NAMED = re.compile(r"files/[0-9a-f]{2}/([0-9a-f]{64})")
"""A file whose name is its own digest."""
_NAME = re.compile(r"[\w.-]+", re.ASCII)


class ArchiveError(InputError):
    """A backup cannot be made or used; the message says why."""


class Entry(BaseModel):
    """One file of a backup."""

    model_config = ConfigDict(strict=True, extra="forbid")

    size: int
    sha256: str


class ArchiveManifest(BaseModel):
    """What a backup holds.

    Attributes:
        format: `FORMAT`.
        version: `VERSION`.
        reina: The version that made it.
        created_at: When, ISO 8601, UTC.
        files: Each by its path below the data directory.
    """

    model_config = ConfigDict(strict=True, extra="forbid")

    format: str
    version: int
    reina: str
    created_at: str
    files: dict[str, Entry]


def is_kept(name: str) -> bool:
    """Whether a path below the data directory, with ``/``, is one that backups hold."""
    parts = PurePosixPath(name).parts
    if name in {DATABASE, SIGNING_KEY}:
        return True
    plain = all(_NAME.fullmatch(part) and not part.startswith(".") for part in parts)
    return len(parts) > 1 and parts[0] in FOLDERS and plain and "/".join(parts) == name
