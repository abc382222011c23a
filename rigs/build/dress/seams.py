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
            mesh, _ = mesh.scored(self.across(mesh.vertices) - line, self.shown(mesh.vertices) > 0, 0.3 * self.width_m)
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
    hips, neck = float(tailor.at("hips")[1]), tailor.neck_y
    seams: list[Seam] = []
    for side, _ in SIDES:
        joint = tailor.at(f"{side}UpperArm")
        sign = float(np.sign(joint[0]))

        def out(v: Array, joint: Array = joint, sign: float = sign) -> Array:
            offset: Array = v - joint
            return sign * offset[:, 0] - ARMHOLE_LEAN * offset[:, 1] - ARMHOLE_OUT_M

        def near(v: Array, joint: Array = joint) -> Array:
            distance: Array = np.linalg.norm(v - joint, axis=1)
            return until(ARMHOLE_REACH_M - distance) * until(v[:, 1] - joint[1] + ARMHOLE_DOWN_M)

        seams.append(Seam(out, near, *ARMHOLE_M))

    def in_the_back(v: Array, low: float, high: float) -> Array:
        return until(v[:, 1] - low) * until(high - v[:, 1]) * (v[:, 2] < 0)

    def in_front(v: Array, low: float, high: float) -> Array:
        return until(v[:, 1] - low) * until(high - v[:, 1]) * (v[:, 2] > 0.04)

    vent = hips + VENT_TOP_M
    seams += [
        Seam(lambda v: v[:, 0], lambda v: in_the_back(v, vent, neck - 0.05), *SEAM_M),
        Seam(lambda v: v[:, 0] - 0.001, lambda v: in_the_back(v, -1.0, vent), *VENT_M),
        *(
            Seam(
                lambda v, sign=sign: sign * v[:, 0] - _along(SIDE_BACK_M, v[:, 1] - hips),
                lambda v, sign=sign: in_the_back(v, -1.0, hips + SIDE_BACK_M[-1][0]) * (sign * v[:, 0] > 0),
                *SEAM_M,
            )
            for sign in (1, -1)
        ),
        *(
            Seam(
                lambda v, sign=sign: sign * v[:, 0] - _along(DART_M, v[:, 1] - hips),
                lambda v, sign=sign: in_front(v, hips + DART_M[0][0], hips + DART_M[-1][0]) * (sign * v[:, 0] > 0),
                *SEAM_M,
            )
            for sign in (1, -1)
        ),
    ]
    return seams


def until(distance: Array) -> Array:
    """1 within, fading to 0 over a seam's end."""
    shown: Array = np.clip(distance / SEAM_ENDS_M, 0, 1)
    return shown


def _along(places: tuple[tuple[float, float], ...], height: Array) -> Array:
    values: Array = np.asarray(np.interp(height, *np.array(places).T), dtype=np.float64)
    return values
