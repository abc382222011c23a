"""What hands or feet are to strike, before it is known which."""

from dataclasses import dataclass

import numpy as np

from reina.music.arrays import BoolArray, FloatArray, IntArray


@dataclass(frozen=True, eq=False)
class Struck:
    """N hits in the order of their onsets, as columns.

    Attributes:
        onset_s: (N,) seconds, ascending.
        beat: (N,) quarter notes since the beginning of the bar.
        piece: (N,) index into `PIECES`.
        velocity: (N,) in 0..1.
        is_cross_stick: (N,) whether the stick lies on the head and its butt strikes the rim.
    """

    onset_s: FloatArray
    beat: FloatArray
    piece: IntArray
    velocity: FloatArray
    is_cross_stick: BoolArray

    def __len__(self) -> int:
        return len(self.onset_s)

    def take(self, chosen: IntArray | BoolArray) -> "Struck":
        """Return some of them, in their order."""
        return Struck(
            self.onset_s[chosen],
            self.beat[chosen],
            self.piece[chosen],
            self.velocity[chosen],
            self.is_cross_stick[chosen],
        )


def struck_of(
    onset_s: FloatArray, beat: FloatArray, piece: IntArray, velocity: FloatArray, is_cross_stick: BoolArray
) -> Struck:
    """Make the table of columns in any order that are sorted by onset alone.

    Raises:
        ValueError: The onsets descend.
    """
    if np.any(np.diff(onset_s) < 0.0):
        raise ValueError("hits stand in the order of their onsets")
    return Struck(onset_s, beat, piece, velocity, is_cross_stick)
