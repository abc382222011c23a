"""A score as the HTTP interface writes it, kept packed: read often, the same for all, and long."""

from __future__ import annotations

import hashlib
import zlib
from dataclasses import dataclass
from typing import TYPE_CHECKING

from reina.system.json_text import json_text

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

PIECE = 1 << 18
"""Bytes that are packed, unpacked or sent at a time."""
LEVEL = 3
RAW = -zlib.MAX_WBITS
GZIP_HEAD = bytes([0x1F, 0x8B, 8, 0, 0, 0, 0, 0, 0, 0xFF])
"""RFC 1952, 2.3: deflated, without name or time, by no particular system."""


@dataclass(frozen=True)
class PackedScore:
    """All of a score's JSON but its title, which alone may change while it is played so.

    A line holds a note, so that notes can be left out without being read.

    Attributes:
        packed: Deflated (RFC 1951), and ended at a byte, so that other blocks can follow.
        checksum: CRC-32 of what is packed.
        size: How long it is unpacked, bytes.
        digest: Its SHA-256, hexadecimal.
    """

    packed: bytes
    checksum: int
    size: int
    digest: str

    @classmethod
    def of(cls, lines: Iterable[bytes]) -> PackedScore:
        """Pack a score's JSON, which comes in pieces.

        Args:
            lines: A line for what comes before the notes, one for each note, which all but the first begins
                with a comma, and the end of their list.
        """
        packing = zlib.compressobj(LEVEL, wbits=RAW)
        pieces: list[bytes] = []
        checksum = size = 0
        digest = hashlib.sha256()
        for text in lines:
            pieces.append(packing.compress(text))
            checksum, size = zlib.crc32(text, checksum), size + len(text)
            digest.update(text)
        pieces.append(packing.flush(zlib.Z_FULL_FLUSH))
        return cls(b"".join(pieces), checksum, size, digest.hexdigest())

    def etag(self, title: str, part: int | None) -> str:
        """The validator of an answer, in quotes."""
        named = f"{self.digest} {part} {title}".encode("utf-8", "backslashreplace")
        return f'"{hashlib.sha256(named).hexdigest()[:24]}"'

    def gzipped(self, title: str) -> tuple[list[memoryview], int]:
        """The whole score as gzip (RFC 1952): nothing but the title is packed anew.

        Returns:
            Pieces, and how many bytes they are.
        """
        end = _end(title)
        packing = zlib.compressobj(LEVEL, wbits=RAW)
        sums = zlib.crc32(end, self.checksum), (self.size + len(end)) % 2**32
        tail = packing.compress(end) + packing.flush() + b"".join(n.to_bytes(4, "little") for n in sums)
        packed = memoryview(self.packed)
        pieces = [packed[at : at + PIECE] for at in range(0, len(packed), PIECE)]
        return [memoryview(GZIP_HEAD), *pieces, memoryview(tail)], len(GZIP_HEAD) + len(packed) + len(tail)

    def plain(self, title: str, wanted: list[bool] | None = None) -> Iterator[bytes]:
        """The score unpacked, piece by piece.

        Args:
            title: What it is called.
            wanted: Of each note whether it is wanted; all are when None.
        """
        if wanted is None:
            yield from self._unpacked()
        else:
            yield from _chosen(self._unpacked(), wanted)
        yield _end(title)

    def _unpacked(self) -> Iterator[bytes]:
        unpacking = zlib.decompressobj(RAW)
        rest = self.packed
        while rest or unpacking.unconsumed_tail:
            yield unpacking.decompress(rest, PIECE)
            rest = unpacking.unconsumed_tail


def _end(title: str) -> bytes:
    return b',"title":' + json_text(title) + b"}"


def _chosen(pieces: Iterator[bytes], wanted: list[bool]) -> Iterator[bytes]:
    """The lines of a score, with some of its notes."""
    number, separator, rest = -1, b"", b""
    for piece in pieces:
        *lines, rest = (rest + piece).split(b"\n")
        kept: list[bytes] = []
        for line in lines:
            if number < 0:
                kept.append(line)
            elif wanted[number]:
                kept.append(separator + line.removeprefix(b","))
                separator = b","
            number += 1
        if kept:
            yield b"\n".join([*kept, b""])
    yield rest
