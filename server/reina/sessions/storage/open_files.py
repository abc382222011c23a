"""Finds what keeps the large files by its address."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from reina.errors import InputError
from reina.sessions.storage.local_files import LocalFiles
from reina.sessions.storage.s3_files import CACHE_BYTES, S3Files

if TYPE_CHECKING:
    from reina.sessions.storage.file_store import FileStore

FILES, CACHE = "files", "cache"


def files_at(url: str | None, data_dir: Path, *, cache_bytes: int = CACHE_BYTES) -> FileStore:
    """Open what keeps the large files.

    Args:
        url: ``s3://bucket/prefix?endpoint=…&region=…`` as of `S3Files`, a folder of this machine, or None for
            the folder in the data directory.
        data_dir: The server's data directory; what is fetched from elsewhere is in it too.
        cache_bytes: How much there may be of what was fetched.

    Raises:
        InputError: The address is none, or what it needs is not installed.
    """
    if url is None:
        return LocalFiles(data_dir / FILES)
    if url.startswith("s3:"):
        return S3Files(url, data_dir / CACHE / FILES, cache_bytes=cache_bytes)
    if "://" in url:
        raise InputError(
            f"{url.partition(':')[0]!r} is no kind of file store that Reina knows: "
            "name s3://bucket/prefix, or a folder"
        )
    return LocalFiles(Path(url))
