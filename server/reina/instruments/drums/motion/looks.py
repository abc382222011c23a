"""Where a drummer looks: ahead of the hands to what is far away, and to the band where there is time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

from reina.kinematics import MotionCurves

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.drums.hit import DrumHit
    from reina.instruments.drums.motion.kit_places import KitPlaces
    from reina.rotations.arrays import FloatArray

LEAD_S: Final = 0.3
"""The head is turned to a piece so long before it is struck."""

TURNING_S: Final = 0.7
"""What a look takes, there and back."""

HOME_M: Final = (0.42, 0.3)
"""A piece nearer to the snare than the first needs no look; one at the second farther needs a whole one."""

AGAIN_S, AGAIN = 1.5, 0.3
"""What has been struck so shortly before needs that part of a look."""

HELD: Final = 0.4
"""How much it takes to turn the head off its way."""

BAND_REST_S: Final = 1.6
"""In gaps of this length between strokes of the hands a drummer looks at the band."""

BAND_BARS: Final = 4
"""So does one at the end of so many bars, where no fill is played."""

BAND_S, BAND_MOVE_S = 1.3, 0.4
"""How long that is, and what the head takes to turn."""

FILL: Final = 0.2
"""No look at the band where the kit asks for so much of one."""


@dataclass(frozen=True, eq=False)
class Looks:
    """Where the head is turned, ``(F,)`` each.

    Attributes:
        left: To a piece, radians to the left.
        down: And downward.
        share: How much of a look at a piece it is, 0 to 1.
        band: How far the look is at the band, 0 to 1.
        band_left: Where the one who is looked at stands, radians to the left.
    """

    left: FloatArray
    down: FloatArray
    share: FloatArray
    band: FloatArray
    band_left: FloatArray


def plan_looks(
    count: int,
    rate_hz: float,
    hits: Sequence[DrumHit],
    places: KitPlaces,
    *,
    head: FloatArray,
    bars_s: FloatArray,
    bearings_rad: Sequence[float],
    seed: int = 0,
) -> Looks:
    """Plan where the head looks, at even steps of time from 0 on.

    Args:
        count: How many.
        rate_hz: How many a second.
        hits: By time.
        places: The kit as it stands.
        head: Where the head is, metres, ``(3,)``.
        bars_s: When the bars begin, seconds, ascending.
        bearings_rad: Where the others stand, to the left, one at least; one is chosen at each look.
        seed: Which of many equal choices.
    """
    hands = [hit for hit in hits if hit.limb.endswith("hand")]
    wanted = np.zeros((3, count))
    home = places["snare", "centre"].position
    last: dict[str, float] = {}
    for hit in hands:
        point = places[hit.piece, hit.zone].position
        far = float(np.linalg.norm(point - home))
        weight = float(np.clip((far - HOME_M[0]) / HOME_M[1], 0.0, 1.0))
        if hit.onset_s - last.get(hit.piece, -np.inf) < AGAIN_S:
            weight *= AGAIN
        last[hit.piece] = hit.onset_s
        place = round((hit.onset_s - LEAD_S) * rate_hz)
        if weight > 0.0 and 0 <= place < count:
            line = point - head
            left, down = np.arctan2(line[0], line[2]), np.arctan2(-line[1], np.hypot(line[0], line[2]))
            wanted[:, place] += weight * np.array([1.0, left, down])
    reach = round(0.5 * TURNING_S * rate_hz)
    window = np.hanning(2 * reach + 3)[1:-1]
    padded = np.pad(wanted, ((0, 0), (reach, reach)))
    share, left, down = (np.convolve(row, window, mode="valid") for row in padded)
    looked = share / (share + HELD)
    towards = np.maximum(share, 1e-9)
    gaps = _band_times([hit.onset_s for hit in hands], bars_s, looked, rate_hz)
    chance = np.random.default_rng([seed, len(gaps)])
    others: list[int] = chance.integers(0, len(bearings_rad), size=len(gaps)).tolist()
    at = np.arange(count) / rate_hz
    band, band_left = _band_curves(gaps, [bearings_rad[other] for other in others]).evaluate(at)
    return Looks(left / towards * looked, down / towards * looked, looked, band, band_left)


def _band_times(
    onset_s: Sequence[float], bars_s: FloatArray, looked: FloatArray, rate_hz: float
) -> list[tuple[float, float]]:
    """From when to when a drummer looks at the band: in rests, and at the ends of groups of bars."""
    if not onset_s:
        return []
    onsets = np.array(onset_s)
    gaps = np.diff(onsets)
    found = [
        (float(onsets[index]) + 0.3, float(onsets[index + 1]) - 0.5)
        for index in np.flatnonzero(gaps >= BAND_REST_S).tolist()
    ]
    found.append((float(onsets[-1]) + 0.5, float(onsets[-1]) + 0.5 + 2.0 * BAND_S))
    for bar in bars_s[BAND_BARS::BAND_BARS].tolist():
        begin, end = bar - BAND_S - 0.2, bar - 0.2
        first, last = (max(0, round(time * rate_hz)) for time in (begin, end + 0.3))
        is_played = onsets[0] < begin and end < onsets[-1]
        if is_played and looked[first : last + 1].max(initial=0.0) < FILL:
            found.append((begin, end))
    found.sort()
    kept: list[tuple[float, float]] = []
    for begin, end in found:
        start = max(begin, kept[-1][1] + 2.0 * BAND_MOVE_S if kept else 0.0)
        if end - start >= 0.5:
            kept.append((start, end))
    return kept


def _band_curves(gaps: Sequence[tuple[float, float]], bearings_rad: Sequence[float]) -> MotionCurves:
    """How far each look is, and at whom."""
    looks: list[tuple[float, float, float]] = []
    aims: list[tuple[float, float, float]] = []
    for (begin, end), bearing in zip(gaps, bearings_rad, strict=False):
        looks += [(begin, begin + BAND_MOVE_S, 1.0), (max(end, begin + BAND_MOVE_S), end + BAND_MOVE_S, 0.0)]
        aims.append((begin, begin + BAND_MOVE_S, bearing))
    return MotionCurves(
        {name: (np.array(table).reshape(-1, 3), 0.0) for name, table in (("band", looks), ("aim", aims))}
    )
