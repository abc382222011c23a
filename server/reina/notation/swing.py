"""Swing: eighths that are played long and short, written even."""

from collections.abc import Sequence

import numpy as np

EARLIEST, LATEST = 0.57, 0.72
"""Where in the beat the second of two swung eighths falls: from barely swung to dotted, triplets between."""

EVEN = 0.06
"""An eighth so near to the middle of the beat is even."""

MIN_BEATS = 8
MIN_SHARE = 0.8


def swing_of(phases_by_beat: Sequence[Sequence[float]]) -> float | None:
    """Return where in the beat the second eighths fall if the music swings throughout, else None.

    Args:
        phases_by_beat: Of each beat with onsets, where in it they fall, 0 to 1.
    """
    offbeats = [
        [phase for phase in phases if 0.1 < phase < 0.9] for phases in phases_by_beat if len(phases) <= 2
    ]
    alone = [phases[0] for phases in offbeats if len(phases) == 1]
    swung = [phase for phase in alone if EARLIEST <= phase <= LATEST]
    even = [phase for phase in alone if abs(phase - 0.5) <= EVEN]
    if len(swung) < MIN_BEATS or len(swung) < MIN_SHARE * (len(swung) + len(even)):
        return None
    # A triplet's middle note says that triplets are meant.
    triplets = sum(any(0.27 <= phase <= 0.4 for phase in phases) for phases in phases_by_beat)
    return float(np.median(swung)) if triplets <= 0.1 * len(swung) else None


def straightened(phase: float, swing: float) -> float:
    """Return a place in the beat as if its two halves were even."""
    return 0.5 * phase / swing if phase <= swing else 0.5 + 0.5 * (phase - swing) / (1.0 - swing)
