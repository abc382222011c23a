"""The eyeballs: shallow caps turned by the eye joints."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from body.images import jpeg
from body.joint_names import SIDES
from common.meshes import Mesh, joined
from common.parts import Part, Surface
from common.shapes import grid_faces

if TYPE_CHECKING:
    from body.figure import Figure
    from body.images import Picture
    from body.skeleton import Skeleton

Array = NDArray[np.float64]


def eyes(figure: Figure, skeleton: Skeleton, picture: Picture, rings: int, sectors: int) -> Part:
    """Both eyes as one part; each is weighted wholly to its joint."""
    meshes: list[Mesh] = []
    all_normals: list[Array] = []
    for side, letter in SIDES:
        group = figure.vertices[figure.mesh.vertex_set(f"helper-{letter}-eye")]
        radius = float(np.linalg.norm(group - group.mean(axis=0), axis=1).mean()) * 0.985
        directions, uv, bulge = _cap(rings, sectors)
        weights = np.zeros((len(directions), len(skeleton.names)))
        weights[:, skeleton.names.index(f"{side}Eye")] = 1
        vertices = skeleton.positions[f"{side}Eye"] + directions * (radius * bulge)[:, None]
        meshes.append(Mesh(vertices, weights, grid_faces(rings + 1, sectors + 1, flip=True), uv))
        all_normals.append(directions)
    surface = Surface("eyes", 0.08, image=jpeg(picture, 90), shade=None)
    return Part("Eyes", joined(meshes), surface, np.vstack(all_normals))


def _cap(rings: int, sectors: int) -> tuple[Array, Array, Array]:
    """Unit directions (N, 3) about +Z, texture coordinates (N, 2), and the cornea's bulge (N,)."""
    polar, azimuth = (
        g.ravel()
        for g in np.meshgrid(
            np.linspace(0, 0.75 * np.pi, rings + 1), np.linspace(0, 2 * np.pi, sectors + 1), indexing="ij"
        )
    )
    directions = np.c_[np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)]
    reach = np.minimum(polar / (np.pi / 2) * 0.5 * 1.15, 0.5)
    uv = np.c_[0.5 + reach * np.cos(azimuth), 0.5 - reach * np.sin(azimuth)]
    return directions, uv, 1 + 0.045 * np.exp(-((polar / 0.42) ** 4))
