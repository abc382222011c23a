"""Where sticks come from: tips go round the body, and sticks point from about where the elbows are."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.instruments.drums.motion import contacts

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.drums.hit import DrumHit
    from reina.instruments.drums.motion.kit_places import KitPlaces
    from reina.rotations.arrays import FloatArray

OWN_SIDES = np.array([1.0, -1.0])
SHOULDER_PLACES = np.array([[0.20, 0.0], [-0.20, 0.0]])
NEAREST_M, YIELDING_M = 0.43, 0.03
"""No tip comes nearer to its shoulder than about the first, seen from above, unless it strikes there."""
LANDING_M = 0.03
"""Tips land within this of a zone's middle."""
ELBOW_PLACES = contacts.ELBOW_PLACES[::-1]
INWARD_RAD = contacts.INWARD_RAD[::-1]
FAR_M, FAR_LESS = (0.5, 0.2), 0.7
"""Where a tip is farther ahead than the first, less so, by that part at the second beyond it."""
OUTER_M, HIGH_M, OUTER_LESS = (0.40, 0.2), (0.75, 0.2), 1.1
"""So it is where a tip is out to its own side and high: there a cymbal hangs over the hand."""


def nearest_m(hits: Sequence[DrumHit], places: KitPlaces) -> FloatArray:
    """How near to their shoulders tips may come, from above: as near as what they strike, m, ``(2,)``."""
    nearest = np.full(2, NEAREST_M)
    for piece, zone, limb in {(hit.piece, hit.zone, hit.limb) for hit in hits}:
        if limb.endswith("hand"):
            side = 0 if limb == "left_hand" else 1
            away = places[piece, zone].position[[0, 2]] - SHOULDER_PLACES[side]
            nearest[side] = min(nearest[side], float(np.hypot(*away)) - LANDING_M)
    return nearest


def at_arms_length(tips: FloatArray, nearest_m: FloatArray) -> FloatArray:
    """Tips that go round the body on their way to what they strike, ``(F, 2, 3)``."""
    away = tips[..., [0, 2]] - SHOULDER_PLACES
    distance = np.sqrt(np.einsum("...i,...i->...", away, away))
    near = np.maximum(nearest_m - distance, 0.0)
    if not near.any():
        return tips
    share = near * near / ((near + YIELDING_M) * np.maximum(distance, 1e-6))
    result = tips.copy()
    result[..., [0, 2]] += away * share[..., None]
    return result


def from_elbows(tips: FloatArray, directions: FloatArray) -> FloatArray:
    """Sticks as steep as they are asked to be, that come from where the elbows are, ``(F, 2, 3)``."""
    ahead = tips[..., [0, 2]] - ELBOW_PLACES
    ahead = ahead / np.sqrt(np.einsum("...i,...i->...", ahead, ahead))[..., None]
    level = np.sqrt(np.maximum(1.0 - directions[..., 1] ** 2, 0.0))
    far = np.minimum(np.maximum((tips[..., 2] - FAR_M[0]) / FAR_M[1], 0.0), 1.0)
    outer = np.minimum(np.maximum((tips[..., 0] * OWN_SIDES - OUTER_M[0]) / OUTER_M[1], 0.0), 1.0)
    outer = outer * np.minimum(np.maximum((tips[..., 1] - HIGH_M[0]) / HIGH_M[1], 0.0), 1.0)
    inward = INWARD_RAD * (1.0 - FAR_LESS * far - OUTER_LESS * outer)
    cosine, sine = np.cos(inward), np.sin(inward)
    result = np.empty_like(directions)
    result[..., 0] = level * (ahead[..., 0] * cosine + ahead[..., 1] * sine)
    result[..., 1] = directions[..., 1]
    result[..., 2] = level * (ahead[..., 1] * cosine - ahead[..., 0] * sine)
    return result
