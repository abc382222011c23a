"""The peaks of a song whose segments are rendered in any order; what is not there yet is silence."""

import base64

import numpy as np
from numpy.typing import NDArray

from reina.sound.events import SAMPLE_RATE
from reina.sound.recording.peaks import PAIRS_A_SECOND, Peaks

STRETCH = SAMPLE_RATE // PAIRS_A_SECOND
"""Samples a pair."""
LARGEST = 32767.0


class GrowingPeaks:
    """Peaks as they come.

    Args:
        frames: Length of the song in samples.
    """

    def __init__(self, frames: int) -> None:
        self._duration_s = frames / SAMPLE_RATE
        self._pairs = np.zeros((2, -(-frames // STRETCH)), dtype="<i2")

    def measure(self, first: int, samples: NDArray[np.int16]) -> str:
        """Take in (F, 2) samples from `first` on, a multiple of STRETCH; returns them as text for `put`."""
        starts = np.arange(0, len(samples), STRETCH)
        pairs = np.stack(
            (
                np.minimum.reduceat(samples.min(axis=1), starts),
                np.maximum.reduceat(samples.max(axis=1), starts),
            )
        ).astype("<i2")
        self._put(first, pairs)
        return base64.b64encode(pairs.tobytes()).decode()

    def put(self, first: int, text: str) -> None:
        """Take in what another has measured."""
        self._put(first, np.frombuffer(base64.b64decode(text), dtype="<i2").reshape(2, -1))

    def _put(self, first: int, pairs: NDArray[np.int16]) -> None:
        begin = first // STRETCH
        self._pairs[:, begin : begin + pairs.shape[1]] = pairs

    def peaks(self) -> Peaks:
        """All of them."""
        lowest, highest = self._pairs / LARGEST
        return Peaks(self._duration_s, lowest, highest)
