"""The boxes of MP4 files, M4A among them (ISO/IEC 14496-12): length, and whether there is sound inside."""

import struct
from collections.abc import Iterator
from typing import BinaryIO

from reina.sound.recording.facts import AudioFacts, BrokenAudioError, read_exactly

UNKNOWN_DURATIONS = (0, 0xFFFFFFFF, 0xFFFFFFFFFFFFFFFF)


def is_mp4(head: bytes) -> bool:
    """Whether a file that begins so is of the MP4 family (M4A, MP4, MOV)."""
    return head[4:8] == b"ftyp"


def read_mp4(file: BinaryIO, size: int) -> AudioFacts:
    """Find the movie header's length and a track with sound."""
    for name, start, end in _boxes(file, 0, size):
        if name != b"moov":
            continue
        duration_s, has_sound = None, False
        for inner, inner_start, inner_end in _boxes(file, start, end):
            if inner == b"mvhd":
                duration_s = _movie_duration(file, inner_start)
            elif inner == b"trak":
                has_sound = has_sound or _track_sounds(file, inner_start, inner_end)
        if not has_sound:
            raise BrokenAudioError("it holds no track of sound")
        return AudioFacts(duration_s=duration_s)
    raise BrokenAudioError("it has no moov box, so that it seems to be cut short")


def _boxes(file: BinaryIO, start: int, end: int) -> Iterator[tuple[bytes, int, int]]:
    """Yield each box between two offsets: its name, and where its content begins and ends."""
    while start + 8 <= end:
        file.seek(start)
        length, name = struct.unpack(">I4s", read_exactly(file, 8, "a box's header"))
        content = start + 8
        if length == 1:
            (length,) = struct.unpack(">Q", read_exactly(file, 8, "a box's header"))
            content += 8
        following = end if length == 0 else start + length
        if following < content:
            raise BrokenAudioError(f"its {name.decode('latin-1')} box has the impossible length {length}")
        yield name, content, min(following, end)
        start = following


def _movie_duration(file: BinaryIO, start: int) -> float | None:
    file.seek(start)
    version = read_exactly(file, 4, "the movie header")[0]
    layout = ">QQIQ" if version == 1 else ">IIII"
    _, _, scale, ticks = struct.unpack(
        layout, read_exactly(file, struct.calcsize(layout), "the movie header")
    )
    return ticks / scale if scale and ticks not in UNKNOWN_DURATIONS else None


def _track_sounds(file: BinaryIO, start: int, end: int) -> bool:
    for name, media_start, media_end in _boxes(file, start, end):
        if name != b"mdia":
            continue
        for inner, handler_start, _ in _boxes(file, media_start, media_end):
            if inner == b"hdlr":
                file.seek(handler_start + 8)
                return read_exactly(file, 4, "a track's handler") == b"soun"
    return False
