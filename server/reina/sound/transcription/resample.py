"""Samples at another rate."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

PIECE_S = 30
"""So much is brought to the other rate at a time, with `MARGIN_S` before and after it, which are left out."""
MARGIN_S = 1


def resampled(samples: NDArray[np.float32], rate: int, wanted: int) -> NDArray[np.float32]:
    """Bring a channel to another rate, by its spectrum; the first sample stays where it is.

    Args:
        samples: (S,) at `rate` a second.
        rate: Samples a second.
        wanted: Samples a second that the result has.

    Returns:
        (round(S · wanted / rate),) float32.
    """
    if rate == wanted:
        return samples.astype(np.float32)
    # A whole second is a whole number of samples at both rates, so that pieces meet to the sample.
    piece, margin = PIECE_S * rate, MARGIN_S * rate
    count = max(1, math.ceil(len(samples) / piece))
    padded = np.zeros(count * piece + 2 * margin, dtype=np.float32)
    padded[margin : margin + len(samples)] = samples
    size = (PIECE_S + 2 * MARGIN_S) * wanted
    made: list[NDArray[np.float32]] = []
    for index in range(count):
        spectrum = np.fft.rfft(padded[index * piece : (index + 1) * piece + 2 * margin])
        kept = spectrum[: size // 2 + 1]
        if rate > wanted:
            # What is just below the new half rate would be folded by a hard edge into what rings.
            edge = len(kept) // 20
            kept[-edge:] *= np.cos(np.linspace(0, np.pi / 2, edge)) ** 2
        whole = np.fft.irfft(kept, size) * (wanted / rate)
        made.append(whole[MARGIN_S * wanted : -MARGIN_S * wanted].astype(np.float32))
    return np.concatenate(made)[: round(len(samples) * wanted / rate)]
