"""Sound within a file, as a decoder is given it: pieces of the file, joined into one."""

import io
import mmap
from bisect import bisect_right
from dataclasses import dataclass
from itertools import accumulate
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from _typeshed import WriteableBuffer

Data = bytes | mmap.mmap
"""A whole file: in memory, or mapped into it."""


class Splice(io.RawIOBase):
    """A file that consists of bytes and of spans of another, which are read only as they are asked for.

    Args:
        data: The other file.
        pieces: In their order; a range is a span of `data`.
    """

    def __init__(self, data: Data, *pieces: bytes | range) -> None:
        super().__init__()
        self._data = data
        self._pieces = pieces
        self._ends = list(accumulate(len(piece) for piece in pieces))
        self._at = 0

    def __len__(self) -> int:
        return self._ends[-1] if self._ends else 0

    def readable(self) -> bool:
        """It can be read."""
        return True

    def seekable(self) -> bool:
        """It can be read anywhere."""
        return True

    def tell(self) -> int:
        """Where the next byte is read."""
        return self._at

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        """Go to a place, which may lie beyond the end; never before the beginning."""
        base = {io.SEEK_SET: 0, io.SEEK_CUR: self._at, io.SEEK_END: len(self)}[whence]
        self._at = max(0, base + offset)
        return self._at

    def readinto(self, buffer: "WriteableBuffer") -> int:
        """Fill the buffer, as far as there are bytes; decoders take a short answer for the end."""
        view = memoryview(buffer).cast("B")
        done = 0
        number = bisect_right(self._ends, self._at)
        while done < len(view) and number < len(self._pieces):
            piece = self._pieces[number]
            first = self._at - (self._ends[number] - len(piece))
            count = min(len(view) - done, len(piece) - first)
            if isinstance(piece, range):
                begin = piece.start + first
                view[done : done + count] = self._data[begin : begin + count]
            else:
                view[done : done + count] = piece[first : first + count]
            done += count
            self._at += count
            number += 1
        return done


@dataclass(frozen=True)
class SoundStream:
    """One run of coded sound; a file that was put together of several holds one after another.

    Attributes:
        splice: What the decoder is given.
        claimed_frames: How many samples of each channel the container says there are, or None. What is
            decoded does not depend on it.
        is_ogg: Whether the claim stands on Ogg's pages, which the decoder reads.
        piped: Whether the decoder is given it as a pipe: of a file that it can look about in, it takes the
            length from headers and reads no further.
        leading: How many frames an encoder put before the sound; players leave them out.
        trailing: How many frames it may have put behind.
        resume: How many frames were decoded until the decoder stopped at something broken -> what follows
            that, or None where nothing does.
    """

    splice: Splice
    claimed_frames: int | None = None
    is_ogg: bool = False
    piped: bool = False
    leading: int = 0
    trailing: int = 0
    resume: "Callable[[int], SoundStream | None] | None" = None
