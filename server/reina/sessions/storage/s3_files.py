"""Large files in a store that speaks S3, with a part of them on this machine's disk."""

from __future__ import annotations

import contextlib
import hashlib
import os
import secrets
import threading
import time
from contextlib import contextmanager
from datetime import timedelta
from typing import TYPE_CHECKING, Any
from urllib.parse import parse_qsl, urlsplit

from reina.errors import InputError
from reina.sessions.storage.file_store import StoreAwayError, StoredFile, StoredFileLostError, StoreFullError
from reina.sessions.storage.local_files import DIGEST, DRAFT, LocalFiles, measured
from reina.system.disk_room import is_disk_full
from reina.system.durable import open_own

if TYPE_CHECKING:
    from collections.abc import Generator, Iterator
    from pathlib import Path

OPTIONS = frozenset({"endpoint", "region"})
"""What a store's address may say after its `?`."""
PIECE = 8_000_000
"""Bytes that are sent or fetched with one request; the last may be shorter."""
AT_ONCE = 4
"""Pieces of one file that are sent at the same time."""
CACHE_BYTES = 5_000_000_000
REQUEST_S, CONNECT_S, TRIES_S = 30, 5, 60
"""How long one request may take, how long until it is connected, and how long it is tried again, seconds."""
MOST_TRIES = 4
FETCHES = 64
"""So many files may be fetched at the same time."""


class S3Files:
    """Files by their content in a bucket, below a prefix: ``prefix/ab/abcdef…``. For several threads.

    What is read is fetched once and kept on disk, until there is too much of that: what was asked for the
    longest ago goes first.

    Args:
        url: ``s3://bucket/prefix``; ``?endpoint=http://host:port`` where it is not Amazon's, ``&region=``.
            Credentials, and what is not said here, come from the environment (``AWS_ACCESS_KEY_ID``,
            ``AWS_SECRET_ACCESS_KEY``, ``AWS_ENDPOINT_URL``, ``AWS_REGION``).
        cache: A folder for what was fetched. Staged files are best on the same file system.
        cache_bytes: How much of it there may be; a single file may be larger.
        most_tries: How often a request that fails is sent at most.

    Raises:
        InputError: The address is none, or the client is not installed.
    """

    def __init__(
        self, url: str, cache: Path, *, cache_bytes: int = CACHE_BYTES, most_tries: int = MOST_TRIES
    ) -> None:
        try:
            import obstore
        except ModuleNotFoundError as error:
            raise InputError('keeping files in S3 needs a client for it: pip install "reina[s3]"') from error
        # Its types are of stores that are not told apart here.
        self._client: Any = obstore
        self._bucket, self._prefix, options = _parts(url)
        self._name = f"s3://{self._bucket}"
        self._store = _open_bucket(self._client, self._bucket, options, most_tries)
        self._cache_folder = cache
        self._cached = LocalFiles(cache)
        self._cache_bytes = cache_bytes
        self._making_room = threading.Lock()
        self._fetching = [threading.Lock() for _ in range(FETCHES)]

    def keep(self, file: Path) -> StoredFile:
        """See `FileStore.keep`; it is in the store then, and mostly on this machine too."""
        kept = measured(file)
        with self._asking():
            # What is there already may be damaged: it is sent in any case.
            self._client.put(
                self._store,
                self._key(kept.digest),
                file,
                use_multipart=kept.size > PIECE,
                chunk_size=PIECE,
                max_concurrency=AT_ONCE,
            )
        # The store has it; where the disk has no room for it besides, it is fetched when it is asked for.
        with contextlib.suppress(StoreFullError):
            self._make_room(kept.size)
            self._cached.keep(file)
        return kept

    def path(self, digest: str) -> Path:
        """See `FileStore.path`; fetched where this machine does not have it."""
        if not DIGEST.fullmatch(digest):
            raise StoredFileLostError(f"no file is called {digest[:16]!r}")
        with self._fetching[int(digest[:8], 16) % FETCHES]:
            try:
                path = self._cached.path(digest)
            except StoredFileLostError:
                self._fetch(digest)
                path = self._cached.path(digest)
        _touch(path)
        return path

    def remove(self, digest: str) -> None:
        """See `FileStore.remove`."""
        if DIGEST.fullmatch(digest):
            with self._asking(), contextlib.suppress(FileNotFoundError):
                self._client.delete(self._store, self._key(digest))
            self._cached.remove(digest)

    def files(self) -> Iterator[StoredFile]:
        """See `FileStore.files`."""
        with self._asking():
            for some in self._client.list(self._store, prefix=self._prefix or None):
                for found in some:
                    digest = found["path"].rpartition("/")[2]
                    if DIGEST.fullmatch(digest) and found["path"] == self._key(digest):
                        yield StoredFile(digest, found["size"])

    def _key(self, digest: str) -> str:
        return f"{self._prefix}{digest[:2]}/{digest}"

    def _fetch(self, digest: str) -> None:
        """Bring a file into the cache.

        Raises:
            StoredFileLostError: The store does not have it, or has something else.
        """
        key = self._key(digest)
        draft = self._cache_folder / f"{DRAFT}{secrets.token_hex(8)}"
        try:
            with self._asking():
                size: int = self._client.head(self._store, key)["size"]
            self._make_room(size)
            hashed = hashlib.sha256()
            with open_own(draft) as file:
                # Each piece is a request of its own, whose time is bounded, however long the whole takes.
                for start in range(0, size, PIECE):
                    end = min(start + PIECE, size)
                    with self._asking():
                        piece = self._client.get_range(self._store, key, start=start, end=end)
                    hashed.update(piece)
                    file.write(piece)
            if hashed.hexdigest() != digest:
                raise StoredFileLostError(
                    f"the file {digest[:16]}… in {self._name} is damaged; restore it from a backup"
                )
            self._cached.keep(draft)
        except FileNotFoundError as error:
            raise StoredFileLostError(
                f"{self._name} has no file {digest[:16]}… any more; restore it from a backup"
            ) from error
        except OSError as error:
            if is_disk_full(error):
                raise StoreFullError from error
            raise
        finally:
            draft.unlink(missing_ok=True)

    def _make_room(self, size: int) -> None:
        """Put away what was asked for the longest ago, until so many bytes more fit into the cache."""
        with self._making_room:
            used: list[tuple[int, StoredFile]] = []
            for file in self._cached.files():
                with contextlib.suppress(FileNotFoundError):
                    used.append((_last_use_ns(self._cache_folder / file.digest[:2] / file.digest), file))
            total = sum(file.size for _, file in used)
            for _, file in sorted(used, key=lambda each: each[0]):
                if total + size <= self._cache_bytes:
                    break
                self._cached.remove(file.digest)
                total -= file.size

    @contextmanager
    def _asking(self) -> Generator[None]:
        """Turn what goes wrong with the store into what is told of it.

        Raises:
            FileNotFoundError: It does not have what was asked for.
            StoreAwayError: It does not answer, or not to this server.
        """
        errors = self._client.exceptions
        try:
            yield
        except (errors.PermissionDeniedError, errors.UnauthenticatedError) as error:
            raise StoreAwayError(
                f"{self._name}, where the large files are, does not let the server in: its owner has to "
                "set its credentials anew (AWS_ACCESS_KEY_ID, AWS_SECRET_ACCESS_KEY)"
            ) from error
        except errors.BaseError as error:
            raise StoreAwayError(
                f"{self._name}, where the large files are, does not answer; try again in a moment"
            ) from error


def _parts(url: str) -> tuple[str, str, dict[str, str]]:
    """Bucket, prefix ("" or with a "/" at its end) and options of a store's address.

    Raises:
        InputError: It is none.
    """
    parts = urlsplit(url)
    if parts.scheme != "s3" or not parts.hostname or parts.netloc != parts.hostname:
        raise InputError(
            "an S3 store's address is s3://bucket/prefix, with nothing but letters, digits, - and . in the "
            "bucket's name; its credentials are in the environment (AWS_ACCESS_KEY_ID, AWS_SECRET_ACCESS_KEY)"
        )
    options = dict(parse_qsl(parts.query, keep_blank_values=True))
    if unknown := set(options) - OPTIONS:
        known = " and ".join(sorted(OPTIONS))
        raise InputError(f"an S3 store's address has no option {min(unknown)!r}; it may have {known}")
    prefix = parts.path.strip("/")
    return parts.hostname, f"{prefix}/" if prefix else "", options


def _open_bucket(client: Any, bucket: str, options: dict[str, str], most_tries: int) -> Any:
    endpoint = (
        options.get("endpoint") or os.environ.get("AWS_ENDPOINT_URL_S3") or os.environ.get("AWS_ENDPOINT_URL")
    )
    config = dict(options)
    # A store without regions is asked with any.
    if "region" not in config and not (os.environ.get("AWS_REGION") or os.environ.get("AWS_DEFAULT_REGION")):
        config["region"] = "us-east-1"
    return client.store.S3Store(
        bucket,
        config=config,
        client_options={
            "allow_http": (endpoint or "").startswith("http://"),
            "connect_timeout": timedelta(seconds=CONNECT_S),
            "timeout": timedelta(seconds=REQUEST_S),
        },
        retry_config={
            "max_retries": most_tries - 1,
            "retry_timeout": timedelta(seconds=TRIES_S),
            "backoff": {
                "init_backoff": timedelta(milliseconds=100),
                "max_backoff": timedelta(seconds=5),
                "base": 2,
            },
        },
    )


def _last_use_ns(path: Path) -> int:
    return path.stat().st_atime_ns


def _touch(path: Path) -> None:
    """Note that a file was asked for now; the time of its content stays, by which it is known to be whole."""
    with contextlib.suppress(OSError):
        status = path.stat()
        os.utime(path, ns=(time.time_ns(), status.st_mtime_ns))
