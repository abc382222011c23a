"""A drumstick in the hand: across the palm, under the fingers, between thumb and index (matched grip)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from hold.collision import Obstacles
from hold.finger import Finger
from hold.grip import FINGERS, MM
from hold.thumb import Thumb

if TYPE_CHECKING:
    from hold.rig import Pose, Rig

Array = NDArray[np.float64]

STICK_RADIUS_M = 0.0072
ACROSS_RAD = np.radians(48.0)
"""How far the stick is turned from the fingers' direction to the thumb's side."""
FULCRUM_M = (0.092, -0.0275, 0.020)
"""Where the stick's axis passes the index finger; the last toward the thumb."""
THUMB_AHEAD_M = 0.006
"""How far before the index finger the thumb lies."""
LEAST_RAD = np.radians([-68.0, -125.0, -43.0])
"""How far the finger's three joints may be bent."""
FLESH_M = 0.0015
"""How deep a finger may lie in the stick."""


@dataclass
class StickGrip:
    """A stick's `fulcrum` (3,) and unit `direction` (3,) in the hand's frame, and the fingers' pose."""

    fulcrum: Array
    direction: Array
    pose: Pose

    @classmethod
    def solve(cls, rig: Rig, side: str) -> StickGrip:
        """Close one hand round a stick."""
        radial = 1.0 if side == "left" else -1.0
        fulcrum = np.array(FULCRUM_M) * [1.0, 1.0, radial]
        direction = np.array([np.cos(ACROSS_RAD), 0.0, radial * np.sin(ACROSS_RAD)])
        pose: Pose = {}
        for name in FINGERS:
            finger = Finger.of(rig, f"{side}{name}")
            angles = close_finger(finger, fulcrum, direction)
            pose.update(finger.local_rotations(angles))
        thumb = Thumb.of(rig, side)
        pose.update(thumb.local_rotations(press_thumb(thumb, fulcrum, direction)))
        return cls(fulcrum, direction, pose)


def _stick(fulcrum: Array, direction: Array) -> Obstacles:
    ends = fulcrum - 0.13 * direction, fulcrum + 0.27 * direction
    return Obstacles([{"from": ends[0], "to": ends[1], "radius": STICK_RADIUS_M}])


def close_finger(finger: Finger, fulcrum: Array, direction: Array) -> Array:
    """Angles (4,) that lay a finger round the stick: its pad comes from below, no bone lies in the stick."""
    stick = _stick(fulcrum, direction)
    reach = (finger.knuckle[2] - fulcrum[2]) / direction[2]
    under = fulcrum + reach * direction - [0.0, STICK_RADIUS_M, 0.0]

    def residuals(x: Array) -> Array:
        centres, radii = finger.spheres(x, 6)
        gap = stick.clearance(centres) - radii
        pad = finger.points(x)[3]
        return np.r_[
            np.minimum(gap + FLESH_M, 0.0) * MM * 2.0,
            (pad - under) * MM * [0.5, 0.5, 0.25],
            gap[-1] * MM,
            (x[3] - 0.4 * x[2]) * 1.0,
            x[0] * 8.0,
            np.maximum(x[1:] - [1.0, 0.0, 0.0], 0.0) * 20.0,
            np.minimum(x[1:] - LEAST_RAD, 0.0) * 120.0,
        ]

    best = min(
        (
            least_squares(residuals, [0.0, first, second, 0.4 * second])
            for first in np.radians([-10.0, -40.0, -70.0])
            for second in np.radians([-50.0, -90.0])
        ),
        key=lambda found: found.cost,
    )
    return np.asarray(best.x)


def press_thumb(thumb: Thumb, fulcrum: Array, direction: Array) -> Array:
    """Angles (5,) that lay the thumb's pad on the stick, from above and from its own side."""
    stick = _stick(fulcrum, direction)

    def residuals(x: Array) -> Array:
        points, looking = thumb.points(x)
        centres, radii = thumb.spheres(x, 5)
        gap = stick.clearance(centres) - radii
        along = (points[3] - fulcrum) @ direction
        inward = fulcrum + along * direction - points[3]
        inward /= np.linalg.norm(inward)
        return np.r_[
            gap[-1] * MM * 2.0,
            (along - THUMB_AHEAD_M) * MM * 0.5,
            (looking - inward) * 4.0,
            np.minimum(inward @ [0.0, -1.0, 0.0] - 0.2, 0.0) * 8.0,
            np.minimum(gap[:-1] + FLESH_M, 0.0) * MM * 2.0,
            x[:3] * 3.0,
            x[3:] * 1.5,
            np.maximum(np.abs(x) - np.radians([38.0, 34.0, 52.0, 60.0, 60.0]), 0.0) * 40.0,
        ]

    best = min(
        (least_squares(residuals, start) for start in (np.zeros(5), np.array([0.0, 0.3, -0.3, -0.4, -0.4]))),
        key=lambda found: found.cost,
    )
    return np.asarray(best.x)


def lacking(rig: Rig, side: str, grip: StickGrip) -> list[str]:
    """How far each pad is from the stick and how deep each finger lies in it, for the report."""
    stick = _stick(grip.fulcrum, grip.direction)
    lines: list[str] = []
    for name in FINGERS:
        finger = Finger.of(rig, f"{side}{name}")
        angles = close_finger(finger, grip.fulcrum, grip.direction)
        centres, radii = finger.spheres(angles, 6)
        gap = (stick.clearance(centres) - radii) * MM
        lines.append(
            f"{finger.name}: pad {gap[-1]:.1f} mm, deepest {gap.min():.1f} mm, {np.degrees(angles).round()}"
        )
    thumb = Thumb.of(rig, side)
    angles = press_thumb(thumb, grip.fulcrum, grip.direction)
    centres, radii = thumb.spheres(angles, 5)
    gap = (stick.clearance(centres) - radii) * MM
    lines.append(
        f"{thumb.name}: pad {gap[-1]:.1f} mm, deepest {gap.min():.1f} mm, {np.degrees(angles).round()}"
    )
    return lines
