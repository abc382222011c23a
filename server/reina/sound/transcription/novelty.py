"""How much begins in each frame, whatever its pitch."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.sound.transcription.posteriors import HOP

if TYPE_CHECKING:
    from numpy.typing import NDArray

WINDOW = 1024
FLOOR_PERCENTILE, FLOOR_TIMES = 20, 1.5
"""What a band has for a fifth of the time, and a half more, is noise."""
COMPRESSION = 30.0
MEAN_FRAMES = 9
BLOCK_FRAMES = 2000


def novelty(samples: NDArray[np.float32]) -> NDArray[np.float64]:
    """By how much the spectrum rises in each frame, as a share of what sounds.

    A band is held against itself and its neighbours a frame before, so that vibrato is not taken for
    something new (Böck and Widmer, "Maximum filter vibrato suppression for onset detection", 2013).

    Args:
        samples: (S,) at the network's rate.

    Returns:
        (T,) for the frames of `posteriors`.
    """
    spectrum = _magnitudes(samples)
    loudest = spectrum.max(axis=1)
    spectrum -= FLOOR_TIMES * np.percentile(spectrum, FLOOR_PERCENTILE, axis=0).astype(np.float32)
    scale = COMPRESSION / max(1e-9, float(np.percentile(loudest, 95)))
    levels = np.log1p(scale * np.maximum(spectrum, 0, out=spectrum), out=spectrum)
    before = levels.copy()
    before[:, 1:] = np.maximum(before[:, 1:], levels[:, :-1])
    before[:, :-1] = np.maximum(before[:, :-1], levels[:, 1:])
    rises = np.zeros(len(levels))
    rises[1:-1] = np.maximum(levels[2:] - before[:-2], 0).sum(axis=1)
    sounding = levels.sum(axis=1, dtype=np.float64)
    half = MEAN_FRAMES // 2
    around = np.convolve(sounding, np.full(MEAN_FRAMES, 1 / MEAN_FRAMES))[half : half + len(sounding)]
    return rises / (around + 0.1 * float(np.median(around)) + 1e-9)


def _magnitudes(samples: NDArray[np.float32]) -> NDArray[np.float32]:
    """(T, B) float32, in blocks so that no more than the result is ever held."""
    frames = len(samples) // HOP + 1
    padded = np.pad(samples, (WINDOW // 2, WINDOW // 2 + HOP))
    windows = np.lib.stride_tricks.sliding_window_view(padded, WINDOW)[::HOP][:frames]
    shape = np.hanning(WINDOW + 1)[:-1].astype(np.float32)
    return np.concatenate(
        [
            np.abs(np.fft.rfft(windows[begin : begin + BLOCK_FRAMES] * shape, axis=1)).astype(np.float32)
            for begin in range(0, frames, BLOCK_FRAMES)
        ]
    )
