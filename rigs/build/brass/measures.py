"""A horn's measures in metres, as a file of instruments/ gives them.

Its frame: +Z to the bell, +Y up, +X the player's left; the origin lies in the second valve.

Valve 1 is nearest the player's face. What a player's hands hold is the same on every horn (valves, first and
third slide with saddle and ring, the hook, the leadpipe beside the valves): they differ in what lies before
and behind it.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).resolve().parents[1] / "instruments"

Y_TOP = 0.0355  # axis height of the leadpipe
Y_LOW = -0.0480  # of the lower tubes
X_LEADPIPE = -0.0165
TUBE = 0.0063  # outer radius of the tubing
VALVE_Z = (-0.0275, 0.0, 0.0275)
CASING = 0.0108
CASING_BOTTOM = -0.0720
CASING_TOP = 0.058
STROKE = 0.0165
STEM_Y = 0.0662  # where a valve's own frame lies
BUTTON_TOP = 0.0240  # top centre of the button in the valve's frame

SLIDE1_X, SLIDE1_Y = 0.006, (-0.026, 0.004)
SLIDE1_Z = VALVE_Z[0] - 0.024  # where the moving slide begins
SLIDE1_REACH = 0.038
SLIDE3_X, SLIDE3_Y = 0.011, (-0.040, -0.015)
SLIDE3_Z = VALVE_Z[2] + 0.040
SLIDE3_REACH = 0.056
SLIDE3_TRAVEL = 0.020
SADDLE = (0.006, SLIDE1_Y[1] + TUBE + 0.012, VALVE_Z[0] - 0.031)
SADDLE_DEPTH = 0.0115
SADDLE_WIRE = 0.0019
RING = (0.0110, SLIDE3_Y[1] + TUBE + 0.0122, VALVE_Z[2] + 0.048)
RING_RADIUS = 0.0112
RING_WIRE = 0.0017
SLIDE2_Y = (-0.025, -0.001)
HOOK_Z = 0.056
HOOK_RADIUS = 0.0024
HOOK_TOP = (X_LEADPIPE - 0.0062, Y_TOP + 0.031, HOOK_Z - 0.017)  # the middle of its wire where it is highest

Point = tuple[float, float, float]
Profile = tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class Bell:
    """The bell's tube: where it runs, and how it widens.

    Attributes:
        x: Of its axis beside the valves.
        y: Height of its axis.
        end: Its end along Z.
        bow: Control points of the cubic curves by which it turns behind the valves, end to end; the first is
            where the straight tube from the first valve ends, the last where the straight run forward begins.
        bow_points: How many points a curve of the bow has.
        radius: Of its end.
        flare, power: The Bessel horn's; see `bell_radius`.
        tail: Radius of its tube where the horn would be narrower.
        rim: Radius of the wire in its rim.
    """

    x: float
    y: float
    end: float
    bow: tuple[Point, ...]
    bow_points: int
    radius: float
    flare: float
    power: float
    tail: float
    rim: float


@dataclass(frozen=True)
class Mouthpiece:
    """A mouthpiece: (axial, radius) of its outside from the shank's end, its rim and its cup.

    `length` reaches to the rim's highest line, `rim_at` is where its outside ends; `cup_shape` is the power
    of the cup's curve: a high one is a bowl, 1 a funnel.
    """

    length: float
    rim_at: float
    cup_depth: float
    cup_shape: float
    outside: Profile


@dataclass(frozen=True)
class Horn:
    """What one horn has of its own.

    Attributes:
        name: Of its rig and the first word of its parameters.
        title: For people.
        wrap: How the tube runs from the mouthpiece to the third valve, by its name in `brass.wraps.WRAPS`.
        receiver: Where the mouthpiece's receiver begins, along Z.
        insertion: How deep the shank goes into it.
        front: Where the leadpipe's bow before the valves begins, along Z.
        front_depth: How far that bow reaches.
        x_return, y_return: Of that bow's lower leg.
        stays: From where to where its stays go, casings aside.
        stay_radii: How thick each is.
        mute_width: Radii of the straight mute, in those of the trumpet's.
        bell: The bell.
        mouthpiece: The mouthpiece.
    """

    name: str
    title: str
    wrap: str
    receiver: float
    insertion: float
    front: float
    front_depth: float
    x_return: float
    y_return: float
    stays: tuple[tuple[Point, Point], ...]
    stay_radii: tuple[float, ...]
    mute_width: float
    bell: Bell
    mouthpiece: Mouthpiece

    @property
    def z_mouthpiece(self) -> float:
        """The shank's end, inside the receiver."""
        return self.receiver + self.insertion

    @property
    def z_rim(self) -> float:
        """Where the lips are."""
        return self.z_mouthpiece - self.mouthpiece.length

    def bell_radius(self, distance_from_end: float) -> float:
        """The bell's outer radius at a distance back from its end: a Bessel horn, then the tail's tube."""
        bell = self.bell
        return max(bell.tail, bell.radius * ((distance_from_end + bell.flare) / bell.flare) ** bell.power)


def read_horn(path: Path) -> Horn:
    """Read a file of instruments/.

    Raises:
        TypeError: If it lacks a measure or has one too many.
    """
    table = tomllib.loads(path.read_text(encoding="utf-8"))
    bell, mouthpiece, stays = (table.pop(name) for name in ("bell", "mouthpiece", "stays"))
    return Horn(
        **table,
        stays=tuple(_points(stay) for stay in stays),
        bell=Bell(**{**bell, "bow": _points(bell["bow"])}),
        mouthpiece=Mouthpiece(**{**mouthpiece, "outside": _points(mouthpiece["outside"])}),
    )


def horns() -> list[Horn]:
    """Every horn there is a file for, by name."""
    return [read_horn(path) for path in sorted(FOLDER.glob("*.toml"))]


def _points(rows: Any) -> Any:
    return tuple(tuple(float(value) for value in row) for row in rows)
