"""FLAC's STREAMINFO block (RFC 9639)."""

from typing import BinaryIO

from reina.sessions.sound_facts import AudioFacts, BrokenAudioError, read_exactly


def is_flac(head: bytes) -> bool:
    """Whether a file that begins so is FLAC."""
    return head.startswith(b"fLaC")


def read_flac(file: BinaryIO, size: int) -> AudioFacts:  # noqa: ARG001 - every reader is given the size
    """Read STREAMINFO: 20 bits of sample rate, 3 of channels − 1, 5 of depth − 1, 36 of samples."""
    file.seek(4)
    if read_exactly(file, 4, "its first block")[0] & 0x7F != 0:
        raise BrokenAudioError("its first block is not STREAMINFO")
    packed = int.from_bytes(read_exactly(file, 18, "STREAMINFO")[10:18], "big")
    sample_rate, channels, samples = packed >> 44, (packed >> 41 & 7) + 1, packed & (1 << 36) - 1
    if sample_rate == 0:
        raise BrokenAudioError("its sample rate is 0")
    duration_s = samples / sample_rate if samples else None
    return AudioFacts(duration_s=duration_s, sample_rate=sample_rate, channels=channels)
