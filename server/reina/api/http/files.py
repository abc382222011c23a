"""Files that are served: found below a folder and nowhere else, and sent whole or in ranges."""

import asyncio
import hashlib
import os
import secrets
from collections import OrderedDict
from collections.abc import Mapping
from pathlib import Path

from fastapi.responses import FileResponse
from starlette.datastructures import Headers
from starlette.types import Receive, Scope, Send

from reina.api.http.problems import ProblemError
from reina.api.http.ranges import byte_ranges

REVALIDATED = "no-cache"
"""It is kept, and asked for each time; mostly the answer is 304."""
IMMUTABLE = "public, max-age=31536000, immutable"
"""For what has its content's hash in its name."""
TAG_BYTES = 16
TAGS_KEPT = 4096
"""Of so many files it is remembered what they hash to, as long as nothing has been written to them."""


def file_below(folder: Path, name: str) -> Path | None:
    """The regular file of a name below a folder, links followed; None where there is none.

    A name that leads out of the folder is none, nor is one that no file system can hold (NUL, too long).

    Args:
        folder: Where to look.
        name: A path below it, as it came in a request.
    """
    try:
        root = folder.resolve()
        path = (root / name).resolve()
        return path if path.is_relative_to(root) and path.is_file() else None
    except (OSError, ValueError):
        return None


_tags: OrderedDict[tuple[str, int, int, int], str] = OrderedDict()


async def _tag(path: Path, status: os.stat_result) -> str:
    """The validator of a file's content: the same on every server that has it, however it came there."""
    known = (str(path), status.st_ino, status.st_mtime_ns, status.st_size)
    tag = _tags.pop(known, None)
    if tag is None:
        tag = await asyncio.to_thread(_hashed, path)
    _tags[known] = tag
    if len(_tags) > TAGS_KEPT:
        _tags.popitem(last=False)
    return tag


def _hashed(path: Path) -> str:
    try:
        with path.open("rb") as content:
            return f'"{hashlib.file_digest(content, _hasher).hexdigest()}"'
    except OSError:
        # Gone since it was found: whoever sends it says so.
        return f'"{secrets.token_hex(TAG_BYTES)}"'


def _hasher() -> hashlib.blake2b:
    return hashlib.blake2b(digest_size=TAG_BYTES)


class ServedFile(FileResponse):
    """A file as it is answered with: whole, or the ranges that are asked for.

    Starlette sends it, but answers in plain text to a range that is malformed or of another unit, and refuses
    all ranges for one that lies beyond the end. So ranges are read here and handed on in plain form.

    Args:
        path: The file.
        media_type: By the file's name when None.
        caching: `REVALIDATED` or `IMMUTABLE`.
        headers: Beside those of every file.
    """

    def __init__(
        self,
        path: Path,
        *,
        media_type: str | None = None,
        caching: str = REVALIDATED,
        headers: Mapping[str, str] | None = None,
    ) -> None:
        super().__init__(path, media_type=media_type, headers={"Cache-Control": caching, **(headers or {})})
        self._file = path

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Send it."""
        try:
            self.stat_result = await asyncio.to_thread(self._file.stat)
        except OSError:
            # It was there when the request was read.
            gone = ProblemError(
                404, "file-gone", "The file is no more", "it has just been removed; ask again"
            )
            await gone.response()(scope, receive, send)
            return
        self.set_stat_headers(self.stat_result)
        self.headers["etag"] = await _tag(self._file, self.stat_result)
        headers = [(name, value) for name, value in scope["headers"] if name not in {b"range", b"if-range"}]
        ranges = self._ranges(Headers(scope=scope), self.stat_result.st_size)
        if ranges == []:
            await self._unsatisfiable(self.stat_result.st_size).response()(scope, receive, send)
            return
        if ranges:
            plain = ",".join(f"{first}-{last}" for first, last in ranges)
            headers.append((b"range", f"bytes={plain}".encode()))
        await super().__call__({**scope, "headers": headers}, receive, send)

    def _ranges(self, asked: Headers, size: int) -> list[tuple[int, int]] | None:
        header, validator = asked.get("range"), asked.get("if-range")
        if header is None:
            return None
        # RFC 9110, 13.1.5: a part is of use only beside the rest of the same bytes.
        if validator is not None and validator not in {self.headers["etag"], self.headers["last-modified"]}:
            return None
        return byte_ranges(header, size)

    def _unsatisfiable(self, size: int) -> ProblemError:
        kept = {name: self.headers[name] for name in ("etag", "last-modified", "cache-control")}
        return ProblemError(
            416,
            "range-not-satisfiable",
            "Range Not Satisfiable",
            f"the file has {size} bytes, and the ranges that were asked for lie beyond them",
            headers={"Content-Range": f"bytes */{size}", **kept},
        )
