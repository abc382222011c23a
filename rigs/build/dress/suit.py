"""The formal suit: jacket, trousers with a straight leg, shirt and shoes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from body.joint_names import SIDES
from common.meshes import Mesh, normals, on_border, smoothed, smoothstep
from common.parts import Part, Surface
from dress.seams import Seam, until
from dress.uniform import shirt_part, shoes_part

if TYPE_CHECKING:
    from collections.abc import Mapping

    from body.figure_file import Colour
    from dress.tailor import Tailor

    Colours = Mapping[str, Colour]

Array = NDArray[np.float64]

TROUSER_EASE_M = 0.0075
UNDER_JACKET_M = 0.013  # how far the trousers are drawn in where the jacket covers them
LONGER_M = 0.085  # by so much the jacket is longer than the uniform's
SHIRT_UNDERLAP_M = 0.014  # the lapels lie closer than the uniform's
VAMP_M = 0.020  # how far before the ankle the shoe's vamp begins, under the trousers
HEM_M = (
    (-0.045, 0.028),
    (0.0, 0.042),
    (0.03, 0.054),
    (0.066, 0.090),
    (0.2, 0.16),
)  # before the ankle; height
CREASE_M = (0.007, -0.0045)
CREASE_FROM_M = 0.16  # below the hips' joint
LEG_RADIUS_M = ((0.0, 0.0), (0.55, 0.066), (1.0, 0.070), (1.5, 0.069), (2.0, 0.070))  # 0 hip, 1 knee, 2 ankle


def trousers(tailor: Tailor, subdivisions: int) -> Mesh:
    """Cloth over hips and legs that falls straight from the thigh, to the shoes."""
    tights = tailor.tights
    hips = float(tailor.at("hips")[1])
    below = (tights.vertices[:, 1] < hips + 0.06) & (tights.vertices[:, 1] > 0.02)
    mesh = tailor.cloth(below, TROUSER_EASE_M, 12, subdivisions)
    border = on_border(len(mesh.vertices), mesh.faces)
    mesh.vertices = smoothed(_straight(tailor, mesh), mesh.faces, 6, border)
    covered = smoothstep((mesh.vertices[:, 1] - hips + 0.16) / 0.05)
    out = normals(mesh.vertices, mesh.faces) * [1.0, 0.0, 1.0]
    mesh.vertices = mesh.vertices - out * (UNDER_JACKET_M * covered)[:, None]
    if subdivisions:
        for side, _ in SIDES:
            mesh = _crease(tailor, side, hips).into(mesh)
    before: Array = mesh.vertices[:, 2] - tailor.at("leftFoot")[2]
    places, heights = np.array(HEM_M).T
    hem: Array = np.asarray(np.interp(before, places, heights), dtype=np.float64)
    return mesh.clipped(np.minimum(mesh.vertices[:, 1] - hem, hips + 0.035 - mesh.vertices[:, 1]))


def _crease(tailor: Tailor, side: str, hips: float) -> Seam:
    """The pressed fold down the front of a leg: a seam that stands out."""
    joints = np.array([tailor.at(f"{side}{part}") for part in ("Foot", "LowerLeg", "UpperLeg")])

    def across(v: Array) -> Array:
        return v[:, 0] - np.asarray(np.interp(v[:, 1], joints[:, 1], joints[:, 0]), dtype=np.float64)

    def shown(v: Array) -> Array:
        depth: Array = np.asarray(np.interp(v[:, 1], joints[:, 1], joints[:, 2]), dtype=np.float64)
        return until(hips - CREASE_FROM_M - v[:, 1]) * ((v[:, 2] > depth) & (v[:, 0] * joints[0, 0] > 0))

    return Seam(across, shown, *CREASE_M)


def _straight(tailor: Tailor, mesh: Mesh) -> Array:
    """Vertices (V, 3) with each leg at least as wide as a straight-cut trouser leg."""
    vertices: Array = mesh.vertices.copy()
    for side, _ in SIDES:
        hip, knee, ankle = (tailor.at(f"{side}{part}") for part in ("UpperLeg", "LowerLeg", "Foot"))
        of_side = vertices[:, 0] * hip[0] > 0
        upper, lower = knee - hip, ankle - knee
        first = np.clip((vertices - hip) @ upper / (upper @ upper), 0, 1)
        second = np.clip((vertices - knee) @ lower / (lower @ lower), 0, 1)
        along = first + np.where(first >= 1, second, 0)
        foot = np.where((along < 1)[:, None], hip + first[:, None] * upper, knee + second[:, None] * lower)
        spoke = vertices - foot
        spoke[:, 1] = 0
        reach: Array = np.linalg.norm(spoke, axis=1)
        wanted = np.interp(along, [a for a, _ in LEG_RADIUS_M], [r for _, r in LEG_RADIUS_M])
        grow = np.maximum(wanted / np.maximum(reach, 1e-6), 1.0) - 1.0
        vertices += spoke * (grow * of_side)[:, None]
    return vertices


def suit_parts(tailor: Tailor, subdivisions: int, outer: Mesh, colours: Colours) -> list[Part]:
    """All cloth but the trimmings; `outer` is the jacket, cut beforehand because trimmings lie on it."""
    return [
        shirt_part(tailor, subdivisions, colours, SHIRT_UNDERLAP_M),
        Part("Jacket", outer, Surface("jacket", 0.72, colour=colours["coat"], both_sides=True)),
        Part(
            "Trousers",
            trousers(tailor, subdivisions),
            Surface("trousers", 0.78, colour=colours["legs"], both_sides=True),
        ),
        shoes_part(tailor, subdivisions, colours, vamp_m=VAMP_M, strap=False),
    ]
