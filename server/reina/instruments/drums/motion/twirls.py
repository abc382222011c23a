"""Where a drummer twirls a stick: now and then, in a rest of a hand."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from reina.instruments.drums.hit import HANDS
from reina.instruments.drums.motion.stick_plan import TWIRL_S

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.instruments.drums.drum_part import DrumFingering

AFTER_S: Final = 0.95
"""A hand twirls at the earliest so long after a stroke: it has to go up first."""

BEFORE_S: Final = 1.05
"""And is done so long before its next one."""

SIDES: Final = (("crash_right", "ride", "china", "tom_floor"), ("crash_left", "hi_hat"))
"""What is on the side of each hand, in the order of `HANDS`."""

ALONE_S: Final = 1.2
"""Nor does it where the other hand is at work on its side, or was or will be so soon."""

CHANCE: Final = 0.4
"""In so many of the rests that are long enough."""

APART_S: Final = 16.0
"""At least so long from one twirl to the next, whichever the hand."""


def plan_twirls(fingering: DrumFingering, seed: int) -> tuple[Sequence[float], Sequence[float]]:
    """When each hand begins to twirl its stick, seconds, the hands in the order of `HANDS`.

    Args:
        fingering: What is struck; a hand that grips a cymbal is not free.
        seed: Which of the rests.
    """
    chance = np.random.default_rng([seed, len(fingering.hits)])
    rests: list[tuple[float, float, int]] = []
    for side, limb in enumerate(HANDS):
        busy = [hit.onset_s for hit in fingering.hits if hit.limb == limb]
        busy += [choke.at_s for choke in fingering.chokes if choke.limb == limb]
        at_s = np.sort(np.array(busy))
        for start, end in zip(at_s[:-1].tolist(), at_s[1:].tolist(), strict=True):
            room = end - start - AFTER_S - TWIRL_S - BEFORE_S
            if room >= 0.0:
                rests.append((start + AFTER_S, min(room, 2.0), side))
    strangers = [
        np.array([hit.onset_s for hit in fingering.hits if hit.limb == other and hit.piece in SIDES[side]])
        for side, other in enumerate(reversed(HANDS))
    ]
    found: tuple[list[float], list[float]] = ([], [])
    last = -np.inf
    for earliest, room, side in sorted(rests):
        takes, when = chance.uniform(size=2)
        at_s = earliest + room * float(when)
        is_alone = not (np.abs(strangers[side] - at_s - 0.5 * TWIRL_S) < ALONE_S).any()
        if takes < CHANCE and is_alone and at_s - last >= APART_S:
            found[side].append(at_s)
            last = at_s
    return found
