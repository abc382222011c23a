"""Scores that come compressed: gzip'd, or in a ZIP archive.

Nothing is unpacked beyond the limit of a score's size, whatever an archive says of the sizes in it, and
archives inside of archives are not opened.
"""

import io
import struct
import zipfile
import zlib
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import PurePath, PurePosixPath

from reina.music.errors import ScoreError, ScoreLimitError
from reina.music.file_kinds import HEAD_BYTES, kind_of, kind_of_zip
from reina.music.limits import Limits
from reina.music.musicxml.detect import is_musicxml

GZIP_MAGIC = b"\x1f\x8b"
ZIP_MAGICS = (b"PK\x03\x04", b"PK\x05\x06")
ZIP_ENTRY = b"PK\x01\x02"

CHUNK_BYTES = 64 * 1024
MAX_MEMBERS = 1000
"""Gzip files that may stand one after another in one."""
MAX_FILES = 1000
"""Files of a ZIP archive."""
MAX_NAMED = 5
LONGEST_NAME = 200

CONTAINER = "META-INF/container.xml"
"""What names the document of compressed MusicXML (.mxl)."""
CONTAINER_BYTES = 64 * 1024
WANTED = "a MIDI file (.mid), MusicXML or a JSON score in it would be right"

MIDI_SUFFIXES = frozenset({".mid", ".midi", ".smf", ".kar", ".rmi"})
MUSICXML_SUFFIXES = frozenset({".musicxml", ".mxl", ".xml"})
JSON_WORDS = (b'"tracks"', b'"parts"', b'"header"', b'"reina-score"')
"""One of these stands near the beginning of a JSON score, beside other JSON."""

DAMAGE = (
    zipfile.BadZipFile,
    zlib.error,
    struct.error,
    EOFError,
    IndexError,
    NotImplementedError,
    OSError,
    RuntimeError,
    ValueError,
)
"""What `zipfile` raises on an archive that is not as it should be."""


@dataclass(frozen=True)
class Unpacked:
    """A file out of a compressed one.

    Attributes:
        data: The file.
        name: Its name, or None if it is not known.
        told: What was done, for the sender; "" where that is how such files are.
    """

    data: bytes
    name: str | None
    told: str


def unpack(data: bytes, *, filename: str | None, limits: Limits) -> Unpacked | None:
    """Return the score in a gzip'd file or in a ZIP archive; None if `data` is neither.

    Raises:
        ScoreError: If it is damaged or encrypted, or holds no score, or several.
        ScoreLimitError: If it unpacks to more than `limits` has of bytes, or holds very many files.
    """
    if data.startswith(GZIP_MAGIC):
        name = PurePath(filename).stem if filename and filename.lower().endswith(".gz") else filename
        return Unpacked(_gunzip(data, limits.size_bytes), name, "a gzip'd file was unpacked")
    if data.startswith(ZIP_MAGICS):
        count = data.count(ZIP_ENTRY)
        if count > MAX_FILES:
            raise ScoreLimitError(
                f"the ZIP archive holds {count:,} files; at most {MAX_FILES:,} are looked through"
            )
        try:
            with zipfile.ZipFile(io.BytesIO(data)) as archive:
                return _unzip(archive, limits.size_bytes)
        except DAMAGE as error:
            raise ScoreError(f"the ZIP archive is damaged ({error}); zip the score anew") from error
    return None


def _too_large(most: int, location: str) -> ScoreLimitError:
    return ScoreLimitError(f"unpacks to more than {most:,} bytes, the most that is read", location=location)


def _gunzip(data: bytes, most: int) -> bytes:
    view = memoryview(data)
    pieces: list[bytes] = []
    size = at = members = 0
    while data.startswith(GZIP_MAGIC, at):
        members += 1
        if members > MAX_MEMBERS:
            raise ScoreLimitError(f"more than {MAX_MEMBERS:,} gzip'd files in one", location=f"byte {at}")
        inflater = zlib.decompressobj(wbits=31)
        while not inflater.eof:
            chunk = view[at : at + CHUNK_BYTES]
            if not len(chunk):
                raise ScoreError("the gzip'd file breaks off; compress the score anew", location=f"byte {at}")
            try:
                piece = inflater.decompress(chunk, most - size + 1)
            except zlib.error as error:
                raise ScoreError(
                    f"the gzip'd file is damaged ({error}); compress the score anew", location=f"byte {at}"
                ) from error
            at += len(chunk) - len(inflater.unconsumed_tail) - len(inflater.unused_data)
            size += len(piece)
            pieces.append(piece)
            if size > most:
                raise _too_large(most, "gzip")
    return b"".join(pieces)


def _unzip(archive: zipfile.ZipFile, most: int) -> Unpacked:
    files = [entry for entry in archive.infolist() if not _is_hidden(entry)]
    if not files:
        raise ScoreError(f"the ZIP archive is empty; {WANTED}")
    program = kind_of_zip([entry.filename for entry in archive.infolist()])
    if program is not None:
        raise ScoreError(str(program))
    document = _named_document(archive, files)
    if document is not None:
        return Unpacked(_read(archive, document, most), None, "")
    if len(files) == 1:
        scores = files
    else:
        heads = [_head(archive, entry) for entry in files]
        scores = [e for e, head in zip(files, heads, strict=True) if _is_score(e, head)]
        if not scores:
            kinds = [kind_of(head) for head in heads]
            named = [
                f"{_name(entry)} ({kind.name})" if kind else _name(entry)
                for entry, kind in zip(files, kinds, strict=True)
            ]
            raise ScoreError(f"the ZIP archive holds no score, but {_some(named)}; {WANTED}")
    if len(scores) > 1:
        raise ScoreError(
            f"the ZIP archive holds {len(scores)} scores ({_some(map(_name, scores))}); send one of them"
        )
    (entry,) = scores
    data = _read(archive, entry, most)
    others = len(files) - 1
    beside = f"; {others} other file{'s' if others > 1 else ''} in it left aside" if others else ""
    return Unpacked(data, _name(entry), f"{_name(entry)} was taken out of a ZIP archive{beside}")


def _named_document(archive: zipfile.ZipFile, files: Iterable[zipfile.ZipInfo]) -> zipfile.ZipInfo | None:
    """Return the document of compressed MusicXML, None if its container names none that is there."""
    by_name = {entry.filename: entry for entry in files}
    container = by_name.get(CONTAINER)
    if container is None:
        return None
    from reina.music.musicxml.container import document_path

    path = document_path(_read(archive, container, CONTAINER_BYTES))
    return by_name.get(path) if path else None


def _is_hidden(entry: zipfile.ZipInfo) -> bool:
    """Return whether an entry is a folder, or what file managers put beside one's files."""
    parts = PurePosixPath(entry.filename).parts
    return (
        not parts
        or entry.is_dir()
        or parts[0] == "__MACOSX"
        or parts[-1].lower() in {"thumbs.db", "desktop.ini"}
        or any(part.startswith(".") for part in parts)
    )


def _name(entry: zipfile.ZipInfo) -> str:
    return PurePosixPath(entry.filename.replace("\\", "/")).name[-LONGEST_NAME:]


def _some(names: Iterable[str]) -> str:
    listed = list(names)
    more = len(listed) - MAX_NAMED
    return ", ".join(listed[:MAX_NAMED]) + (f" and {more} more" if more > 0 else "")


def _can_be_read(entry: zipfile.ZipInfo) -> bool:
    # Of the other methods zipfile unpacks whole blocks at once, however large they become.
    return not entry.flag_bits & 1 and entry.compress_type in {zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED}


def _head(archive: zipfile.ZipFile, entry: zipfile.ZipInfo) -> bytes:
    """Return the first bytes of a file, none if it cannot be read."""
    if not _can_be_read(entry):
        return b""
    try:
        with archive.open(entry) as file:
            return file.read(HEAD_BYTES)
    except DAMAGE:
        return b""


def _is_score(entry: zipfile.ZipInfo, head: bytes) -> bool:
    if PurePath(_name(entry)).suffix.lower() in MIDI_SUFFIXES:
        return True
    is_midi = head.startswith(b"MThd") or (head.startswith(b"RIFF") and head.startswith(b"RMID", 8))
    return (
        is_midi
        or is_musicxml(head)
        or (head.lstrip()[:1] == b"{" and any(word in head for word in JSON_WORDS))
    )


def _read(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, most: int) -> bytes:
    name = _name(entry)
    if entry.flag_bits & 1:
        raise ScoreError("is encrypted; zip it without a password, or send it as it is", location=name)
    if not _can_be_read(entry):
        raise ScoreError(
            "is compressed by a method that is not read; zip it with deflate, as is usual",
            location=name,
        )
    with archive.open(entry) as file:
        data = file.read(most + 1)
    if len(data) > most:
        raise _too_large(most, name)
    return data
