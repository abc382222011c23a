"""Notes that end where they begin."""

import numpy as np

from reina.music.arrays import FloatArray, IntArray
from reina.music.tempo import TempoMap

TAP_S = 0.05
"""How long a note sounds that is written without duration, as taps of drums are."""


def lengthen_taps(
    onset_s: FloatArray, end_s: FloatArray, end_beats: FloatArray, tempo_map: TempoMap
) -> tuple[FloatArray, FloatArray, IntArray]:
    """Give notes without duration one of `TAP_S`.

    Returns:
        (N,) the ends in seconds, (N,) the ends in beats, and the indices of the notes that were lengthened.
    """
    taps = end_s <= onset_s
    end_s = np.where(taps, onset_s + TAP_S, end_s)
    end_beats = np.where(taps, tempo_map.beats(end_s), end_beats)
    return end_s, end_beats, np.flatnonzero(taps)
