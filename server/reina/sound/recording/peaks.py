"""The shape of a song's sound, to be drawn: its lowest and highest samples, stretch by stretch."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.system.durable import write_durably

if TYPE_CHECKING:
    from pathlib import Path

    import numpy.typing as npt

    from reina.music.arrays import FloatArray

PAIRS_A_SECOND = 200
"""As fine as peaks are kept; at most 3 MB an hour."""


@dataclass(frozen=True, eq=False)
class Peaks:
    """A song's sound in N stretches of equal length, which together are the song.

    Attributes:
        duration_s: The song's length.
        lowest: ``(N,)`` -1..1, of all channels.
        highest: ``(N,)``.
    """

    duration_s: float
    lowest: FloatArray
    highest: FloatArray

    def reduced(self, count: int) -> Peaks:
        """The same in `count` stretches: each has what lies in it, and something where that is nothing."""
        first = np.floor(np.arange(count) * (self.lowest.size / count)).astype(np.int64)
        return Peaks(
            self.duration_s,
            np.minimum.reduceat(self.lowest, first),
            np.maximum.reduceat(self.highest, first),
        )


def peaks_path(song: Path) -> Path:
    """Where the peaks of a song are kept."""
    return song.with_suffix(".peaks")


def read_peaks(path: Path) -> Peaks | None:
    """Peaks, as `write_peaks` kept them; None where they are not."""
    try:
        return _unpack(path.read_bytes())
    except FileNotFoundError:
        return None


def write_peaks(path: Path, peaks: Peaks) -> None:
    """Keep peaks."""
    write_durably(path, _pack(peaks))


class PeakMeter:
    """Finds the peaks of sound that comes in blocks.

    Args:
        sample_rate: Samples a second.
        channels: How many there are; each stretch is that of all together.
    """

    def __init__(self, sample_rate: int, channels: int) -> None:
        self._stretch = max(1, sample_rate // PAIRS_A_SECOND)
        self._width = self._stretch * channels
        self._sample_rate = sample_rate
        self._lowest: list[npt.NDArray[np.float32]] = []
        self._highest: list[npt.NDArray[np.float32]] = []
        self._pending: npt.NDArray[np.float32] = np.empty(0, dtype=np.float32)

    def take(self, samples: npt.NDArray[np.float32]) -> None:
        """Take in a block: ``(F, C)``, of which what is no number counts as silence."""
        flat = np.concatenate([self._pending, np.nan_to_num(samples).ravel()])
        whole = flat.size // self._width * self._width
        if whole:
            self._add(flat[:whole].reshape(-1, self._width))
        self._pending = flat[whole:]

    def peaks(self, duration_s: float) -> Peaks:
        """The peaks of all; what was taken in beyond the end, as encoders add it, is left out."""
        if self._pending.size:
            self._add(self._pending.reshape(1, -1))
            self._pending = self._pending[:0]
        count = math.ceil(round(duration_s * self._sample_rate) / self._stretch)
        lowest, highest = np.concatenate(self._lowest)[:count], np.concatenate(self._highest)[:count]
        return Peaks(
            duration_s,
            np.clip(lowest, -1.0, 1.0).astype(np.float64),
            np.clip(highest, -1.0, 1.0).astype(np.float64),
        )

    def _add(self, stretches: npt.NDArray[np.float32]) -> None:
        self._lowest.append(stretches.min(axis=1))
        self._highest.append(stretches.max(axis=1))


def _pack(peaks: Peaks) -> bytes:
    pairs = np.rint(np.stack([peaks.lowest, peaks.highest]) * 32767.0).astype("<i2")
    return np.float64(peaks.duration_s).astype("<f8").tobytes() + pairs.tobytes()


def _unpack(data: bytes) -> Peaks:
    pairs = np.frombuffer(data, "<i2", offset=8).reshape(2, -1) / 32767.0
    return Peaks(float(np.frombuffer(data, "<f8", 1)[0]), pairs[0], pairs[1])
