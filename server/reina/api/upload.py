"""A multipart upload, written to files as it comes in and held to its limits on the way."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, BinaryIO

from python_multipart.exceptions import FormParserError
from python_multipart.multipart import MultipartParser, parse_options_header

from reina.api.http.filename import filename_of
from reina.api.http.problems import ProblemError
from reina.api.http.upload_limits import FIELD_LIMITS, LIMITS, MEGABYTE

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from python_multipart.multipart import MultipartCallbacks
    from starlette.requests import Request

AT_ONCE = MEGABYTE
"""Bytes of a form that are written at a time."""


@dataclass
class UploadedFile:
    """One uploaded file."""

    path: Path
    filename: str | None
    """What the sender calls it."""


@dataclass
class Upload:
    """What came."""

    files: dict[str, UploadedFile] = field(default_factory=dict[str, UploadedFile])
    fields: dict[str, str] = field(default_factory=dict[str, str])


async def receive_upload(
    request: Request, folder: Path, grow: Callable[[int], None] = lambda _: None
) -> Upload:
    """Write the parts of a multipart request into a folder, each under its own name.

    Args:
        request: What comes in.
        folder: Where its files go.
        grow: Told of bytes before they are written, on any thread; what it raises is raised on.

    Raises:
        ProblemError: 415 when it is no multipart form, 400 when it is malformed, 413 when a part is too
            large, 422 for a part that is not known or comes twice.
    """
    kind, options = parse_options_header(request.headers.get("content-type"))
    boundary = options.get(b"boundary")
    if kind != b"multipart/form-data" or not boundary:
        raise ProblemError(
            415,
            "not-a-form",
            "Unsupported Media Type",
            "send a multipart/form-data form with the file `score`, and `song` and `show` if there are any",
        )
    writer = _PartWriter(folder, grow)
    try:
        parser = MultipartParser(boundary, writer.callbacks())
    except FormParserError as error:
        raise _malformed(str(error)) from error
    try:
        pending = bytearray()
        async for chunk in request.stream():
            pending += chunk
            if len(pending) >= AT_ONCE:
                # A disk can keep a write waiting for as long as it likes.
                await asyncio.to_thread(parser.write, bytes(pending))
                pending.clear()
        await asyncio.to_thread(parser.write, bytes(pending))
    except FormParserError as error:
        raise _malformed(str(error)) from error
    finally:
        await asyncio.to_thread(writer.close)
    if not writer.complete:
        raise _malformed("it ends before its last boundary")
    return writer.upload


def _malformed(why: str) -> ProblemError:
    return ProblemError(400, "form-malformed", "Bad Request", f"the form is malformed: {why}")


class _PartWriter:
    """The parser's callbacks: headers in pieces, then data in pieces."""

    def __init__(self, folder: Path, grow: Callable[[int], None]) -> None:
        self._grow = grow
        self.upload = Upload()
        self.complete = False
        self._folder = folder
        self._file: BinaryIO | None = None
        self._text: bytearray | None = None
        self._name = ""
        self._size = 0
        self._header = (bytearray(), bytearray())
        self._headers: dict[bytes, bytes] = {}

    def callbacks(self) -> MultipartCallbacks:
        return {
            "on_part_begin": self._headers.clear,
            "on_header_field": lambda data, start, end: self._header[0].extend(data[start:end]),
            "on_header_value": lambda data, start, end: self._header[1].extend(data[start:end]),
            "on_header_end": self._end_header,
            "on_headers_finished": self._begin,
            "on_part_data": lambda data, start, end: self._write(data[start:end]),
            "on_part_end": self._end,
            "on_end": self._finish,
        }

    def close(self) -> None:
        if self._file:
            self._file.close()
            self._file = None

    def _end_header(self) -> None:
        name, value = self._header
        self._headers[bytes(name).lower()] = bytes(value)
        self._header = (bytearray(), bytearray())

    def _begin(self) -> None:
        disposition = self._headers.get(b"content-disposition", b"")
        _, options = parse_options_header(disposition)
        self._name = options.get(b"name", b"").decode("utf-8", "replace")
        self._size = 0
        if self._name not in LIMITS:
            known = ", ".join(LIMITS)
            detail = f"the form has a part {self._name!r}; it may have {known}"
            raise ProblemError(422, "unknown-part", "The form does not fit", detail)
        if self._name in self.upload.files or self._name in self.upload.fields:
            detail = f"the form has {self._name} twice; one is played at a time"
            raise ProblemError(422, "part-twice", "The form does not fit", detail)
        if self._name in FIELD_LIMITS:
            self._text = bytearray()
            return
        path = self._folder / self._name
        filename = filename_of(options.get(b"filename"), disposition)
        self.upload.files[self._name] = UploadedFile(path, filename)
        self._file = path.open("wb")

    def _write(self, data: bytes) -> None:
        self._size += len(data)
        limit = LIMITS[self._name]
        if self._size > limit:
            shown = f"{limit // MEGABYTE} MB" if limit >= MEGABYTE else f"{limit} bytes"
            detail = f"{self._name} is larger than {shown}"
            raise ProblemError(413, f"{self._name}-too-large", "Content Too Large", detail)
        if self._file:
            self._grow(len(data))
            self._file.write(data)
        elif self._text is not None:
            self._text += data

    def _end(self) -> None:
        self.close()
        if self._text is not None:
            self.upload.fields[self._name] = self._text.decode("utf-8", "replace")
            self._text = None

    def _finish(self) -> None:
        self.complete = True
