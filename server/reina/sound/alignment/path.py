"""The best way through a recording and a score, by dynamic programming; gaps in either are part of it.

A frame of the recording is heard at one frame of the score, or at none: before the music, after it, where the
recording has what the score has not. From one frame of the recording to the next the score goes on by 0 to 3
frames, or, through a gap, by any number: what the recording leaves out. A gap costs something,
and what is heard earns how much more alike it is than chance.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reina.sound.alignment.bands import Floats
from reina.sound.alignment.features import activity

UNHEARD = -1
"""What stands in a path for a frame of the recording that is at no place of the score."""
LARGEST_STEP = 3
FROM_GAP = 4
MOST, QUIET = 6.0, np.float32(0.3)
"""A frame earns at most so much by its activity beyond quiet: that silence is like silence proves nothing."""
NEVER = np.float32(-1e9)


@dataclass(frozen=True)
class Rules:
    """What a way costs.

    Attributes:
        step_costs: Of the score going on by 0, 1, 2, 3 frames.
        gap_cost: Of a gap, wherever it leads.
    """

    step_costs: tuple[float, float, float, float]
    gap_cost: float


@dataclass(frozen=True, eq=False)
class Path:
    """The best way.

    Attributes:
        at: (R,) the score's frame at each frame of the recording, or UNHEARD; never falling.
        reward: What the whole way earns.
    """

    at: NDArray[np.int64]
    reward: float


def best_path(
    recording: Floats,
    score: Floats,
    likeness: "Likeness",
    rules: Rules,
    band: NDArray[np.int64] | None = None,
) -> Path:
    """Find the way that earns most.

    Args:
        recording: (R, D) features.
        score: (S, D) features.
        likeness: What a product of features is worth.
        rules: What a way costs.
        band: (R, 2) first frame of the score and the one after the last that are looked at, at each frame of
            the recording; neither falls. All of them by default.
    """
    rows, columns = len(recording), len(score)
    if band is None:
        band = np.tile(np.array([0, columns]), (rows, 1))
    steps: list[NDArray[np.int8]] = []
    jumps: list[NDArray[np.int32]] = []
    gap_cost = np.float32(rules.gap_cost)
    costs = [np.float32(cost) for cost in rules.step_costs]
    # Three columns more before the first, so that a step from there needs no case of its own.
    heard = np.full(columns + 3, NEVER, dtype=np.float32)
    after = heard.copy()
    gap = np.full(columns, -gap_cost, dtype=np.float32)
    gap[0] = 0.0
    indices = np.arange(columns, dtype=np.int32)
    before_low, before_high = int(band[0, 0]), int(band[0, 1])
    # What is heard of the score's last frame, and when: after it nothing needs to follow.
    finished = float(NEVER), 0
    most = MOST * np.maximum(0, activity(recording) - QUIET)
    for row in range(rows):
        low, high = int(band[row, 0]), int(band[row, 1])
        # A gap reaches what comes into the band from the last that was in it.
        if high > before_high:
            gap[before_high:high] = gap[before_high - 1]
        earned = np.minimum(likeness.worth(score[low:high] @ recording[row]), most[row])
        # To stay where it is earns nothing, or a single note that is like much would be heard for ever.
        best = heard[low + 3 : high + 3] - costs[0] - np.maximum(earned, 0)
        step = np.zeros(high - low, dtype=np.int8)
        for ahead in range(1, LARGEST_STEP + 1):
            other = heard[low + 3 - ahead : high + 3 - ahead] - costs[ahead]
            better = other > best
            step[better] = ahead
            np.maximum(best, other, out=best)
        from_gap = gap[low:high]
        step[from_gap > best] = FROM_GAP
        best = np.maximum(best, from_gap) + earned
        # The gap at a frame: stayed in, or entered from the best that was heard before it.
        here = np.maximum.accumulate(best)
        came_from = np.maximum.accumulate(np.where(best >= here, indices[low:high], 0))
        entered = here - gap_cost
        if high == columns and best[-1] > finished[0]:
            finished = float(best[-1]), row
        jump = np.where(entered > gap[low:high], came_from, UNHEARD).astype(np.int32)
        gap[low:high] = np.maximum(gap[low:high], entered)
        after[before_low + 3 : before_high + 3] = NEVER
        after[low + 3 : high + 3] = best
        heard, after = after, heard
        after[before_low + 3 : before_high + 3] = NEVER
        steps.append(step)
        jumps.append(jump)
        before_low, before_high = low, high
    return _trace(heard[3:], gap, band, steps, jumps, rules.gap_cost, finished)


def _trace(
    heard: Floats,
    gap: Floats,
    band: NDArray[np.int64],
    steps: list[NDArray[np.int8]],
    jumps: list[NDArray[np.int32]],
    gap_cost: float,
    finished: tuple[float, int],
) -> Path:
    rows, columns = len(steps), len(heard)
    low, high = int(band[-1, 0]), int(band[-1, 1])
    # To end before the score's end leaves something out; a gap has paid for it already.
    unfinished = np.where(np.arange(low, high) < columns - 1, np.float32(gap_cost), np.float32(0))
    last_heard, last_gap = heard[low:high] - unfinished, gap[low:high]
    in_gap = bool(last_gap.max() >= last_heard.max())
    at = low + int((last_gap if in_gap else last_heard).argmax())
    reward, last_row = float(max(last_gap.max(), last_heard.max())), rows - 1
    if finished[0] > reward:
        reward, last_row = finished
        at, in_gap = columns - 1, False
    places = np.full(rows, UNHEARD, dtype=np.int64)
    for row in range(last_row, -1, -1):
        offset = int(band[row, 0])
        if in_gap:
            # What was entered at a frame was heard in it; the gap begins after it.
            at = min(at, offset + len(jumps[row]) - 1)
            source = int(jumps[row][at - offset]) if at >= offset else UNHEARD
            if source == UNHEARD:
                continue
            at, in_gap = source, False
        places[row] = at
        step = int(steps[row][at - offset])
        if step == FROM_GAP:
            in_gap = True
        else:
            at -= step
    return Path(places, reward)


@dataclass(frozen=True)
class Likeness:
    """What a product of features is worth: nothing at what chance gives, one at a deviation above it.

    Attributes:
        mean: Product of frames that were taken by chance.
        deviation: Its standard deviation.
        threshold: How many deviations above the mean are worth nothing.
    """

    mean: float
    deviation: float
    threshold: float

    @classmethod
    def by_chance(cls, recording: Floats, score: Floats, threshold: float, seed: int = 0) -> "Likeness":
        """Measure it on frames that are taken by chance."""
        random = np.random.default_rng(seed)
        rows = random.integers(0, len(recording), 4000)
        columns = random.integers(0, len(score), 4000)
        products = np.einsum("ij,ij->i", recording[rows], score[columns])
        return cls(float(products.mean()), max(float(products.std()), 0.02), threshold)

    def worth(self, products: Floats) -> Floats:
        """What products are worth."""
        base = np.float32(self.mean + self.threshold * self.deviation)
        return (products - base) * np.float32(1 / self.deviation)
