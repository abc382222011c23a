"""Where a stick and the hand are when they do not only strike with the tip.

A rim shot touches head and hoop at once, so both say how the stick lies. For a cross-stick the hand lies on
the head over the tip, and the shaft clicks on the hoop opposite. A hand that chokes a cymbal comes from where
its arm is. All of it is in the kit's frame.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

from reina.instruments.drums.motion.hand_shapes import CHOKE, CROSS_STICK, PLAY, TWIRL
from reina.instruments.drums.motion.kit_places import UP

if TYPE_CHECKING:
    from reina.instruments.drums.motion.kit_places import KitPlaces, ZonePlace
    from reina.rotations.arrays import FloatArray

SHAFT_M: Final = 0.0072
BEAD_M: Final = 0.0048
"""Radii of the stick's shaft and of its tip."""

ELBOW_PLACES: Final = np.array([[-0.30, -0.15], [0.30, -0.15]])
"""Where the elbows are at ease, across and ahead, metres; the player's right first."""
INWARD_RAD: Final = np.radians([20.0, -20.0])
"""How far a stick points inward from the line from elbow to tip, about +Y."""

ACROSS_DRUM_RAD: Final = np.radians(68.0)
"""How far the stick of a cross-stick points inward from straight ahead."""
NEARER_M: Final = 0.045
"""It lies so much nearer to the player than the middle of the head."""
REACH_M: Final = (0.294, 1.6)
"""From tip to hoop: so far, and at most so many radii of the hoop."""

RAISED_ELBOWS: Final = np.array([[-0.44, -0.10], [0.44, -0.10]])
"""Where the elbows are about, seen from a raised hand; the player's right first."""

EDGE_OUT_M: Final = 0.006
"""From a cymbal's zone to the edge itself."""

TWIRL_PLACE_M: Final = np.array([0.33, 1.10, 0.30])
"""Where a hand twirls its stick; on the player's left."""
TWIRL_ALONG: Final = np.array([-0.10, 0.40, 0.91])
"""Which way its fingers point then."""
STICK_M: Final = 0.265
ACROSS_RAD: Final = np.radians(48.0)
"""From where the stick is held to its tip, and how far it is turned from the fingers to the thumb."""


@dataclass(frozen=True, eq=False)
class Placing:
    """How a stick and its hand lie at a place.

    Attributes:
        point: (3,) where what is to be there is, metres.
        normal: (3,) the way that it is lifted.
        heading: (3,) which way the stick points from above, level, a unit vector.
        slope: Sine of how steeply it points down.
        shape: Of `HAND_SHAPES`.
        along: (3,) where the hand is placed by itself, which way it goes along what it touches.
        out: (3,) and out of that.
        lever_m: From the tip to where the shaft strikes, if the hand turns about the tip; else 0.
        outward: (3,) level, from a cymbal's middle to its zone, which its tilt goes by.
    """

    point: FloatArray
    normal: FloatArray
    heading: FloatArray
    slope: float
    shape: int = PLAY
    along: FloatArray | None = None
    out: FloatArray | None = None
    lever_m: float = 0.0
    outward: FloatArray | None = None


def rim_shot(places: KitPlaces, piece: str, point: FloatArray, side: int) -> Placing | None:
    """The tip on the head and the shaft on the hoop; None where the piece has no hoop.

    Args:
        places: The kit.
        piece: What is struck.
        point: (3,) where the tip lands on the head.
        side: 0 on the player's right, 1 on the left.
    """
    hoop = _hoop(places, piece)
    if hoop is None:
        return None
    middle, normal, radius, over = hoop
    point = point - normal * float((point - middle) @ normal)
    ahead = _across(_from_elbow(point, side), normal)
    # Back from the tip to the hoop.
    offset = point - middle
    along = float(offset @ ahead)
    far = along + np.sqrt(max(along * along + radius * radius - float(offset @ offset), 0.0))
    steep = np.arctan2(over + SHAFT_M - BEAD_M, far)
    stick = ahead * np.cos(steep) - normal * np.sin(steep)
    return Placing(point, normal, _unit(stick * (1.0, 0.0, 1.0)), -float(stick[1]))


def cross_stick(places: KitPlaces, piece: str, side: int) -> Placing | None:
    """The hand on the head, the shaft on the hoop opposite; None where the piece has no hoop."""
    hoop = _hoop(places, piece)
    if hoop is None:
        return None
    middle, normal, radius, over = hoop
    inward = ACROSS_DRUM_RAD * (-1.0 if side else 1.0)
    ahead = _across(np.array([np.sin(inward), 0.0, np.cos(inward)]), normal)
    nearer = _unit(np.cross(normal, ahead))
    nearer = nearer if nearer[2] < 0.0 else -nearer
    off = min(NEARER_M, 0.4 * radius)
    reach = min(REACH_M[0], REACH_M[1] * radius)
    struck = middle + off * nearer + np.sqrt(radius * radius - off * off) * ahead
    rise = float(np.arctan2(over + SHAFT_M - BEAD_M, reach))
    butt = ahead * np.cos(rise) + normal * np.sin(rise)
    return Placing(
        struck - reach * ahead,
        normal,
        _unit(-ahead * (1.0, 0.0, 1.0)),
        float(butt[1]),
        CROSS_STICK,
        butt,
        normal,
        reach,
    )


def choke(zone: ZonePlace, side: int) -> Placing:
    """A hand at a cymbal's edge, on the side where its elbow is."""
    elbow = np.array([RAISED_ELBOWS[side, 0], zone.pivot[1], RAISED_ELBOWS[side, 1]])
    axis = zone.axis
    radial = _across(elbow - zone.pivot, axis)
    arm = zone.position - zone.pivot
    height = float(arm @ axis)
    radius = float(np.linalg.norm(arm - height * axis))
    level = _across(zone.outward, axis)
    # What its surface falls outward, all round as it is at the zone.
    fall = float(zone.normal @ level) / max(float(zone.normal @ axis), 0.1)
    edge = zone.pivot + (height - fall * EDGE_OUT_M) * axis + (radius + EDGE_OUT_M) * radial
    out = _unit(axis + fall * radial)
    along = _unit(-radial + fall * axis)
    return Placing(
        edge,
        _unit(radial * (1.0, 0.0, 1.0)),
        _unit(along * (1.0, 0.0, 1.0)),
        0.0,
        CHOKE,
        along,
        out,
        outward=zone.outward,
    )


def twirl(side: int) -> Placing:
    """A hand held up beside the kit, its stick clear of everything."""
    own = np.array([1.0 if side else -1.0, 1.0, 1.0])
    along = _unit(TWIRL_ALONG * own)
    out = _across(UP, along)
    thumb = np.cross(along, out) * own[0]
    stick = np.cos(ACROSS_RAD) * along + np.sin(ACROSS_RAD) * thumb
    return Placing(
        TWIRL_PLACE_M * own + STICK_M * stick,
        UP,
        _unit(stick * (1.0, 0.0, 1.0)),
        -float(stick[1]),
        TWIRL,
        along,
        out,
    )


def _hoop(places: KitPlaces, piece: str) -> tuple[FloatArray, FloatArray, float, float] | None:
    """A drum's middle and normal, its hoop's radius, and how far the hoop's top is over the head."""
    head, rim = places[piece, "centre"], places[piece, "rim"]
    if rim.zone != "rim" or head.zone != "centre":
        return None
    offset = rim.position - head.position
    over = float(offset @ head.normal)
    return head.position, head.normal, float(np.linalg.norm(offset - over * head.normal)), over


def _from_elbow(point: FloatArray, side: int) -> FloatArray:
    """Which way a stick points from above that comes from where its elbow is (3,)."""
    ahead = _unit(np.array([point[0] - ELBOW_PLACES[side, 0], 0.0, point[2] - ELBOW_PLACES[side, 1]]))
    turn = INWARD_RAD[side]
    return np.array(
        [
            ahead[0] * np.cos(turn) + ahead[2] * np.sin(turn),
            0.0,
            ahead[2] * np.cos(turn) - ahead[0] * np.sin(turn),
        ]
    )


def _across(vector: FloatArray, normal: FloatArray) -> FloatArray:
    """A vector's part across a normal, at length 1."""
    return _unit(vector - normal * float(vector @ normal))


def _unit(vector: FloatArray) -> FloatArray:
    return vector / np.linalg.norm(vector)
