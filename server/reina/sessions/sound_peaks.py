"""The shape of a song's sound, to be drawn: its lowest and highest samples, stretch by stretch."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.sessions.folders import write_atomically

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


def read_peaks(song: Path) -> Peaks | None:
    """A song's peaks, as they are kept beside it; None where they are not."""
    try:
        return _unpack(peaks_path(song).read_bytes())
    except FileNotFoundError:
        return None


def write_peaks(path: Path, peaks: Peaks) -> None:
    """Keep peaks."""
    write_atomically(path, _pack(peaks))


class PeakMeter:
    """Finds the peaks of sound that comes in blocks."""

    def __init__(self) -> None:
        self._lowest: list[npt.NDArray[np.float32]] = []
        self._highest: list[npt.NDArray[np.float32]] = []
        self._form = (0, 0)
        self._stretch = 1
        self._several = False
        self._pending: npt.NDArray[np.float32] = np.empty(0, dtype=np.float32)

    def begin(self, sample_rate: int, channels: int) -> None:
        """Be told of what form the blocks are from here on; a stretch goes on over blocks of one form."""
        if (sample_rate, channels) != self._form:
            self._several = bool(self._lowest)
            self._end_stretch()
            self._form = (sample_rate, channels)
            self._stretch = max(1, sample_rate // PAIRS_A_SECOND)

    def take(self, samples: npt.NDArray[np.float32]) -> None:
        """Take in a block: ``(F, C)``, of which what is no number counts as silence."""
        flat = np.concatenate([self._pending, np.nan_to_num(samples).ravel()])
        width = self._stretch * self._form[1]
        whole = flat.size // width * width
        if whole:
            rows = flat[:whole].reshape(-1, width)
            self._lowest.append(rows.min(axis=1))
            self._highest.append(rows.max(axis=1))
        self._pending = flat[whole:]

    def peaks(self, duration_s: float) -> Peaks:
        """The peaks of all; what was taken in beyond the end, as encoders add it, is left out."""
        self._end_stretch()
        most = None if self._several else math.ceil(duration_s * self._form[0] / self._stretch)
        lowest, highest = np.concatenate(self._lowest)[:most], np.concatenate(self._highest)[:most]
        return Peaks(
            duration_s,
            np.clip(lowest, -1.0, 1.0).astype(np.float64),
            np.clip(highest, -1.0, 1.0).astype(np.float64),
        )

    def _end_stretch(self) -> None:
        if self._pending.size:
            self._lowest.append(self._pending.min(keepdims=True))
            self._highest.append(self._pending.max(keepdims=True))
            self._pending = self._pending[:0]


def _pack(peaks: Peaks) -> bytes:
    pairs = np.rint(np.stack([peaks.lowest, peaks.highest]) * 32767.0).astype("<i2")
    return np.float64(peaks.duration_s).astype("<f8").tobytes() + pairs.tobytes()


def _unpack(data: bytes) -> Peaks:
    pairs = np.frombuffer(data, "<i2", offset=8).reshape(2, -1) / 32767.0
    return Peaks(float(np.frombuffer(data, "<f8", 1)[0]), pairs[0], pairs[1])
