"""The EBML elements of WebM (RFC 8794, RFC 9559): length, and whether there is sound inside."""

import struct
from collections.abc import Iterator
from typing import BinaryIO

from reina.sound.recording.facts import AudioFacts, BrokenAudioError, read_exactly

EBML_HEADER, SEGMENT, INFO, TRACKS, CLUSTER = 0x1A45DFA3, 0x18538067, 0x1549A966, 0x1654AE6B, 0x1F43B675
TIMESTAMP_SCALE, DURATION, DOC_TYPE = 0x2AD7B1, 0x4489, 0x4282
TRACK_ENTRY, TRACK_TYPE, TRACK_TYPE_AUDIO = 0xAE, 0x83, 2
DEFAULT_SCALE_NS = 1_000_000


def is_webm(head: bytes) -> bool:
    """Whether a file that begins so is Matroska, and so perhaps WebM."""
    return head.startswith(EBML_HEADER.to_bytes(4, "big"))


def read_webm(file: BinaryIO, size: int) -> AudioFacts:
    """Read the length from the segment's Info, where it stands, and look for a track of sound."""
    duration_s, has_sound = None, False
    for element, start, end in _elements(file, 0, size):
        if element == EBML_HEADER:
            inside = _elements(file, start, end)
            kinds = [_content(file, at, to) for name, at, to in inside if name == DOC_TYPE]
            if b"webm" not in [kind.rstrip(b"\0") for kind in kinds]:
                raise BrokenAudioError("it is Matroska of another kind than WebM")
        elif element == SEGMENT:
            for inner, inner_start, inner_end in _elements(file, start, end):
                if inner == CLUSTER:
                    break
                if inner == INFO:
                    duration_s = _duration(file, inner_start, inner_end)
                elif inner == TRACKS:
                    has_sound = has_sound or _tracks_sound(file, inner_start, inner_end)
            break
    if not has_sound:
        raise BrokenAudioError("it holds no track of sound")
    return AudioFacts(duration_s=duration_s)


def _duration(file: BinaryIO, start: int, end: int) -> float | None:
    scale_ns, ticks = DEFAULT_SCALE_NS, None
    for name, at, to in _elements(file, start, end):
        if name == TIMESTAMP_SCALE:
            scale_ns = int.from_bytes(_content(file, at, to), "big")
        elif name == DURATION and to - at in (4, 8):
            (ticks,) = struct.unpack(">f" if to - at == 4 else ">d", _content(file, at, to))
    return ticks * scale_ns / 1e9 if ticks and ticks > 0 else None


def _tracks_sound(file: BinaryIO, start: int, end: int) -> bool:
    return any(
        int.from_bytes(_content(file, at, to), "big") == TRACK_TYPE_AUDIO
        for entry, entry_start, entry_end in _elements(file, start, end)
        if entry == TRACK_ENTRY
        for name, at, to in _elements(file, entry_start, entry_end)
        if name == TRACK_TYPE
    )


def _content(file: BinaryIO, start: int, end: int) -> bytes:
    file.seek(start)
    return read_exactly(file, min(end - start, 64), "an element")


def _elements(file: BinaryIO, start: int, end: int) -> Iterator[tuple[int, int, int]]:
    """Yield each element between two offsets: its id, and where its content begins and ends."""
    while start < end:
        file.seek(start)
        identifier, _ = _number(file, keep_marker=True)
        length, unknown = _number(file, keep_marker=False)
        content = file.tell()
        if content > end:
            raise BrokenAudioError("an element's header breaks off")
        following = end if unknown else min(content + length, end)
        yield identifier, content, following
        start = following


def _number(file: BinaryIO, *, keep_marker: bool) -> tuple[int, bool]:
    """Read a number of variable width, and whether all its bits are set (a size that is not known)."""
    first = read_exactly(file, 1, "an element's header")[0]
    width = 9 - first.bit_length()
    if width > 8:
        raise BrokenAudioError("an element's header is broken")
    number = int.from_bytes(bytes([first]) + read_exactly(file, width - 1, "an element's header"), "big")
    largest = (1 << 7 * width) - 1
    return (number if keep_marker else number & largest), number & largest == largest
