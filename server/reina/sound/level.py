"""How loud a song is: one gain, known before its first passage is rendered, and a limit for its peaks.

Segments are heard before the whole is rendered, so the gain cannot wait for the whole. It is measured on
excerpts, those where by the plan the most is played. What then still comes near full scale is limited
sample by sample, by a curve that knows no time: so a segment is the same in whatever order it is made.
"""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from reina.sound.events import SAMPLE_RATE, SoundPlan
from reina.sound.passages import BLOCK, Passage

FULL_SCALE = 32767
TARGET_RMS = 10 ** (-18 / 20)
"""Level of the parts that are heard, as a fraction of full scale: -18 dB."""
KNEE = 10 ** (-3 / 20)
"""Up to -3 dB samples are what they are."""
LARGEST_PEAK = 10 ** (-1 / 20)
"""-1 dB of full scale; what decoders and resamplers add on top then still fits."""
LARGEST_GAIN = 10 ** (30 / 20)
GATE = 10 ** (-10 / 20)
"""Windows quieter than this fraction of the loud ones' mean do not count for the level (as ITU-R BS.1770
gates)."""
ABSOLUTE_GATE = 10 ** (-70 / 20)
WINDOW = SAMPLE_RATE * 2 // 5
EXCERPT = 2 * SAMPLE_RATE // BLOCK * BLOCK
EXCERPTS = 3

Samples = NDArray[np.float32]


def choose_excerpts(plan: SoundPlan) -> Iterator[list[Passage]]:
    """Yield stretches to measure the level on, each as the passages of its ports.

    The score is cut into equal shares, and of each share the stretch is taken whose notes have the most
    energy: their velocities squared, by how long they sound.
    """
    on, off = plan.notes["on"].astype(np.int64), plan.notes["off"].astype(np.int64)
    energy = np.zeros(int(off.max()) // EXCERPT + 1)
    strength = plan.notes["velocity"].astype(np.float64) ** 2
    # A note of several stretches counts in those that it begins and ends in.
    first, last = on // EXCERPT, (off - 1) // EXCERPT
    np.add.at(energy, first, strength * (np.minimum(off, (first + 1) * EXCERPT) - on))
    np.add.at(energy, last, np.where(last > first, strength * (off - last * EXCERPT), 0))
    for share in np.array_split(np.arange(len(energy)), min(EXCERPTS, len(energy))):
        start = int(share[np.argmax(energy[share])]) * EXCERPT
        sounds = (on < start + EXCERPT) & (off > start)
        if np.any(sounds):
            yield [
                Passage(
                    port,
                    start,
                    start + EXCERPT,
                    EXCERPT,
                    np.flatnonzero(sounds & (plan.notes["port"] == port)),
                )
                for port in np.unique(plan.notes["port"][sounds]).tolist()
            ]


def song_gain(excerpts: Sequence[Samples]) -> float:
    """The factor that brings a song to its level, measured on (F, 2) excerpts of it.

    Their loud windows come to -18 dB RMS, or their highest peak to -3 dB where that is less.
    """
    peak = max((float(np.abs(excerpt).max()) for excerpt in excerpts if len(excerpt)), default=0.0)
    if peak == 0:
        return 1.0
    powers = np.concatenate([_powers(excerpt) for excerpt in excerpts])
    loud = powers[powers > ABSOLUTE_GATE**2]
    level = float(np.sqrt(loud[loud >= loud.mean() * GATE**2].mean())) if len(loud) else peak
    return min(TARGET_RMS / level, KNEE / peak, LARGEST_GAIN)


def levelled(samples: Samples, gain: float) -> NDArray[np.int16]:
    """Bring samples to the song's level, (F, 2), as 16-bit integers; none is over -1 dB."""
    raised = samples * np.float32(gain)
    size = np.abs(raised)
    room = LARGEST_PEAK - KNEE
    over = size > KNEE
    raised[over] = np.sign(raised[over]) * (KNEE + room * np.tanh((size[over] - KNEE) / room))
    return np.rint(raised * np.float32(FULL_SCALE)).astype("<i2")


def _powers(excerpt: Samples) -> NDArray[np.float64]:
    """Mean square of each window, (W,)."""
    windows = len(excerpt) // WINDOW
    squares = excerpt[: windows * WINDOW].astype(np.float64) ** 2
    return squares.reshape(windows, -1).mean(axis=1)
