"""The player's shape: which of MakeHuman's targets make her, and her mesh in metres."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from body.makehuman import BODY_VERTEX_COUNT, BaseMesh

if TYPE_CHECKING:
    from pathlib import Path

Array = NDArray[np.float64]

METRES_PER_DECIMETRE = 0.1
SOLE_M = 0.0165  # how far the shoes hold the bare feet off the floor

RACES = {"caucasian": 0.45, "asian": 0.55}
SHAPE = {"muscle": 0.45, "weight": 0.40, "height": 0.56, "proportions": 0.95, "cup": 0.2, "firmness": 0.8}
BOTH_SIDES = {
    "eyes/{}-eye-scale-incr": 1.45,
    "eyes/{}-eye-height2-incr": 0.75,
    "eyes/{}-eye-corner2-up": 0.10,
    "cheek/{}-cheek-bones-decr": 0.35,
    "cheek/{}-cheek-volume-incr": 0.12,
    "hands/{}-hand-fingers-length-incr": 0.22,
}
DETAILS = {
    "arms/measure-upperarm-length-incr": 0.42,
    "arms/measure-lowerarm-length-incr": 0.32,
    "nose/nose-scale-horiz-decr": 0.5,
    "nose/nose-scale-vert-decr": 0.35,
    "nose/nose-point-up": 0.25,
    "nose/nose-volume-decr": 0.35,
    "nose/nose-nostrils-width-decr": 0.3,
    "mouth/mouth-scale-horiz-decr": 0.55,
    "mouth/mouth-angles-up": 0.3,
    "mouth/mouth-lowerlip-height-decr": 0.35,
    "mouth/mouth-upperlip-height-decr": 0.2,
    "mouth/mouth-lowerlip-volume-decr": 0.3,
    "chin/chin-width-decr": 0.45,
    "chin/chin-triangle": 0.5,
    "chin/chin-height-decr": 0.35,
    "chin/chin-bones-decr": 0.4,
    "chin/chin-prominent-decr": 0.15,
    "head/head-age-decr": 0.5,
    "head/head-oval": 0.35,
    "neck/neck-scale-horiz-decr": 0.25,
    "neck/neck-scale-depth-decr": 0.2,
    "forehead/forehead-scale-vert-incr": 0.1,
}

# The morph's name in the models, the face targets that make it, and how strongly.
MORPHS: dict[str, tuple[tuple[str, ...], float]] = {
    "eyeBlinkLeft": (("eyeBlinkLeft",), 1.0),
    "eyeBlinkRight": (("eyeBlinkRight",), 1.0),
    "cheekPuff": (("cheekPuff",), 1.0),
    "mouthPucker": (("mouthPucker",), 1.0),
    "mouthPress": (("mouthPressLeft", "mouthPressRight"), 1.0),
    "jawOpen": (("jawOpen",), 1.0),
    "browInnerUp": (("browInnerUp",), 1.0),
    "mouthSmile": (("mouthSmileLeft", "mouthSmileRight"), 1.0),
}


@dataclass
class Figure:
    """The shaped body: `vertices` (V, 3) in metres, floor at y = 0 under the soles.

    `morphs` by name (V, 3).
    """

    mesh: BaseMesh
    vertices: Array
    bone_heads: dict[str, Array]
    bone_tails: dict[str, Array]
    morphs: dict[str, Array]

    @property
    def body(self) -> Array:
        """The body's own vertices (13380, 3), without the helper surfaces."""
        return self.vertices[:BODY_VERTEX_COUNT]

    def centre(self, group: str) -> Array:
        """The mean vertex (3,) of a group of polygons."""
        mean: Array = self.vertices[self.mesh.vertex_set(group)].mean(axis=0)
        return mean


def shape_figure(data: Path) -> Figure:
    """Read the base mesh, apply the player's targets, and bring all to metres with the floor at zero."""
    mesh = BaseMesh(data)
    mesh.apply_macro(RACES, SHAPE)
    for pattern, weight in BOTH_SIDES.items():
        for side in "lr":
            mesh.apply(pattern.format(side), weight)
    for name, weight in DETAILS.items():
        mesh.apply(name, weight)
    floor = np.array([0.0, mesh.vertices[:BODY_VERTEX_COUNT, 1].min() - SOLE_M / METRES_PER_DECIMETRE, 0.0])
    bones = mesh.bones()
    return Figure(
        mesh=mesh,
        vertices=(mesh.vertices - floor) * METRES_PER_DECIMETRE,
        bone_heads={name: (bone.head - floor) * METRES_PER_DECIMETRE for name, bone in bones.items()},
        bone_tails={name: (bone.tail - floor) * METRES_PER_DECIMETRE for name, bone in bones.items()},
        morphs={
            name: mesh.face_unit(units) * METRES_PER_DECIMETRE * weight
            for name, (units, weight) in MORPHS.items()
        },
    )
