"""Where a hand's joints lie: knuckles found in the mesh, and fingers laid into planes.

A finger's proximal, intermediate and distal joints and its pad lie in one plane whose normal is the Z axis
of all three, so that a planar three-bone solve is exact. +X runs to the next joint (from the distal joint:
to the pad), +Y is dorsal, and flexion is a negative turn about Z on both hands.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from body.joint_names import FINGERS, SOURCE_FINGERS
from common.raycast import first_hit

if TYPE_CHECKING:
    from body.figure import Figure

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

# The source's first finger joint lies at the web. The knuckle is this far back along the metacarpal, in
# metres, which brings proximal : intermediate : distal near 2 : 1.2 : 1 as in a person's hand.
KNUCKLE_BACK_M = {"Index": 0.0165, "Middle": 0.0150, "Ring": 0.0150, "Little": 0.0135}
KNUCKLE_DEPTH_M = {
    "Index": 0.0090,
    "Middle": 0.0092,
    "Ring": 0.0086,
    "Little": 0.0078,
}  # below the dorsal skin
PAD_ALONG = 0.74  # the pad lies at this share of the distal bone's length, on the palmar skin
THUMB_PAD_ALONG = 0.72


@dataclass
class Digit:
    """World `places` of three joints, each joint's world `axes` (3, 3), and the `pad` (3,) on the skin."""

    places: list[Array]
    axes: list[Array]
    pad: Array


def knuckles(figure: Figure, letter: str, faces: Indices) -> dict[str, Array]:
    """The metacarpophalangeal joints.

    Back from the web along the metacarpal, at bone depth below the dorsal skin.
    """
    wrist = figure.bone_heads[f"hand_{letter}"]
    web = {f: figure.bone_heads[f"{SOURCE_FINGERS[f]}_01_{letter}"] for f in FINGERS}
    next_joint = {f: figure.bone_heads[f"{SOURCE_FINGERS[f]}_02_{letter}"] for f in FINGERS}
    across = _unit(web["Index"] - web["Little"])
    places: dict[str, Array] = {}
    for finger in FINGERS:
        metacarpal = _unit(_unit(web[finger] - wrist) + _unit(next_joint[finger] - web[finger]))
        place = web[finger] - KNUCKLE_BACK_M[finger] * metacarpal
        dorsal = _unit(np.cross(across, metacarpal))
        dorsal *= np.sign(dorsal[1])  # in the rest pose the backs of the hands look up
        skin = first_hit(place, dorsal, figure.vertices, faces)
        places[finger] = skin - KNUCKLE_DEPTH_M[finger] * dorsal
    return places


def hand_axes(wrist: Array, mcp: dict[str, Array], side: str) -> Array:
    """X to the middle knuckle, Y out of the back of the hand, Z = X × Y.

    On the left hand Z points to the thumb, on the right to the little finger.
    """
    x = _unit(mcp["Middle"] - wrist)
    across = mcp["Index"] - mcp["Little"]
    if side == "right":
        across = -across
    z = _unit(across - x * (x @ across))
    return np.column_stack([x, np.cross(z, x), z])


def finger_joints(figure: Figure, letter: str, finger: str, mcp: Array, hand: Array, faces: Indices) -> Digit:
    """One finger's planar chain; the outer joints are moved into its plane, by a millimetre at most."""
    name = SOURCE_FINGERS[finger]
    pip, dip = (figure.bone_heads[f"{name}_0{k}_{letter}"] for k in (2, 3))
    end = figure.bone_tails[f"{name}_03_{letter}"]
    along = _unit(dip - mcp)
    lateral = hand[:, 2]
    z = _unit(lateral - along * (along @ lateral))
    pip, dip, end = (point - z * (z @ (point - mcp)) for point in (pip, dip, end))
    dorsal = np.cross(z, _unit(end - dip))
    pad = first_hit(dip + PAD_ALONG * (end - dip), -dorsal, figure.vertices, faces)
    points = [mcp, pip, dip, pad]
    axes: list[Array] = []
    for a, b in itertools.pairwise(points):
        x = _unit(b - a)
        axes.append(np.column_stack([x, np.cross(z, x), z]))
    return Digit([mcp, pip, dip], axes, pad)


def thumb_joints(figure: Figure, letter: str, little_knuckle: Array, faces: Indices) -> Digit:
    """The thumb: X along each bone, negative Z flexes toward the little finger's knuckle."""
    places = [figure.bone_heads[f"thumb_0{k}_{letter}"] for k in (1, 2, 3)]
    end = figure.bone_tails[f"thumb_03_{letter}"]
    axes: list[Array] = []
    for a, b in zip(places, [*places[1:], end], strict=True):
        x = _unit(b - a)
        palmar = little_knuckle - a
        y = -_unit(palmar - x * (x @ palmar))
        axes.append(np.column_stack([x, y, np.cross(x, y)]))
    palmar = -axes[2][:, 1]
    pad = first_hit(places[2] + THUMB_PAD_ALONG * (end - places[2]), palmar, figure.vertices, faces)
    return Digit(places, axes, pad)


def _unit(vector: Array) -> Array:
    unit: Array = vector / np.linalg.norm(vector)
    return unit
