"""Where everything of the kit stands and how large it is, metres.

The kit's frame: the origin lies on the floor under the middle of the stool, +Z is where the player faces,
+Y up, +X the player's left. The kit is a right-handed player's, and fits one of 1.6 m on a stool of 0.5 m.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
INCH = 0.0254

HEAD_FROM = np.array([0.0, 1.0, 0.0])
"""Roughly where the player's chest is: what is struck looks there."""

HOOP_OUT = 0.006
"""How far outside of the shell the middle of its hoop's wall is."""
HOOP_WALL = 0.0024
HOOP_BEAD = 0.0028
HOOP_OVER = 0.012
"""From the head up to the middle of the hoop's rolled edge."""
HOOP_TOP = HOOP_OVER + HOOP_BEAD
HOOP_DEPTH = 0.028
COLLAR = 0.0015
"""The head lies so far over the shell's bearing edge."""


def unit(vector: Array | tuple[float, float, float]) -> Array:
    """A vector at length 1."""
    array = np.asarray(vector, dtype=np.float64)
    return array / np.linalg.norm(array)


def tilted(tilt_deg: float, heading_deg: float) -> Array:
    """The unit vector that leans from straight up by `tilt_deg` toward a heading on the floor.

    A heading of 0 is toward the player (−Z), positive ones turn to the player's left (+X).
    """
    tilt, heading = np.radians([tilt_deg, heading_deg])
    return np.array(
        [np.sin(tilt) * np.sin(heading), np.cos(tilt), -np.sin(tilt) * np.cos(heading)], dtype=np.float64
    )


@dataclass(frozen=True)
class Drum:
    """A drum by its batter head: `centre` of the head's surface, `normal` out of it.

    `radius` and `depth` are the shell's; `lugs` are tension rods a head.
    """

    name: str
    centre: tuple[float, float, float]
    normal: tuple[float, float, float]
    radius: float
    depth: float
    lugs: int

    @cached_property
    def axis(self) -> Array:
        """Out of the batter head."""
        return unit(self.normal)

    @cached_property
    def toward_player(self) -> Array:
        """In the head's plane, toward the player; down on the bass drum, whose head looks at the player."""
        down = np.array([0.0, -1.0, 0.0])
        over = down if abs(self.axis[2]) > 0.8 else HEAD_FROM - np.array(self.centre)
        return unit(over - self.axis * (over @ self.axis))

    @property
    def hoop_radius(self) -> float:
        """Of the hoop wall's middle."""
        return self.radius + HOOP_OUT

    def lug_turns(self) -> Array:
        """Where its lugs are, turned from the player's side; none lies right there."""
        return (np.arange(self.lugs) + 0.5) * 2 * np.pi / self.lugs

    def at(self, along: float, out: float = 0.0, turn: float = 0.0) -> Array:
        """A point `along` the axis from the head, `out` from the axis, turned from the player's side."""
        u = self.toward_player
        w = np.cross(self.axis, u)
        return np.array(self.centre) + self.axis * along + out * (u * np.cos(turn) + w * np.sin(turn))


@dataclass(frozen=True)
class Cymbal:
    """A cymbal on its stand: `pivot` is the middle of the hole, `normal` its axis up.

    `bell` and `bell_height` and `bow_height` are the profile's; a `flange` turns the edge up.
    """

    name: str
    pivot: tuple[float, float, float]
    tilt_deg: float
    heading_deg: float
    radius: float
    bell: float
    bell_height: float
    bow_height: float
    flange: float = 0.0

    @cached_property
    def rotation(self) -> Array:
        """Its frame in the kit's, a matrix: +Y the axis up, −Z toward the side that leans to the player."""
        y = tilted(self.tilt_deg, self.heading_deg)
        ahead = np.radians(self.heading_deg)
        toward = np.array([np.sin(ahead), 0.0, -np.cos(ahead)])
        z = -unit(toward - y * (toward @ y))
        return np.column_stack([np.cross(y, z), y, z])

    def height(self, radius: Array | float) -> Array:
        """The upper surface over the hole's plane at distances from the axis."""
        r = np.asarray(radius, dtype=np.float64)
        bell = self.bell
        # A dome that is steep where it meets the bow.
        dome = 1.0 - np.sqrt(1.0 - BELL_ROUND * np.clip(r / bell, 0, 1) ** 2)
        on_bell = -self.bell_height * dome / (1.0 - np.sqrt(1.0 - BELL_ROUND))
        t = np.clip((r - bell) / (self.radius - bell), 0, 1)
        if self.flange:
            turn = 0.74
            down = -self.bow_height * np.clip(t / turn, 0, 1) ** 1.5
            up = self.flange * np.clip((t - turn) / (1 - turn), 0, 1) ** 1.35
            return np.asarray(on_bell + down + up)
        return np.asarray(on_bell - self.bow_height * (0.45 * t + 0.55 * t**2))

    def slope(self, radius: float) -> float:
        """The upper surface's steepness there."""
        step = 1e-5
        return float((self.height(radius + step) - self.height(radius - step)) / (2 * step))


KICK_X = -0.19
KICK = Drum("kick", (KICK_X, 0.315, 0.76), (0.0, 0.0, -1.0), 11 * INCH, 14 * INCH, 10)
SNARE = Drum("snare", (0.04, 0.65 - HOOP_TOP, 0.40), (0.0, 1.0, 0.0), 7 * INCH, 5.5 * INCH, 10)
TOM_HIGH = Drum("tom_high", (0.045, 0.845, 0.72), tuple(tilted(22, 4)), 5 * INCH, 7 * INCH, 6)
TOM_MID = Drum("tom_mid", (-0.305, 0.845, 0.72), tuple(tilted(22, 14)), 6 * INCH, 8 * INCH, 6)
TOM_FLOOR = Drum("tom_floor", (-0.63, 0.61, 0.27), tuple(tilted(5, 40)), 8 * INCH, 14 * INCH, 8)
DRUMS = (SNARE, KICK, TOM_HIGH, TOM_MID, TOM_FLOOR)
KICK_HOOP_WIDTH = 0.040
KICK_HOOP_THICK = 0.009
KICK_HOOP_OVER = 0.016
"""How far the bass drum's wooden hoop stands over its head."""

HAT_X, HAT_Z = 0.40, 0.58
HAT_GAP = 0.026
"""Between the hi-hat's edges while its pedal is up."""
HI_HAT_TOP = Cymbal("hi_hat_top", (HAT_X, 0.892, HAT_Z), 0.0, -35.0, 7 * INCH, 0.050, 0.016, 0.017)
HAT_EDGE_Y = HI_HAT_TOP.pivot[1] - HI_HAT_TOP.bell_height - HI_HAT_TOP.bow_height
CYMBALS = (
    HI_HAT_TOP,
    Cymbal("ride", (-0.70, 1.010, 0.56), 16.0, 44.0, 10 * INCH, 0.066, 0.021, 0.023),
    Cymbal("crash_left", (0.35, 1.16, 0.77), 20.0, -24.0, 8 * INCH, 0.054, 0.016, 0.020),
    Cymbal("crash_right", (-0.49, 1.20, 0.74), 20.0, 32.0, 9 * INCH, 0.060, 0.017, 0.022),
    Cymbal("china", (-0.84, 1.15, 0.32), 20.0, 64.0, 8 * INCH, 0.050, 0.022, 0.022, 0.020),
    Cymbal("splash", (-0.13, 1.112, 0.853), 18.0, 4.0, 5 * INCH, 0.038, 0.012, 0.010),
)
CYMBAL_THICKNESS = 0.0014
HOLE = 0.0055
BELL_ROUND = 0.80
"""How much of a half sphere a bell is: 0 is a flat arc, 1 would end upright."""

# The cowbell: a flattened cone, its mouth toward the player.
COWBELL_MOUTH = np.array([-0.13, 0.909, 0.765])
COWBELL_BACK = np.array([-0.13, 0.899, 0.940])
COWBELL_MOUTH_SIZE = (0.094, 0.058)
COWBELL_BACK_SIZE = (0.062, 0.040)


@dataclass(frozen=True)
class Pedal:
    """A board that turns about the hinge at its heel; at rest it is as high as its spring holds it.

    `toe` is where the board's end lies over on the floor (x, z), `heading_deg` where it points: 0 is ahead
    (+Z), positive ones turn to the player's left.
    """

    name: str
    toe: tuple[float, float]
    heading_deg: float
    length: float = 0.30
    hinge_y: float = 0.028
    rise_deg: float = 17.0
    down_deg: float = 7.0
    half_width: float = 0.043

    @cached_property
    def ahead(self) -> Array:
        """On the floor, from heel to toe."""
        heading = np.radians(self.heading_deg)
        return np.array([np.sin(heading), 0.0, np.cos(heading)])

    @cached_property
    def hinge(self) -> Array:
        """The middle of the hinge."""
        run = self.length * np.cos(np.radians(self.rise_deg))
        return np.array([self.toe[0], self.hinge_y, self.toe[1]]) - self.ahead * run

    @cached_property
    def rotation(self) -> Array:
        """The board's frame at rest in the kit's, a matrix: +Z along the board, +Y out of its top."""
        rise = np.radians(self.rise_deg)
        z = self.ahead * np.cos(rise) + np.array([0.0, np.sin(rise), 0.0])
        x = unit(np.cross([0.0, 1.0, 0.0], z))
        axes: Array = np.column_stack([x, np.cross(z, x), z]).astype(np.float64)
        return axes


AXLE = np.array([KICK_X, 0.165, 0.680])
SPROCKET = 0.035
BEATER_REACH = 0.150
"""From the axle to the beater's middle."""
BEATER_HALF = 0.022
BEATER_REST_DEG = -38.0
"""About +X from straight up: the beater leans back to the player while the pedal is up."""
KICK_PEDAL = Pedal("kick_pedal", (KICK_X, float(AXLE[2]) + SPROCKET), 0.0)
HAT_PEDAL = Pedal("hi_hat_pedal", (HAT_X - 0.007, HAT_Z - 0.023), 16.0, length=0.285)
PEDALS = (KICK_PEDAL, HAT_PEDAL)
BOARD_TOP = 0.005
"""How far a board's top lies over the hinge's middle, out of the board."""
BALL = 0.53
"""Share of a board's length at which the ball of the foot rests."""

SEAT_TOP = 0.50
SEAT_RADIUS = 0.165
SEAT_THICK = 0.085


def beater_contact_rad() -> float:
    """The beater's angle about +X from straight up at which it touches the head."""
    return float(np.arcsin((KICK.centre[2] - BEATER_HALF - AXLE[2]) / BEATER_REACH))


# Sticks, 5A: from the grip, a third from the butt.
STICK_LENGTH = 0.406
STICK_RADIUS = 0.0072
STICK_BUTT = STICK_LENGTH / 3
BEAD_RADIUS = 0.0048
BEAD_LENGTH = 0.0115
