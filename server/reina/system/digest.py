"""What a folder's files hold, in a word."""

from __future__ import annotations

import hashlib
from functools import cache
from pathlib import Path


def digest_of(folder: Path, *patterns: str) -> str:
    """SHA-256 of some files' names and contents, hexadecimal: the same wherever the folder lies.

    Args:
        folder: Where they are.
        patterns: Which, as `Path.glob` takes them.
    """
    digest = hashlib.sha256()
    for path in sorted({path for pattern in patterns for path in folder.glob(pattern)}):
        content = path.read_bytes()
        digest.update(f"{path.relative_to(folder).as_posix()} {len(content)}\n".encode())
        digest.update(content)
    return digest.hexdigest()


@cache
def code_digest() -> str:
    """Of Reina's own code: another version makes something else of the same."""
    return digest_of(Path(__file__).parents[1], "**/*.py")
