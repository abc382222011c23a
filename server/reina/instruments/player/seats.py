"""Where the players stand: places on the stage, and which way each faces."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from reina.rotations import from_axis_angle, multiply, product, rotate

if TYPE_CHECKING:
    from collections.abc import Mapping

    from reina.rotations.arrays import FloatArray

UP = np.array([0.0, 1.0, 0.0])


@dataclass(frozen=True)
class Seat:
    """A place on the stage.

    Attributes:
        name: What a casting calls it.
        x_m: To the left of the players, as the audience sees it to the right, metres from the middle.
        z_m: Toward the audience.
        y_m: How high it lies over the floor.
        facing_rad: How far a player turns to the left from facing the audience.
    """

    name: str
    x_m: float = 0.0
    z_m: float = 0.0
    y_m: float = 0.0
    facing_rad: float = 0.0

    @property
    def is_middle(self) -> bool:
        """Whether it is where the rigs stand by themselves."""
        return self == Seat(self.name)

    def bearing_rad(self, other: Seat) -> float:
        """How far to the left of where a player here faces another stands, -π..π."""
        ahead = np.arctan2(other.x_m - self.x_m, other.z_m - self.z_m)
        turned = float(ahead - self.facing_rad)
        return float((turned + np.pi) % (2.0 * np.pi) - np.pi)

    @cached_property
    def _turning(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Matrices that turn a row of coordinates and a row of a quaternion, and the seat's place."""
        turn = from_axis_angle(UP, np.array(self.facing_rad))
        return rotate(turn, np.eye(3)), multiply(turn, np.eye(4)), np.array([self.x_m, self.y_m, self.z_m])

    def place(self, positions: FloatArray) -> FloatArray:
        """Points ``(..., 3)`` of somebody in the middle, metres, as they are in this seat."""
        turn, _, place = self._turning
        return product(positions, turn) + place

    def turn(self, rotations: FloatArray) -> FloatArray:
        """World rotations ``(..., 4)`` of somebody in the middle, as they are in this seat."""
        return product(rotations, self._turning[1])


_SEATS = (
    Seat("middle"),
    Seat("left", x_m=0.62, facing_rad=-0.3),
    Seat("right", x_m=-0.62, facing_rad=0.3),
    Seat("far left", x_m=1.55, z_m=0.35, facing_rad=-0.6),
    Seat("far right", x_m=-1.55, z_m=0.35, facing_rad=0.6),
    Seat("drums", z_m=-2.15, y_m=0.2),
)

SEATS: Mapping[str, Seat] = MappingProxyType({seat.name: seat for seat in _SEATS})
"""All seats by name; left and right are the players'."""

SEATS_FOR: Mapping[int, tuple[str, ...]] = MappingProxyType(
    {
        1: ("middle",),
        2: ("right", "left"),
        3: ("middle", "far right", "far left"),
        4: ("right", "left", "far right", "far left"),
    }
)
"""Where so many players stand where nobody chose, in the cast's order."""
