"""What frames of a recording and of a score are compared by: which tones sound, which begin, and how high."""

import numpy as np
from numpy.typing import NDArray

from reina.sound.alignment.bands import BANDS, LOWEST_PITCH, Floats

SILENCE = 0.25
"""Weight of the number that stands for silence, so that silence is like silence and unlike any tone."""
BEGINNINGS = 0.8
"""Weight of tones that begin beside those that sound."""
HEIGHT = 0.5
"""Weight of how high it sounds, which the tones of an octave do not tell."""
SCALE = float(np.sqrt(1 + BEGINNINGS**2 + HEIGHT**2))
NEIGHBOURHOOD_S = 1.0
"""Beginnings count beside the strongest within so many seconds."""
TONES = 12
OCTAVES = 6
SOUNDING = slice(0, TONES)
BEGINNING = slice(TONES + 1, 2 * TONES + 1)


def frame_features(energies: Floats, risen: Floats, frames_per_s: float) -> Floats:
    """What each frame is compared by, (F, 31) of length 1 at most.

    The twelve tones that sound, silence, the twelve tones that begin, and by how much more than usual sounds
    in each of six octaves. The product of two is 1 where they are alike and about 0 where they have nothing
    in common.

    Args:
        energies: (F, BANDS) of `band_energies` or `score_energies`.
        risen: (F, BANDS) by how much they rise.
        frames_per_s: How many frames a second has.
    """
    tones = tones_of(energies)
    tones -= 0.5 * tones.mean(axis=1, keepdims=True)
    tones = np.maximum(tones, 0)
    level = max(float(np.percentile(np.linalg.norm(tones, axis=1), 75)), 1e-6)
    sounding = np.hstack((tones, np.full((len(tones), 1), SILENCE * level, dtype=np.float32)))
    sounding /= np.linalg.norm(sounding, axis=1, keepdims=True)
    begun = tones_of(risen)
    strongest = _strongest_near(begun.max(axis=1, initial=0), max(1, round(NEIGHBOURHOOD_S * frames_per_s)))
    begun /= strongest[:, None] + np.float32(1e-6)
    begun /= np.maximum(np.linalg.norm(begun, axis=1, keepdims=True), 0.5)
    height = _height(energies, np.linalg.norm(tones, axis=1) > SILENCE * level)
    return (np.hstack((sounding, BEGINNINGS * begun, HEIGHT * height)) / SCALE).astype(np.float32)


def activity(features: Floats) -> NDArray[np.float32]:
    """(F,) how much sounds in each frame: 0 in silence, near 1 in music."""
    return np.linalg.norm(features[:, SOUNDING], axis=1) * np.float32(SCALE)


def tones_of(bands: Floats) -> Floats:
    """(F, 12) the bands of each tone of the octave together, C first."""
    tones = np.zeros((len(bands), TONES), dtype=np.float32)
    for tone in range(TONES):
        tones[:, tone] = bands[:, (tone - LOWEST_PITCH) % TONES :: TONES].sum(axis=1)
    return tones


def transposed(features: Floats, semitones: int) -> Floats:
    """The features of the same music, so many semitones higher."""
    moved = features.copy()
    for part in (SOUNDING, BEGINNING):
        moved[:, part] = np.roll(features[:, part], semitones, axis=1)
    return moved


def pooled(frames: Floats, count: int) -> Floats:
    """The mean of every `count` frames, (ceil(F / count), ...)."""
    whole = -(-len(frames) // count)
    padded = np.pad(frames, ((0, whole * count - len(frames)), (0, 0)), mode="edge")
    return padded.reshape(whole, count, -1).mean(axis=1)


def _height(energies: Floats, sounds: NDArray[np.bool_]) -> Floats:
    """(F, 6) each octave's share of the energy beside its mean, of length 1 at most; 0 in silence.

    The mean is taken out, as it is the instrument's; what is left is the music's.
    """
    centres = np.linspace(6, BANDS - 6, OCTAVES)
    windows = np.maximum(0, 1 - np.abs(np.arange(BANDS)[:, None] - centres) / TONES).astype(np.float32)
    octaves = energies @ windows
    shares = octaves / np.maximum(octaves.sum(axis=1, keepdims=True), 1e-6)
    if not sounds.any():
        return np.zeros_like(shares)
    off: Floats = (shares - shares[sounds].mean(axis=0)) * sounds[:, None]
    lengths: Floats = np.linalg.norm(off, axis=1, keepdims=True)
    usual = max(float(np.sqrt(np.mean(np.square(lengths[sounds])))), 1e-3)
    return (off / np.maximum(lengths, usual)).astype(np.float32)


def _strongest_near(values: NDArray[np.float32], reach: int) -> NDArray[np.float32]:
    """The largest of each value's neighbours up to `reach` away, by doubling windows."""
    padded = np.pad(values, reach, constant_values=0)
    size, width = 1, 2 * reach + 1
    while size * 2 <= width:
        padded = np.maximum(padded[: len(padded) - size], padded[size:])
        size *= 2
    return np.maximum(padded[: len(values)], padded[width - size : width - size + len(values)])
