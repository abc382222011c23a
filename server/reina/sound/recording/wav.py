"""WAV (Microsoft RIFF/WAVE, and EBU Tech 3306's RF64): where its samples stand, and a header to write."""

import struct
from collections.abc import Iterator

from reina.sound.recording.facts import BrokenAudioError
from reina.sound.recording.stream import Data, SoundStream, Splice

STREAMED = 0x7FFF0000
"""A size as large as this, or 0, stands in place of one that the writer did not know yet; the file goes on to
its end then. RF64 tells the size in a chunk of its own."""
UNCOMPRESSED = (1, 3, 6, 7, 0xFFFE)
"""Codes of encodings whose samples all have the same number of bits."""


def is_wav(head: bytes) -> bool:
    """Whether a file that begins so is RIFF/WAVE or its 64-bit form."""
    return head[:4] in (b"RIFF", b"RF64") and head[8:12] == b"WAVE"


def wav_streams(data: Data, start: int) -> list[SoundStream]:
    """Return the samples under a header that says nothing but their format: sizes may be wrong or missing.

    Raises:
        BrokenAudioError: There is no data chunk after a format chunk, or nothing is in it.
    """
    form: bytes | None = None
    long_size = 0
    for name, content, length in _chunks(data, start):
        if name == b"ds64":
            long_size = int.from_bytes(data[content + 8 : content + 16], "little")
        elif name == b"fmt ":
            form = data[content : min(content + length, content + 64)]
        elif name == b"data":
            if form is None or len(form) < 16 or 0 in struct.unpack_from("<2xHI", form):
                raise BrokenAudioError("its data comes before a usable format chunk")
            size = length if 0 < length < STREAMED else long_size
            held = min(size or len(data), len(data) - content)
            if held <= 0:
                raise BrokenAudioError("it holds no samples")
            header = _riff(form, held)
            return [
                SoundStream(Splice(data, header, range(content, content + held)), _frames(form, size) or None)
            ]
    raise BrokenAudioError("it has no data chunk")


def _chunks(data: Data, start: int) -> Iterator[tuple[bytes, int, int]]:
    """Yield each chunk: its name, where its content begins, and how long it says that this is."""
    at = start + 12
    while len(head := data[at : at + 8]) == 8:
        name, length = struct.unpack("<4sI", head)
        yield name, at + 8, length
        at += 8 + length + length % 2


def _riff(form: bytes, size: int) -> bytes:
    """What stands before samples, for a format chunk's content."""
    form += bytes(len(form) % 2)
    riff = struct.pack("<4sI4s", b"RIFF", 20 + len(form) + size, b"WAVE")
    return riff + struct.pack("<4sI", b"fmt ", len(form)) + form + struct.pack("<4sI", b"data", size)


def _frames(form: bytes, size: int) -> int:
    """How many samples of each channel so many bytes hold; 0 where the format does not tell."""
    encoding, channels, _, _, _, bits = struct.unpack_from("<HHIIHH", form)
    frame_bytes = channels * (bits // 8)
    return size // frame_bytes if encoding in UNCOMPRESSED and frame_bytes else 0


def wav_header(frames: int, *, sample_rate: int, channels: int) -> bytes:
    """The 44 bytes before 16-bit samples.

    Args:
        frames: How many samples each channel has.
        sample_rate: Samples a second.
        channels: 1 or 2.
    """
    frame_bytes = 2 * channels
    data_bytes = frames * frame_bytes
    riff = struct.pack("<4sI4s", b"RIFF", 36 + data_bytes, b"WAVE")
    fields = (16, 1, channels, sample_rate, sample_rate * frame_bytes, frame_bytes, 16)
    return riff + struct.pack("<4sIHHIIHH", b"fmt ", *fields) + struct.pack("<4sI", b"data", data_bytes)
