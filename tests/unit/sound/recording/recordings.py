"""Recordings made for the tests, and what real files do to them."""

from __future__ import annotations

import io
import struct
from typing import TYPE_CHECKING

import numpy as np
import soundfile

if TYPE_CHECKING:
    from collections.abc import Iterator

RATE = 44_100
LOUD = 0.5


def recording(
    form: str, coding: str | None = None, *, seconds: float = 1.0, rate: int = RATE, channels: int = 2
) -> bytes:
    """A tone that begins at once, as the named kind of file; `form` and `coding` are libsndfile's names."""
    time_s = np.arange(round(seconds * rate)) / rate
    tone = LOUD * np.sin(2 * np.pi * 441.0 * time_s)
    out = io.BytesIO()
    with soundfile.SoundFile(
        out, "w", samplerate=rate, channels=channels, format=form, subtype=coding
    ) as file:
        file.write(np.stack([tone] * channels, axis=1))
    return out.getvalue()


def wav(*, seconds: float = 1.0, rate: int = RATE, channels: int = 2) -> bytes:
    return recording("WAV", "PCM_16", seconds=seconds, rate=rate, channels=channels)


def id3(content: int) -> bytes:
    """An ID3v2 tag, with so many bytes in it."""
    size = bytes((content >> 21 & 127, content >> 14 & 127, content >> 7 & 127, content & 127))
    return b"ID3\x04\0\0" + size + bytes(content)


def patched(data: bytes, layout: str, at: int, value: int) -> bytes:
    """The same with a number written over what stands somewhere."""
    changed = bytearray(data)
    struct.pack_into(layout, changed, at, value)
    return bytes(changed)


def first_frame_bytes(mp3: bytes) -> int:
    """Length of the first frame of an MP3 of MPEG-1."""
    rates = (0, 32, 40, 48, 56, 64, 80, 96, 112, 128, 160, 192, 224, 256, 320)
    rate = (44100, 48000, 32000)[mp3[2] >> 2 & 3]
    return 144 * rates[mp3[2] >> 4] * 1000 // rate + (mp3[2] >> 1 & 1)


def flac_with_length(flac: bytes, samples: int) -> bytes:
    """The same FLAC with another number of samples claimed."""
    packed = int.from_bytes(flac[18:26], "big") >> 36 << 36 | samples
    return flac[:18] + packed.to_bytes(8, "big") + flac[26:]


def _crc_table() -> list[int]:
    table: list[int] = []
    for byte in range(256):
        value = byte << 24
        for _ in range(8):
            value = (value << 1 ^ (0x04C11DB7 if value & 0x80000000 else 0)) & 0xFFFFFFFF
        table.append(value)
    return table


_CRC = _crc_table()


def with_checksum(page: bytes) -> bytes:
    """An Ogg page with its checksum put right (RFC 3533)."""
    blank = page[:22] + bytes(4) + page[26:]
    value = 0
    for byte in blank:
        value = (value << 8 & 0xFFFFFFFF) ^ _CRC[value >> 24 ^ byte]
    return blank[:22] + struct.pack("<I", value) + blank[26:]


def ogg_page(content: bytes, *, granule: int = 0, serial: int = 7, number: int = 0, flags: int = 0) -> bytes:
    lacing = bytes([255] * (len(content) // 255) + [len(content) % 255])
    head = struct.pack("<4sBBqIIIB", b"OggS", 0, flags, granule, serial, number, 0, len(lacing))
    return with_checksum(head + lacing + content)


def ogg_pages(ogg: bytes) -> Iterator[bytes]:
    at = 0
    while at < len(ogg):
        content = at + 27 + ogg[at + 26]
        end = content + sum(ogg[at + 27 : content])
        yield ogg[at:end]
        at = end


def ogg_shifted(ogg: bytes, frames: int, *, last_alone: bool = False) -> bytes:
    """The same Ogg with the positions of its pages, or of the last alone, moved on."""
    pages = list(ogg_pages(ogg))
    moved: list[bytes] = []
    for number, page in enumerate(pages):
        (granule,) = struct.unpack_from("<q", page, 6)
        shift = granule > 0 and (not last_alone or number == len(pages) - 1)
        moved.append(with_checksum(page[:6] + struct.pack("<q", granule + frames * shift) + page[14:]))
    return b"".join(moved)


def flac_in_ogg(flac: bytes, packet_bytes: int = 4000) -> bytes:
    """FLAC mapped into Ogg (xiph.org's mapping 1.0), but for where packets are cut."""
    first, rest = flac[4:42], flac[42:]
    pages = [ogg_page(b"\x7fFLAC\x01\0\0\x01fLaC" + first, flags=2)]
    for number, at in enumerate(range(0, len(rest), packet_bytes), 1):
        pages.append(ogg_page(rest[at : at + packet_bytes], number=number))
    return b"".join(pages)


def riff(fields: bytes, samples: bytes, *, size: int | None = None) -> bytes:
    """A WAV of a format chunk and samples; `size` is what its data chunk claims."""
    chunks = b"fmt " + struct.pack("<I", len(fields)) + fields
    claimed = len(samples) if size is None else size
    chunks += b"data" + struct.pack("<I", claimed) + samples
    return b"RIFF" + struct.pack("<I", 4 + len(chunks)) + b"WAVE" + chunks


def box(name: bytes, content: bytes) -> bytes:
    return struct.pack(">I4s", 8 + len(content), name) + content


def mp4(handler: bytes = b"soun") -> bytes:
    """The boxes of an M4A of 1.5 s, without sound."""
    header = box(b"mvhd", bytes(4) + struct.pack(">IIII", 0, 0, 600, 900) + bytes(80))
    track = box(b"trak", box(b"tkhd", bytes(84)) + box(b"mdia", box(b"hdlr", bytes(8) + handler + bytes(13))))
    return box(b"ftyp", b"M4A \0\0\0\0M4A mp42") + box(b"mdat", bytes(50)) + box(b"moov", header + track)


def element(identifier: int, content: bytes) -> bytes:
    name = identifier.to_bytes((identifier.bit_length() + 7) // 8, "big")
    return name + (len(content) | 1 << 56).to_bytes(8, "big") + content


def webm(
    doc_type: bytes = b"webm", track_type: int = 2, duration: bytes = struct.pack(">d", 1500.0)
) -> bytes:
    """The elements of a WebM of 1.5 s, without sound."""
    info = element(0x1549A966, element(0x2AD7B1, (1_000_000).to_bytes(3, "big")) + element(0x4489, duration))
    tracks = element(0x1654AE6B, element(0xAE, element(0xD7, b"\1") + element(0x83, bytes([track_type]))))
    head = element(0x1A45DFA3, element(0x4282, doc_type)) + bytes.fromhex("18538067 01ffffffffffffff")
    return head + info + tracks + element(0x1F43B675, bytes(9))
