"""What a score would sound like in bands of a semitone: made from its notes, without rendering them."""

import numpy as np
from numpy.typing import NDArray

from reina.sound.alignment.bands import BANDS, LOWEST_PITCH, Floats

Times = NDArray[np.float64]

OVERTONES = ((0, 1.0), (12, 0.5), (19, 0.35), (24, 0.25), (28, 0.2))
"""Semitones above a note and the strength of what sounds there too: what most instruments have in common."""
DECAY_S = 2.0
COMPRESSION = 5.0
STRIKE_FRAMES = 2


def score_energies(
    onset_s: Times,
    end_s: Times,
    pitch: NDArray[np.int_],
    velocity: Times,
    *,
    frames_per_s: float,
    frames: int,
) -> tuple[Floats, Floats]:
    """Energy in each band and by how much it rises.

    Args:
        onset_s: (N,) where notes begin.
        end_s: (N,) where they end.
        pitch: (N,) MIDI pitches, tones and no drums.
        velocity: (N,) 0..1.
        frames_per_s: Frame k is centred at k / frames_per_s seconds.
        frames: How many frames.

    Returns:
        Two of (frames, BANDS) float32.
    """
    sounding = np.zeros((frames, BANDS), dtype=np.float32)
    struck = np.zeros((frames, BANDS), dtype=np.float32)
    fading = np.exp(-np.arange(frames + STRIKE_FRAMES) / (frames_per_s * DECAY_S)).astype(np.float32)
    first = np.rint(onset_s * frames_per_s).astype(np.int64)
    last = np.maximum(np.rint(end_s * frames_per_s).astype(np.int64), first + 1)
    columns = zip(
        first.tolist(), last.tolist(), (pitch - LOWEST_PITCH).tolist(), velocity.tolist(), strict=True
    )
    for begin, end, band, strength in columns:
        if 0 <= band < BANDS and begin < frames:
            end = min(end, frames)
            shape = np.float32(0.3 + 0.7 * strength) * fading[: end - begin]
            np.maximum(sounding[begin:end, band], shape, out=sounding[begin:end, band])
            struck[begin : begin + STRIKE_FRAMES, band] += np.float32(0.3 + 0.7 * strength)
    return np.log1p(COMPRESSION * with_overtones(sounding)), with_overtones(struck)


def with_overtones(fundamentals: Floats) -> Floats:
    """The bands with what sounds above each of them, (F, BANDS)."""
    whole = np.zeros_like(fundamentals)
    for semitones, strength in OVERTONES:
        whole[:, semitones:] += np.float32(strength) * fundamentals[:, : BANDS - semitones]
    return whole
