"""A player's shape: MakeHuman's targets as the figure's file takes them, and the mesh in metres."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from body.makehuman import BODY_VERTEX_COUNT, BaseMesh

if TYPE_CHECKING:
    from pathlib import Path

    from body.figure_file import FigureFile

Array = NDArray[np.float64]

METRES_PER_DECIMETRE = 0.1
SOLE_M = 0.0165  # how far the shoes hold the bare feet off the floor

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


def shape_figure(data: Path, file: FigureFile) -> Figure:
    """Read the base mesh, apply the figure's targets, and bring all to metres with the floor at zero."""
    mesh = BaseMesh(data)
    mesh.apply_macro(file.sex, file.races, file.shape)
    for pattern, weight in file.both_sides.items():
        for side in "lr":
            mesh.apply(pattern.format(side), weight)
    for name, weight in file.details.items():
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
