"""What a recording has before the music and after it."""

import numpy as np

from reina.sound.alignment.bands import Floats
from reina.sound.alignment.score_bands import Times

LONGEST_COUNT_S = 15.0
EVENNESS = 0.08
"""By which share of itself a counted beat may be longer or shorter than the next."""
COUNTED_IN = (0.5, 1.0, 2.0)
"""How many of the score's beats are one counted beat."""
TEMPO_TOLERANCE = 0.12
FEWEST_COUNTED = 2
FIRST_BEATS = 8
LOUD = 0.35
"""A count is at least so strong beside what begins in the music."""
EDGE_S = 0.1
"""Where a recording begins its noise begins too."""
APART_S = 0.12
AFTER_S = 0.7
"""The last note may ring so long."""
APPLAUSE = 0.2
"""What is at least so loud beside the music is more than its noise."""


def count_in(broad: Floats, frames_per_s: int, begins_s: float, beat_s: float) -> int:
    """How many even beats are counted just before the music; 0 where it is not so.

    Args:
        broad: (F,) by how much the recording's bands rise, all together.
        frames_per_s: How many frames a second has.
        begins_s: Where the music begins.
        beat_s: How long the first beats of the music last.
    """
    begin = max(round(EDGE_S * frames_per_s), round((begins_s - LONGEST_COUNT_S) * frames_per_s))
    end = round((begins_s - APART_S) * frames_per_s)
    music = broad[end:]
    if end <= begin or not len(music):
        return 0
    before = broad[begin:end]
    least = LOUD * float(np.percentile(music, 98))
    reach = round(APART_S * frames_per_s)
    peaks = [
        at
        for at in np.flatnonzero(before >= least).tolist()
        if before[at] >= before[max(0, at - reach) : at + reach + 1].max()
    ]
    if not peaks or beat_s <= 0:
        return 0
    times = np.array([begins_s, *((begin + at) / frames_per_s for at in reversed(peaks))])
    steps = -np.diff(times)
    even = np.abs(steps - steps[0]) <= EVENNESS * steps[0] + 1 / frames_per_s
    in_tempo = np.min(np.abs(steps[0] / (beat_s * np.array(COUNTED_IN)) - 1)) < TEMPO_TOLERANCE
    return len(peaks) if in_tempo and bool(even.all()) and len(peaks) >= FEWEST_COUNTED else 0


def sounds_after(samples: Floats, rate: int, begins_s: float, ends_s: float) -> bool:
    """Whether there is sound after the music, and not only silence or what the music too had beneath it."""
    music = samples[round(begins_s * rate) : round(ends_s * rate)]
    rest = samples[round((ends_s + AFTER_S) * rate) :]
    if len(rest) < rate // 2 or not len(music):
        return False
    return _level(rest) > APPLAUSE * _level(music)


def _level(samples: Floats) -> float:
    return float(np.sqrt(np.mean(np.square(samples, dtype=np.float64))))


def first_beat_s(song_s: Times) -> float:
    """How long the beats last with which the music begins, the median of eight; 0 where none is heard.

    Args:
        song_s: (K,) where the score's beats are in the recording.
    """
    steps = np.diff(song_s)
    steps = steps[steps > 0][:FIRST_BEATS]
    return float(np.median(steps)) if len(steps) else 0.0
