"""A recording as energy in bands of a semitone, frame by frame; its tuning.

Notes are told apart by their bands and not by an instrument's sound, so that any instrument will do.
"""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float32]

LOWEST_PITCH, HIGHEST_PITCH = 33, 108
"""The bands' MIDI pitches, A1 to C8."""
BANDS = HIGHEST_PITCH - LOWEST_PITCH + 1
A4_HZ, A4_PITCH = 440.0, 69
COMPRESSION = 50.0
"""How strongly soft sounds are raised: log(1 + 50 x), x the share of the loudest."""
LOUD_PERCENTILE = 99.0
BLOCK_FRAMES = 512
"""Frames transformed at once, so that memory does not grow with the recording."""
TUNING_WINDOW_S = 0.35
TUNING_FRAMES = 400
TUNING_HZ = (110.0, 1760.0)
TUNING_STEPS = 100
"""Of a semitone, into which deviations are counted: cents."""


def band_energies(
    samples: Floats, rate: int, *, frames_per_s: int, window_s: float, tuning_cents: float = 0.0
) -> Floats:
    """Energy in each band, logarithmic, 0 in silence.

    Args:
        samples: (S,) mono.
        rate: Samples a second.
        frames_per_s: How many frames; frame k is centred at k / frames_per_s seconds.
        window_s: Length of a frame's window; rounded to a power of two of samples.
        tuning_cents: By how much the recording is tuned higher than A4 = 440 Hz.

    Returns:
        (F, BANDS) float32, frames over the whole recording.
    """
    size = 1 << round(np.log2(window_s * rate))
    filters = _filters(size, rate, tuning_cents)
    centres = np.rint(np.arange(int(len(samples) / rate * frames_per_s) + 1) * rate / frames_per_s)
    padded = np.pad(samples, (size // 2, size))
    window = np.hanning(size).astype(np.float32)
    windows = np.lib.stride_tricks.sliding_window_view(padded, size)
    energies = np.empty((len(centres), BANDS), dtype=np.float32)
    for first in range(0, len(centres), BLOCK_FRAMES):
        starts = centres[first : first + BLOCK_FRAMES].astype(np.int64)
        spectrum = np.abs(np.fft.rfft(windows[starts] * window, axis=1))
        energies[first : first + BLOCK_FRAMES] = spectrum[:, : len(filters)] @ filters
    loudest = max(float(np.percentile(energies.max(axis=1), LOUD_PERCENTILE)), 1e-9)
    return np.log1p(energies * np.float32(COMPRESSION / loudest))


def rises(energies: Floats, frames: int = 1) -> Floats:
    """By how much each band rises over `frames` frames on either side, (F, BANDS); 0 where it falls.

    Before the first frame there was silence.
    """
    padded = np.pad(energies, ((frames, frames), (0, 0)))
    padded[len(padded) - frames :] = energies[-1]
    return np.maximum(0, padded[2 * frames :] - padded[: -2 * frames])


def tuning_of(samples: Floats, rate: int) -> float:
    """By how many cents the recording is tuned higher than A4 = 440 Hz, -50 to 50.

    The strongest peaks of spectra all over it, by how far each lies from the nearest semitone; the mean of a
    circle of 100 cents, weighted by how strong they are.
    """
    size = 1 << round(np.log2(TUNING_WINDOW_S * rate))
    if len(samples) < size:
        return 0.0
    starts = np.unique(np.linspace(0, len(samples) - size, TUNING_FRAMES, dtype=np.int64))
    window = np.hanning(size).astype(np.float32)
    spectrum = np.abs(
        np.fft.rfft(np.lib.stride_tricks.sliding_window_view(samples, size)[starts] * window, axis=1)
    )
    low, high = (round(hz * size / rate) for hz in TUNING_HZ)
    middle = spectrum[:, low:high]
    before, after = spectrum[:, low - 1 : high - 1], spectrum[:, low + 1 : high + 1]
    strong = middle > 0.1 * middle.max(axis=1, keepdims=True)
    peaks = (middle > before) & (middle >= after) & strong & (middle > 1e-3 * spectrum.max())
    frame, at = np.nonzero(peaks)
    if not len(at):
        return 0.0
    a, b, c = (np.log(part[frame, at] + 1e-9) for part in (before, middle, after))
    # A parabola through three logarithms: the peak of a Hann window lies at its vertex.
    place = at + low + 0.5 * (a - c) / np.minimum(a - 2 * b + c, -1e-9)
    cents = 1200 * np.log2(place * rate / size / A4_HZ)
    angle = np.sum(middle[frame, at] ** 0.5 * np.exp(2j * np.pi * cents / 100))
    return float(np.angle(angle) / (2 * np.pi) * 100)


def _filters(size: int, rate: int, tuning_cents: float) -> Floats:
    """(bins, BANDS) triangles a semitone to either side, at least as wide as a bin; each sums to 1."""
    pitches = np.arange(LOWEST_PITCH, HIGHEST_PITCH + 1) + tuning_cents / 100
    centres = A4_HZ * 2 ** ((pitches - A4_PITCH) / 12)
    hz = np.fft.rfftfreq(size, 1 / rate)
    hz = hz[hz < centres[-1] * 2 ** (2 / 12)]
    widths = np.maximum(centres * (2 ** (1 / 12) - 1), rate / size)
    weights = np.maximum(0, 1 - np.abs(hz[:, None] - centres) / widths)
    return (weights / np.maximum(weights.sum(axis=0), 1e-9)).astype(np.float32)
