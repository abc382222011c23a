"""WAV (Microsoft RIFF/WAVE, and EBU Tech 3306's RF64): its header, read and written."""

import struct
from dataclasses import dataclass
from typing import BinaryIO

from reina.sessions.sound_facts import AudioFacts, BrokenAudioError, read_exactly

EXTENSIBLE = 0xFFFE
"""The format's code stands in an extension then."""

UNKNOWN_SIZES = (0, 0xFFFFFFFF)
"""What programs that stream write in place of a size that they do not know yet."""


def is_wav(head: bytes) -> bool:
    """Whether a file that begins so is RIFF/WAVE or its 64-bit form."""
    return head[:4] in (b"RIFF", b"RF64") and head[8:12] == b"WAVE"


@dataclass(frozen=True)
class WavSamples:
    """Where a WAV file's samples are, and what.

    Attributes:
        start: Byte at which they begin.
        bytes: How many bytes they fill.
        byte_rate: Bytes a second.
        sample_rate: Samples a second of one channel.
        channels: How many channels take turns.
        encoding: 1 for whole numbers, 3 for floats; others are compressed.
        bits: Of one sample.
    """

    start: int
    bytes: int
    byte_rate: int
    sample_rate: int
    channels: int
    encoding: int
    bits: int


def read_wav(file: BinaryIO, size: int) -> AudioFacts:
    """Read the format chunk, and the length from the data chunk's size (bounded by the file's)."""
    found = find_samples(file, size)
    return AudioFacts(found.bytes / found.byte_rate, found.sample_rate, found.channels)


def find_samples(file: BinaryIO, size: int) -> WavSamples:
    """Read a WAV file's headers up to its samples.

    Raises:
        BrokenAudioError: They contradict themselves or break off.
    """
    file.seek(12)
    byte_rate = sample_rate = channels = encoding = bits = 0
    while len(chunk := file.read(8)) == 8:
        name, length = struct.unpack("<4sI", chunk)
        if name == b"fmt ":
            fields = read_exactly(file, 16, "its format chunk")
            encoding, channels, sample_rate, byte_rate, _, bits = struct.unpack("<HHIIHH", fields)
            length -= 16
            if encoding == EXTENSIBLE and length >= 10:
                encoding = struct.unpack("<8xH", read_exactly(file, 10, "its format chunk"))[0]
                length -= 10
        elif name == b"data":
            if not (byte_rate and sample_rate and channels):
                raise BrokenAudioError("its data comes before a usable format chunk")
            present = size - file.tell()
            held = present if length in UNKNOWN_SIZES else min(length, present)
            if held == 0:
                raise BrokenAudioError("it holds no samples")
            return WavSamples(file.tell(), held, byte_rate, sample_rate, channels, encoding, bits)
        file.seek(max(0, length + length % 2), 1)
    raise BrokenAudioError("it has no data chunk")


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
