"""The segments that a song is served in, each of which can be heard as soon as it is rendered.

All are of one length on a fixed grid, so that a place in the song is its segment's number. Each also holds
what sounds a little before and after it: codecs and resamplers need that to be right at its edges.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from reina.sound.events import SAMPLE_RATE
from reina.sound.passages import Passage

SEGMENT = 10 * SAMPLE_RATE
"""Length in samples: a whole number of them at 44.1 kHz too, where a device resamples."""
OVERLAP = SAMPLE_RATE // 10
"""How many samples before and after it a segment holds; Opus has converged after 80 ms (RFC 7845, 4.6)."""


@dataclass(frozen=True)
class Segments:
    """How a song is cut into segments.

    Attributes:
        frames: Length of the song in samples.
    """

    frames: int

    @property
    def count(self) -> int:
        """How many there are; the last is shorter."""
        return -(-self.frames // SEGMENT)

    def held(self, number: int) -> range:
        """The samples that a segment holds, overlaps included; silence before the song and after it."""
        end = min((number + 1) * SEGMENT, self.frames)
        return range(number * SEGMENT - OVERLAP, end + OVERLAP)

    def needed(self, number: int, passages: Sequence[Passage]) -> list[int]:
        """Which passages sound in a segment, indices."""
        held = self.held(number)
        return [
            index
            for index, passage in enumerate(passages)
            if passage.start < held.stop and passage.start + passage.length > held.start
        ]


def cut_into_segments(passages: Sequence[Passage]) -> Segments:
    """The segments of a song, which lasts until its last passage has died away."""
    return Segments(max(passage.start + passage.length for passage in passages))
