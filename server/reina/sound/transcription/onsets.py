"""Where exactly each note of a line begins, on the samples."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.sound.transcription.posteriors import RATE

if TYPE_CHECKING:
    from numpy.typing import NDArray

STEP = 64
"""Samples from place to place: 2.9 ms."""
WINDOW, LONG_WINDOW, LONG_BELOW = 512, 1024, 50
"""Samples that are listened to at each place; below D3 twice as many."""
REACH_S = 0.06
NEARNESS_S = 0.02
"""A rise so far from where the network hears the beginning counts 0.6 times as much."""
RISE_STEPS = 3
EARLY = 0.25
"""A note begins where its rise is a quarter of the steepest."""
OVERTONES = 10
HIGHEST_HZ = 9000.0


def refined(
    samples: NDArray[np.float32], onset_s: NDArray[np.float64], pitch: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Move each onset to where the note's own overtones begin to rise.

    Args:
        samples: (S,) at `RATE`.
        onset_s: (N,) about where each note begins.
        pitch: (N,) MIDI numbers.

    Returns:
        (N,) seconds, within `REACH_S` of `onset_s`; where nothing rises, as it was.
    """
    padded = np.pad(samples, (LONG_WINDOW, LONG_WINDOW + 1))
    moved = [_refined(padded, near, key) for near, key in zip(onset_s.tolist(), pitch.tolist(), strict=True)]
    return np.array(moved, dtype=np.float64)


def _refined(padded: NDArray[np.float32], near_s: float, pitch: int) -> float:
    window = LONG_WINDOW if pitch < LONG_BELOW else WINDOW
    around = np.arange(-round(REACH_S * RATE / STEP), round(REACH_S * RATE / STEP) + 1)
    places = round(near_s * RATE) + STEP * around
    first = np.clip(places + LONG_WINDOW - window // 2, 0, len(padded) - window)
    pieces = np.lib.stride_tricks.sliding_window_view(padded, window)[first]
    levels = np.sqrt(np.abs(pieces @ _overtones(pitch, window).T)).sum(axis=1)
    rise = np.zeros(len(places))
    rise[RISE_STEPS:-RISE_STEPS] = levels[2 * RISE_STEPS :] - levels[: -2 * RISE_STEPS]
    far = (places / RATE - near_s) / NEARNESS_S
    steepest = int(np.argmax(np.maximum(rise, 0) * np.exp(-0.5 * far**2)))
    if rise[steepest] <= 0:
        return near_s
    begins = steepest
    while begins > 0 and rise[begins - 1] >= EARLY * rise[steepest]:
        begins -= 1
    return max(0.0, float(places[begins]) / RATE)


def _overtones(pitch: int, window: int) -> NDArray[np.complex64]:
    """(H, W): what each overtone of a pitch is measured with."""
    hertz = 440 * 2 ** ((pitch - 69) / 12) * np.arange(1, OVERTONES + 1)
    times = (np.arange(window) - window / 2) / RATE
    waves = np.exp(-2j * np.pi * hertz[hertz < HIGHEST_HZ, None] * times)
    return (waves * np.hanning(window)).astype(np.complex64)
