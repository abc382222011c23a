"""Where a coat is sewn together: seams drawn into its cloth, and edges turned in to show its thickness."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from body.joint_names import SIDES
from common.meshes import Mesh, even_normals

if TYPE_CHECKING:
    from collections.abc import Callable

    from dress.tailor import Tailor

Array = NDArray[np.float64]

SEAM_M = (0.0034, 0.0019)  # half a seam's width, and its depth
VENT_M = (0.0034, 0.0045)
FRONT_M = (0.0030, 0.0030)
VENT_TOP_M = 0.075  # over the hips' joint
ARMHOLE_M = (0.0042, 0.0036)  # half width and depth: a sleeve is set in full
ARMHOLE_REACH_M = 0.125  # from the shoulder's joint
ARMHOLE_DOWN_M = 0.065  # under the arm it is hidden, and would crumple
ARMHOLE_OUT_M = 0.006  # its plane lies so far outward of the joint
ARMHOLE_LEAN = 0.19  # outward for each metre up
SIDE_BACK_M = ((-0.06, 0.100), (0.11, 0.068), (0.30, 0.098))  # over the hips' joint: from the middle
DART_M = ((0.075, 0.088), (0.285, 0.070))
SEAM_ENDS_M = 0.02  # over which a seam runs out
BESIDE_EDGE_M = 0.0045
EDGE_M = 0.0024  # the cloth's thickness where an edge shows it


@dataclass(frozen=True)
class Seam:
    """A line on a cloth: where `across` (V,), metres, is zero; `shown` (V,) fades it out, 0 … 1."""

    across: Callable[[Array], Array]
    shown: Callable[[Array], Array]
    width_m: float
    depth_m: float

    def into(self, mesh: Mesh) -> Mesh:
        """The cloth drawn in along the seam, by three lines of vertices that hold its shape."""
        for line in (-self.width_m, 0.0, self.width_m):
            mesh, _ = mesh.scored(
                self.across(mesh.vertices) - line, self.shown(mesh.vertices) > 0, 0.3 * self.width_m
            )
        v = mesh.vertices
        sunk = self.depth_m * np.clip(1 - np.abs(self.across(v)) / self.width_m, 0, 1) * self.shown(v)
        mesh.vertices = v - even_normals(v, mesh.faces) * sunk[:, None]
        return mesh


def sewn(tailor: Tailor, mesh: Mesh, front: Seam) -> Mesh:
    """The coat with its seams: round the armholes, down the back and its sides, and darts before the waist.

    And along its `front` edge.
    """
    for seam in [*_seams(tailor), front]:
        mesh = seam.into(mesh)
    return mesh


def _seams(tailor: Tailor) -> list[Seam]:
    seams = [_armhole(tailor.at(f"{side}UpperArm")) for side, _ in SIDES]
    hips, neck = float(tailor.at("hips")[1]), tailor.neck_y
    vent = hips + VENT_TOP_M
    seams += [
        Seam(lambda v: v[:, 0], lambda v: _between(v, vent, neck - 0.05) * (v[:, 2] < 0), *SEAM_M),
        Seam(lambda v: v[:, 0] - 0.001, lambda v: until(vent - v[:, 1]) * (v[:, 2] < 0), *VENT_M),
    ]
    for sign in (1.0, -1.0):
        seams += [_beside(sign, hips, SIDE_BACK_M, front=False), _beside(sign, hips, DART_M, front=True)]
    return seams


def _armhole(joint: Array) -> Seam:
    """Where a sleeve is set in, round the shoulder's joint."""
    sign = float(np.sign(joint[0]))

    def across(v: Array) -> Array:
        outward: Array = sign * (v[:, 0] - joint[0]) - ARMHOLE_LEAN * (v[:, 1] - joint[1])
        return outward - ARMHOLE_OUT_M

    def shown(v: Array) -> Array:
        distance: Array = np.linalg.norm(v - joint, axis=1)
        return until(ARMHOLE_REACH_M - distance) * until(v[:, 1] - joint[1] + ARMHOLE_DOWN_M)

    return Seam(across, shown, *ARMHOLE_M)


def _beside(sign: float, hips: float, places: tuple[tuple[float, float], ...], *, front: bool) -> Seam:
    """A seam on one side of the middle through places: heights over the hips, distances from the middle."""
    heights, distances = np.array(places).T
    low, high = hips + (float(heights[0]) if front else -1.0), hips + float(heights[-1])

    def across(v: Array) -> Array:
        line: Array = np.asarray(np.interp(v[:, 1] - hips, heights, distances), dtype=np.float64)
        return sign * v[:, 0] - line

    def shown(v: Array) -> Array:
        there = (v[:, 2] > 0.04) if front else (v[:, 2] < 0)
        return _between(v, low, high) * (there & (sign * v[:, 0] > 0))

    return Seam(across, shown, *SEAM_M)


def until(distance: Array) -> Array:
    """1 within, fading to 0 over a seam's end."""
    shown: Array = np.clip(distance / SEAM_ENDS_M, 0, 1)
    return shown


def _between(v: Array, low: float, high: float) -> Array:
    return until(v[:, 1] - low) * until(high - v[:, 1])
