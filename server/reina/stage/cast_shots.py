"""Camera shots of a cast: everybody in one picture, or one player from the side where nobody stands."""

from collections.abc import Sequence
from types import MappingProxyType

import numpy as np

from reina.curves.arrays import FloatArray
from reina.stage.cast_form import Place
from reina.stage.drum_shots import DRUM_SHOTS, INSTEAD
from reina.stage.shots import SHOTS, Point, Pose, Shot

BODY: FloatArray = np.array([[x, y, z] for x in (-0.42, 0.42) for y in (0.35, 1.85) for z in (-0.25, 0.8)])
"""Corners of what a player and the instrument fill, from the knees up, metres."""

KIT: FloatArray = np.array([[x, y, z] for x in (-1.0, 0.9) for y in (0.1, 1.45) for z in (-0.2, 1.3)])
"""The same of a drummer on the stool and the kit."""

FOV = 0.5
"""Vertical angle of view of the pictures of everybody, radians."""

WITHIN = 0.88
"""How far from the middle to the edge of a 16:9 picture everybody may come."""

FURTHER = 1.1
"""By what factor a slow move comes from further away."""

AROUND = MappingProxyType(
    {
        "everybody": (-0.5, 0.1),
        "everybody from the left": (0.5, 0.08),
        "everybody from above": (-0.28, 0.42),
        "everybody from below": (-0.36, -0.08),
    }
)
"""Where the camera stands around everybody: to the side, positive at the players' left, and up, radians."""

OVER_CYMBALS = 0.2
"""How much higher than `AROUND` for a drummer alone, so that the face is above the cymbals, radians."""

HANDS = ("valves", "crane")
"""What shows the fingers: by the side where nobody stands, and from above where somebody does."""


def cast_shot(name: str, lead: int, places: Sequence[Place]) -> Shot:
    """A shot of `shot_choice.TOGETHER` or `WITH_DRUMS`.

    Args:
        name: Its name.
        lead: The player who has the tune.
        places: Where each player stands; one of them at the drums, if the shot is one of `DRUM_SHOTS`.
    """
    if name in AROUND:
        side_rad, up_rad = AROUND[name]
        up_rad += OVER_CYMBALS if all(place.at_drums for place in places) else 0.0
        start, end = (_everybody(side_rad, up_rad, places, further) for further in (FURTHER, 1.0))
        return Shot(name, start, end)
    if name in DRUM_SHOTS:
        lead = next(player for player, place in enumerate(places) if place.at_drums)
    place = places[lead]
    if place.at_drums:
        shot = DRUM_SHOTS[INSTEAD.get(name, name)]
        side = -1.0 if place.mirrored else 1.0
        return Shot(
            f"{shot.name} of player {lead + 1}", *(_placed(p, place, side) for p in (shot.start, shot.end))
        )
    if name == "hands":
        name = HANDS[any(abs(other.x_m) > abs(place.x_m) for other in places if other is not place)]
    shot = SHOTS[name]
    # From the outer side nobody is in between, and the others are seen behind.
    side = -1.0 if place.x_m > 0.0 else 1.0
    start, end = _placed(shot.start, place, side), _placed(shot.end, place, side)
    return Shot(f"{name} of player {lead + 1}", start, end)


def _placed(pose: Pose, place: Place, side: float) -> Pose:
    """A pose around somebody in the middle, around a place; side -1 is seen as in a mirror."""
    position, target = place.put(np.array([pose.position, pose.target]) * [side, 1.0, 1.0])
    return Pose(_point(position), _point(target), pose.fov)


def _everybody(side_rad: float, up_rad: float, places: Sequence[Place], further: float) -> Pose:
    """As near as everybody is in the picture."""
    corners = np.concatenate([place.put(_filled(place)) for place in places])
    middle = 0.5 * (corners.min(axis=0) + corners.max(axis=0))
    back = np.array([np.sin(side_rad) * np.cos(up_rad), np.sin(up_rad), np.cos(side_rad) * np.cos(up_rad)])
    right = np.array([np.cos(side_rad), 0.0, -np.sin(side_rad)])
    up = np.cross(back, right)
    apart = corners - middle
    half = np.tan(FOV / 2.0) * WITHIN
    needed = np.maximum(np.abs(apart @ right) / (half * 16.0 / 9.0), np.abs(apart @ up) / half)
    distance = float((needed + apart @ back).max()) * further
    return Pose(_point(middle + distance * back), _point(middle), FOV)


def _filled(place: Place) -> FloatArray:
    """Corners of what is at a place, around somebody in the middle."""
    corners = KIT if place.at_drums else BODY
    return corners * [-1.0, 1.0, 1.0] if place.mirrored else corners


def _point(point: FloatArray) -> Point:
    x, y, z = np.round(point, 3).tolist()
    return x, y, z
