"""What a track does before its first key and after its last."""

from typing import Literal, get_args

import numpy as np

from reina.curves.arrays import FloatArray, IntArray

Extrapolation = Literal["hold", "loop", "ping_pong", "extrapolate"]
"""Keep the end's value, begin again, go back and forth, or go on straight."""
EXTRAPOLATIONS: tuple[Extrapolation, ...] = get_args(Extrapolation)

REPEATING: frozenset[Extrapolation] = frozenset({"loop", "ping_pong"})


def fold(
    times: FloatArray, first: float, last: float, before: Extrapolation, after: Extrapolation
) -> tuple[FloatArray, IntArray, IntArray]:
    """Bring times outside of first..last back into it, where the side repeats.

    Args:
        times: ``(F,)``, in the keys' unit.
        first: Time of the first key.
        last: Time of the last, later than the first where a side repeats.
        before: What happens before the first.
        after: What happens from the last on.

    Returns:
        The folded times; the laps gone by, 0 where nothing repeats; -1 where the lap runs backwards, else 1.
        Each ``(F,)``.
    """
    laps = np.zeros(times.shape, dtype=np.int64)
    ways = np.ones(times.shape, dtype=np.int64)
    span = last - first
    if span <= 0.0:
        return times, laps, ways
    folded = times.copy()
    for side, mode in ((times < first, before), (times >= last, after)):
        if mode not in REPEATING or not side.any():
            continue
        lap = np.floor((times[side] - first) / span)
        rest = np.clip(times[side] - first - lap * span, 0.0, span)
        laps[side] = lap.astype(np.int64)
        if mode == "loop":
            # A rest that rounding brings to the whole span belongs to the next lap's beginning.
            folded[side] = first + np.where(rest >= span, 0.0, rest)
        else:
            backwards = lap % 2 == 1
            folded[side] = np.where(backwards, last - rest, first + rest)
            ways[side] = np.where(backwards, -1, 1)
    return folded, laps, ways
