"""What carries the pieces: stands with their booms and legs, as lines, both drawn and kept clear of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from drums import measures as m
from drums.measures import unit

if TYPE_CHECKING:
    from drums.measures import Array

TUBE_LOW, TUBE_MIDDLE, TUBE_HIGH = 0.0150, 0.0125, 0.0095
LEG_HALF = 0.0075
FOOT = 0.012
"""The rubber foot's height."""


@dataclass(frozen=True)
class Stand:
    """A tube on a tripod, with a boom to `top` where that does not lie over its foot.

    `foot` is x, z on the floor; `legs_deg` say where the legs point, 0 is ahead (+Z), positive to the
    player's left. `head` is the tube's upper end, y; the boom is held there and
    reaches `behind` to its other side.
    """

    name: str
    foot: tuple[float, float]
    head: float
    top: tuple[float, float, float]
    legs_deg: tuple[float, ...]
    reach: float = 0.27
    hub: float = 0.30
    behind: float = 0.10

    @property
    def base(self) -> Array:
        """Where the tube's line meets the floor."""
        return np.array([self.foot[0], 0.0, self.foot[1]])

    @property
    def neck(self) -> Array:
        """The upper end of the tube."""
        return self.base + np.array([0.0, self.head, 0.0])

    @property
    def boom(self) -> tuple[Array, Array] | None:
        """The boom's two ends, or None."""
        top = np.array(self.top)
        if np.linalg.norm((top - self.base)[[0, 2]]) < 0.01:
            return None
        way = unit(top - self.neck)
        return self.neck - way * self.behind, top

    def feet(self) -> list[Array]:
        """Where its legs stand, at the middle of their ends."""
        turns = np.radians(self.legs_deg)
        return [self.base + np.array([self.reach * np.sin(t), FOOT, self.reach * np.cos(t)]) for t in turns]

    def lines(self) -> list[tuple[Array, Array, float]]:
        """Its solid parts: start, end and radius of each."""
        up = np.array([0.0, 1.0, 0.0])
        result = [(self.base + up * 0.05, self.neck, TUBE_LOW)]
        for foot in self.feet():
            result.append((self.base + up * self.hub, foot, LEG_HALF))
            low = self.base + up * 0.09
            result.append((low, foot + (self.base + up * self.hub - foot) * 0.42, 0.005))
        if self.boom is not None:
            result.append((*self.boom, TUBE_HIGH))
        else:
            result.append((self.neck, np.array(self.top), TUBE_HIGH))
        return result


def under(name: str, below: float = 0.022) -> tuple[float, float, float]:
    """The upper end of what carries a cymbal: so far under the hole, along its axis."""
    cymbal = next(cymbal for cymbal in m.CYMBALS if cymbal.name == name)
    x, y, z = np.array(cymbal.pivot) - cymbal.rotation[:, 1] * below
    return float(x), float(y), float(z)


SNARE_STAND = Stand(
    "snare_stand", (0.04, 0.40), 0.40, (0.04, 0.47, 0.40), (180, 60, -60), reach=0.17, hub=0.22
)
HAT_STAND = Stand("hi_hat_stand", (m.HAT_X, m.HAT_Z), 0.72, (m.HAT_X, 0.82, m.HAT_Z), (60, -45), reach=0.24)
CYMBAL_STANDS = (
    Stand("ride_stand", (-0.88, 0.70), 0.80, under("ride"), (-100, 20, 140)),
    Stand("crash_left_stand", (0.50, 0.98), 0.95, under("crash_left"), (0, 120, -120)),
    Stand("crash_right_stand", (-0.70, 1.12), 0.98, under("crash_right"), (60, 180, -60), reach=0.24),
    Stand("china_stand", (-1.08, 0.36), 0.90, under("china"), (-20, 100, 220), reach=0.24),
)
STANDS = (SNARE_STAND, HAT_STAND, *CYMBAL_STANDS)

# The post on the bass drum that carries the toms, the splash and the cowbell.
POST_FOOT = np.array([-0.13, 0.585, 0.865])
POST_TOP = 0.86
TOM_ARM_Y = 0.74
THRONE_LEGS_DEG = (180, 60, -60)
THRONE_REACH = 0.22
