"""AIFF and AIFF-C (Apple, 1989, 1991): how long they claim to be. The decoder finds the sound by itself."""

from collections.abc import Iterator

from reina.sound.recording.facts import BrokenAudioError
from reina.sound.recording.stream import Data, SoundStream, Splice

KINDS = (b"AIFF", b"AIFC")
COUNTED_BY_SAMPLE = frozenset(
    {b"NONE", b"sowt", b"twos", b"raw ", b"in24", b"in32"}
    | {b"fl32", b"FL32", b"fl64", b"FL64", b"alaw", b"ALAW", b"ulaw", b"ULAW"}
)
"""Codings whose number of frames is that of samples; the others count packets."""


def is_aiff(head: bytes) -> bool:
    """Whether a file that begins so is AIFF or AIFF-C."""
    return head[:4] == b"FORM" and head[8:12] in KINDS


def aiff_streams(data: Data, start: int) -> list[SoundStream]:
    """Return the file as it is: what its chunks say of lengths, the decoder does not go by.

    Raises:
        BrokenAudioError: It has no sound, or breaks off before.
    """
    claimed: int | None = None
    for name, content, _ in _chunks(data, start):
        if name == b"COMM":
            coding = data[content + 18 : content + 22] if data[start + 8 : start + 12] == b"AIFC" else b"NONE"
            if coding in COUNTED_BY_SAMPLE:
                claimed = int.from_bytes(data[content + 2 : content + 6], "big") or None
        elif name == b"SSND":
            return [SoundStream(Splice(data, range(start, len(data))), claimed)]
    raise BrokenAudioError("it has no chunk of sound")


def _chunks(data: Data, start: int) -> Iterator[tuple[bytes, int, int]]:
    """Yield each chunk: its name, where its content begins, and how long it says that this is."""
    at = start + 12
    while len(head := data[at : at + 8]) == 8:
        length = int.from_bytes(head[4:], "big")
        yield head[:4], at + 8, length
        at += 8 + length + length % 2
