"""Where FLAC stands in a file, and how long it claims to be (RFC 9639)."""

from dataclasses import dataclass

from reina.sound.recording.facts import BrokenAudioError
from reina.sound.recording.flac_frames import next_frame
from reina.sound.recording.stream import Data, SoundStream, Splice

MARK = b"fLaC"
BEGINNINGS = (b"fLaC\x00\x00\x00\x22", b"fLaC\x80\x00\x00\x22")
"""The mark and the header of STREAMINFO, which comes first and may be the last block."""
LENGTH_AT = 21
"""The byte whose lower half begins the 36 bits that hold the number of samples."""
HEAD_BYTES = 26
INFO_END = 42
"""Where STREAMINFO ends."""


def is_flac(head: bytes) -> bool:
    """Whether a file that begins so is FLAC."""
    return head.startswith(MARK)


def flac_streams(data: Data, start: int) -> list[SoundStream]:
    """Return the FLAC files that follow one another in a file.

    Raises:
        BrokenAudioError: The first block is not STREAMINFO, or breaks off.
    """
    if data[start : start + len(BEGINNINGS[0])] not in BEGINNINGS:
        raise BrokenAudioError("its first block is not STREAMINFO")
    starts = sorted(_all_of(data, BEGINNINGS, start))
    return [
        unbounded_flac(data, (range(begin, end),))
        for begin, end in zip(starts, [*starts[1:], len(data)], strict=True)
    ]


def unbounded_flac(data: Data, pieces: tuple[range, ...]) -> SoundStream:
    """Return a FLAC file with its number of samples struck out, which a decoder would stop at.

    Args:
        data: The file that it is part of.
        pieces: Where it stands in it.

    Raises:
        BrokenAudioError: It breaks off within STREAMINFO.
    """
    whole = Splice(data, *pieces)
    head = bytearray(HEAD_BYTES)
    if whole.readinto(head) < HEAD_BYTES:
        raise BrokenAudioError("it ends within STREAMINFO")
    claimed = int.from_bytes(head[LENGTH_AT:HEAD_BYTES], "big") & (1 << 36) - 1
    head[LENGTH_AT:HEAD_BYTES] = bytes([head[LENGTH_AT] & 0xF0, 0, 0, 0, 0])
    splice = Splice(data, bytes(head), *_after(pieces, HEAD_BYTES))
    if len(pieces) != 1:
        return SoundStream(splice, claimed or None)
    # STREAMINFO as the only block of metadata, and what of it stands behind the length.
    info = b"fLaC\x80" + bytes(head[5:]) + data[pieces[0].start + HEAD_BYTES : pieces[0].start + INFO_END]
    return SoundStream(splice, claimed or None, resume=_Rest(data, info, pieces[0][INFO_END:], 0).after)


@dataclass(frozen=True)
class _Rest:
    """What follows a place in a FLAC file.

    Attributes:
        data: The file.
        info: Its beginning, STREAMINFO included.
        place: The rest.
        first: The sample that it begins with.
    """

    data: Data
    info: bytes
    place: range
    first: int

    def after(self, frames: int) -> SoundStream | None:
        """The frames behind the one that comes after so many samples, which is broken."""
        block_frames = int.from_bytes(self.info[8:10], "big")
        found = next_frame(self.data, self.place, block_frames, self.first + frames)
        if found is None:
            return None
        at, first = found
        place = range(at, self.place.stop)
        rest = _Rest(self.data, self.info, place, first)
        return SoundStream(Splice(self.data, self.info, place), claimed_frames=0, resume=rest.after)


def _after(pieces: tuple[range, ...], count: int) -> list[range]:
    """The pieces without the first `count` bytes."""
    rest: list[range] = []
    for piece in pieces:
        rest.append(piece[count:])
        count = max(0, count - len(piece))
    return rest


def _all_of(data: Data, marks: tuple[bytes, ...], start: int) -> set[int]:
    found: set[int] = set()
    for mark in marks:
        at = data.find(mark, start)
        while at >= 0:
            found.add(at)
            at = data.find(mark, at + 1)
    return found
