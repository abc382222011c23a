"""The shape of a song's sound, to be drawn: its lowest and highest samples, stretch by stretch.

WAV is read, which is what the server renders. The other formats would need a decoder for each; the page has
one for all of them, since it plays them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.sessions.folders import write_atomically
from reina.sessions.sound_facts import BrokenAudioError
from reina.sessions.sound_wav import find_samples, is_wav

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path
    from typing import BinaryIO

    import numpy.typing as npt

    from reina.music.arrays import FloatArray

PAIRS_A_SECOND = 200
"""As fine as peaks are kept; at most 3 MB an hour."""
FRAMES_AT_ONCE = 1 << 18
INTEGERS, FLOATS = 1, 3
"""Encodings of samples in WAV."""


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


def song_peaks(song: Path) -> Peaks | None:
    """A song's peaks, from its file, and from then on from the one beside it; None where it is not read here.

    Raises:
        FileNotFoundError: There is no song.
    """
    kept = peaks_path(song)
    if kept.is_file():
        return _unpack(kept.read_bytes())
    with song.open("rb") as file:
        peaks = _peaks_of_wav(file, song.stat().st_size)
    if peaks is not None:
        write_atomically(kept, _pack(peaks))
    return peaks


def _pack(peaks: Peaks) -> bytes:
    pairs = np.rint(np.stack([peaks.lowest, peaks.highest]) * 32767.0).astype("<i2")
    return np.float64(peaks.duration_s).astype("<f8").tobytes() + pairs.tobytes()


def _unpack(data: bytes) -> Peaks:
    pairs = np.frombuffer(data, "<i2", offset=8).reshape(2, -1) / 32767.0
    return Peaks(float(np.frombuffer(data, "<f8", 1)[0]), pairs[0], pairs[1])


def _peaks_of_wav(file: BinaryIO, size: int) -> Peaks | None:
    if not is_wav(file.read(12)):
        return None
    try:
        found = find_samples(file, size)
    except BrokenAudioError:
        return None
    width = found.bits // 8
    frame_bytes = width * found.channels
    read_samples = _READERS.get((found.encoding, found.bits))
    if read_samples is None or found.byte_rate != frame_bytes * found.sample_rate:
        return None
    stretch = max(1, found.sample_rate // PAIRS_A_SECOND)
    at_once = max(1, FRAMES_AT_ONCE // stretch) * stretch
    lows: list[FloatArray] = []
    highs: list[FloatArray] = []
    frames = left = found.bytes // frame_bytes
    file.seek(found.start)
    while left > 0:
        data = file.read(min(at_once, left) * frame_bytes)
        read = len(data) // frame_bytes
        if read == 0:
            break
        left -= read
        samples = read_samples(data[: read * frame_bytes]).reshape(read, found.channels)
        first = np.arange(0, read, stretch)
        lows.append(np.minimum.reduceat(samples.min(axis=1), first))
        highs.append(np.maximum.reduceat(samples.max(axis=1), first))
    if not lows:
        return None
    return Peaks(
        frames / found.sample_rate,
        np.clip(np.concatenate(lows), -1.0, 1.0),
        np.clip(np.concatenate(highs), -1.0, 1.0),
    )


def _of_24_bits(data: bytes) -> FloatArray:
    """Little-endian integers of three bytes: each under a zero byte is one of four."""
    wide: npt.NDArray[np.uint8] = np.zeros((len(data) // 3, 4), dtype=np.uint8)
    wide[:, 1:] = np.frombuffer(data, np.uint8).reshape(-1, 3)
    return wide.view("<i4")[:, 0] / 2.0**31


_READERS: dict[tuple[int, int], Callable[[bytes], FloatArray]] = {
    (INTEGERS, 8): lambda data: np.frombuffer(data, np.uint8) / 128.0 - 1.0,
    (INTEGERS, 16): lambda data: np.frombuffer(data, "<i2") / 2.0**15,
    (INTEGERS, 24): _of_24_bits,
    (INTEGERS, 32): lambda data: np.frombuffer(data, "<i4") / 2.0**31,
    (FLOATS, 32): lambda data: np.nan_to_num(np.frombuffer(data, "<f4").astype(np.float64)),
    (FLOATS, 64): lambda data: np.nan_to_num(np.frombuffer(data, "<f8")),
}
"""Encoding and bits of a sample -> how bytes become samples, -1..1."""
