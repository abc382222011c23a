"""Adds rendered passages up, levels the sum and writes it as 16-bit WAV."""

from pathlib import Path
from types import TracebackType

import numpy as np
from numpy.typing import NDArray

from reina.sound.events import SAMPLE_RATE
from reina.sound.recording.wav import wav_header

CHANNELS = 2
FULL_SCALE = 32767
TARGET_RMS = 10 ** (-18 / 20)
"""Level of the parts that are heard, as a fraction of full scale: -18 dB."""
LARGEST_PEAK = 10 ** (-1 / 20)
"""-1 dB of full scale; what decoders and resamplers add on top then still fits."""
LARGEST_GAIN = 10 ** (30 / 20)
GATE = 10 ** (-10 / 20)
"""Windows quieter than this fraction of the loud ones' mean do not count for the level (as ITU-R BS.1770
gates)."""
ABSOLUTE_GATE = 10 ** (-70 / 20)
WINDOW = SAMPLE_RATE * 2 // 5
INAUDIBLE = 10 ** (-66 / 20)
"""After the last sample over this fraction of the peak, the file fades out."""
FADE = SAMPLE_RATE // 4
PIECE = 10 * SAMPLE_RATE

Samples = NDArray[np.float32]


class Mix:
    """The sum of passages, which come in the order of their beginnings.

    What can no longer change lies in a file of 32-bit floats; only what may still be added to is in memory.

    Args:
        scratch: Path of that file; it is removed at the end.
    """

    def __init__(self, scratch: Path) -> None:
        self._scratch = scratch
        self._file = scratch.open("wb+")
        self._written = 0
        self._open = np.zeros((0, CHANNELS), dtype=np.float32)

    def __enter__(self) -> "Mix":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._file.close()
        self._scratch.unlink(missing_ok=True)

    def add(self, start: int, samples: Samples) -> None:
        """Add a passage.

        Args:
            start: The sample at which it begins; no later call names an earlier one.
            samples: (F, 2), full scale 1; its end is faded out in place.
        """
        fade = min(FADE, len(samples))
        samples[len(samples) - fade :] *= np.linspace(1, 0, fade, dtype=np.float32)[:, None]
        while self._written < start:
            settled = min(start - self._written, PIECE)
            self._settle(settled)
        end = start - self._written + len(samples)
        if end > len(self._open):
            self._open = np.concatenate((self._open, self._silence(end - len(self._open))))
        self._open[end - len(samples) : end] += samples

    def _settle(self, frames: int) -> None:
        held, self._open = self._open[:frames], self._open[frames:].copy()
        self._file.write(held.tobytes())
        self._file.write(self._silence(frames - len(held)).tobytes())
        self._written += frames

    @staticmethod
    def _silence(frames: int) -> Samples:
        return np.zeros((frames, CHANNELS), dtype=np.float32)

    def write_wav(self, path: Path, *, at_least: int) -> None:
        """Write the levelled sum.

        Args:
            path: Where to; the caller renames it into its place.
            at_least: How many samples the file has at least; where sound rings on, it has more.
        """
        self._settle(len(self._open))
        peak, level = self._levels()
        gain = min(TARGET_RMS / level, LARGEST_PEAK / peak, LARGEST_GAIN) if peak > 0 else 1.0
        frames = max(self._audible_end(peak) + FADE, at_least)
        with path.open("wb") as out:
            out.write(wav_header(frames, sample_rate=SAMPLE_RATE, channels=CHANNELS))
            for first in range(0, frames, PIECE):
                piece = self._piece(first, min(PIECE, frames - first))
                piece *= np.float32(gain * FULL_SCALE)
                fade = np.clip((frames - first - np.arange(len(piece))) / FADE, 0, 1).astype(np.float32)
                out.write(np.rint(piece * fade[:, None]).astype("<i2").tobytes())

    def _piece(self, first: int, count: int) -> Samples:
        """Read samples of the sum, (count, 2); silence after its end."""
        self._file.seek(first * CHANNELS * np.dtype(np.float32).itemsize)
        held = np.fromfile(self._file, dtype=np.float32, count=count * CHANNELS).reshape(-1, CHANNELS)
        return np.concatenate((held, self._silence(count - len(held))))

    def _levels(self) -> tuple[float, float]:
        """Return peak and gated level, as fractions of full scale."""
        peak = 0.0
        powers: list[float] = []
        for first in range(0, self._written, PIECE):
            piece = self._piece(first, min(PIECE, self._written - first))
            peak = max(peak, float(np.abs(piece).max()))
            windows = len(piece) // WINDOW
            squares = piece[: windows * WINDOW].reshape(windows, WINDOW * CHANNELS).astype(np.float64) ** 2
            powers.extend(squares.mean(axis=1).tolist())
        loud = np.array([power for power in powers if power > ABSOLUTE_GATE**2])
        if not len(loud):
            return peak, peak
        return peak, float(np.sqrt(loud[loud >= loud.mean() * GATE**2].mean()))

    def _audible_end(self, peak: float) -> int:
        """Return the sample after the last that is heard."""
        for first in reversed(range(0, self._written, PIECE)):
            piece = self._piece(first, min(PIECE, self._written - first))
            audible = np.flatnonzero(np.abs(piece).max(axis=1) > peak * INAUDIBLE)
            if len(audible):
                return first + int(audible[-1]) + 1
        return 0
