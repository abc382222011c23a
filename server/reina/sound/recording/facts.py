"""What an audio file's headers say, and how they fail."""

from dataclasses import dataclass
from typing import BinaryIO


class BrokenAudioError(Exception):
    """Headers that contradict themselves or break off; the message completes "it looks like WAV, but ..."."""


@dataclass(frozen=True)
class AudioFacts:
    """Length in seconds, samples a second and channel count, each None where the headers do not say."""

    duration_s: float | None = None
    sample_rate: int | None = None
    channels: int | None = None


def read_exactly(file: BinaryIO, count: int, what: str) -> bytes:
    """Read `count` bytes.

    Raises:
        BrokenAudioError: The file ends before; the message names `what`.
    """
    data = file.read(count)
    if len(data) < count:
        raise BrokenAudioError(f"it ends within {what}")
    return data
