"""The spots of a cast: one for each side of the stage, brighter where the tune is."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reina.stage.cast_form import Place
from reina.stage.light_parameters import SPOTS
from reina.stage.shots import Point

MIDDLE_M = 0.1
"""Who stands no further from the middle than this is in the middle."""

SIDES = {1: -1.0, 2: 1.0, 3: 0.0}
"""Whom each spot lights: at the players' right, where the first hangs, at their left, and in the middle."""

LIT, LEADING = 2.4, 5.0
"""Strength of a spot, and of one whose players have the tune."""

CHEST_M = 1.25
REACH_M = 0.5
"""How far around a player's chest the cone reaches."""


@dataclass(frozen=True)
class SideSpot:
    """A spot on the players of one side.

    Attributes:
        number: Which of the stage's spots.
        target: What it shines at, metres.
        angle: From the middle of its cone to its edge, radians.
        levels: Its strength in each passage.
    """

    number: int
    target: Point
    angle: float
    levels: tuple[float, ...]


def side_spots(leads: Sequence[int], places: Sequence[Place]) -> tuple[SideSpot, ...]:
    """Light every player.

    Args:
        leads: Who has the tune in each passage.
        places: Where each player stands.
    """
    spots: list[SideSpot] = []
    for number, side in SIDES.items():
        lit = [player for player, place in enumerate(places) if _side(place) == side]
        if not lit:
            continue
        chests = np.array([[places[player].x_m, CHEST_M, places[player].z_m] for player in lit])
        middle = chests.mean(axis=0)
        reach_m = float(np.linalg.norm(chests - middle, axis=1).max()) + REACH_M
        away_m = float(np.linalg.norm(middle - SPOTS[number]["position"]))
        x, y, z = (round(float(part), 3) for part in middle)
        levels = tuple(LEADING if lead in lit else LIT for lead in leads)
        spots.append(SideSpot(number, (x, y, z), round(float(np.arctan2(reach_m, away_m)), 3), levels))
    return tuple(spots)


def _side(place: Place) -> float:
    return float(np.sign(place.x_m)) if abs(place.x_m) > MIDDLE_M else 0.0
