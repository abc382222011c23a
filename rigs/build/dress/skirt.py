"""A knife-pleated skirt that goes on under the blazer, and the stripes along its hem."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from common.meshes import Mesh, joined, smoothstep
from common.shapes import grid_faces
from dress.tailor import borrowed_weights

if TYPE_CHECKING:
    from dress.tailor import Tailor

Array = NDArray[np.float64]

PLEATS = 24
PLEAT = (0.0, 0.41, 0.80, 0.84, 0.96)  # columns within a pleat; between the third and fourth it turns under
PLAIN_PLEAT = (0.0, 0.80, 0.86)
UNDER_BLAZER_M = (0.0075, 0.0100)  # how far under the blazer the skirt lies at least, and at most
HEM_BANDS = ((0.865, 0.905), (0.925, 0.940))  # stripes near the hem, as shares of the skirt's length


class Around:
    """Vertices about an upright axis at depth `z`: radii by angle (0 is the front) and height."""

    def __init__(self, vertices: Array, z: float) -> None:
        across: Array = vertices[:, [0, 2]] - [0.0, z]
        self.radii: Array = np.linalg.norm(across, axis=1)
        angles: Array = np.arctan2(across[:, 0], across[:, 1])
        self.tree = cKDTree(self._place(angles, vertices[:, 1]))

    @staticmethod
    def _place(angles: Array, heights: Array) -> Array:
        return np.c_[np.cos(angles) * 0.15, np.sin(angles) * 0.15, heights]

    def shares(
        self, angles: Array, heights: Array, count: int, soft_m: float
    ) -> tuple[NDArray[np.int64], Array]:
        """The nearest vertices (N, count) and how much each counts (N, count)."""
        distance, index = self.tree.query(self._place(angles, heights), k=count)
        near: Array = 1 / (np.asarray(distance) ** 2 + soft_m**2)
        return np.asarray(index), near / near.sum(axis=1, keepdims=True)


def skirt(tailor: Tailor, outer: Mesh, rows: int, pleat: tuple[float, ...]) -> tuple[Mesh, Mesh]:
    """A knife-pleated skirt from waist to above the knee over the helper skirt, and its two stripes.

    What the blazer `outer` covers lies flat just under it. Columns stand on the pleats' edges, so that these
    stay sharp; `pleat` says where within each.
    """
    helper = Mesh(
        tailor.figure.vertices, tailor.weights, tailor.figure.mesh.triangles(["helper-skirt"])
    ).compact()
    waist, knee = float(tailor.at("hips")[1]) + 0.05, float(tailor.at("leftLowerLeg")[1]) + 0.06
    depth = float(helper.vertices[:, 2].mean())
    hull = Around(helper.vertices, depth)
    reach: Array = np.hypot(outer.vertices[:, 0], outer.vertices[:, 2] - depth)
    coat = Around(outer.vertices[(outer.vertices[:, 1] < waist + 0.03) & (reach < 0.25)], depth)
    within: Array = (np.arange(PLEATS)[:, None] + np.array(pleat)).ravel() / PLEATS
    turns: Array = np.r_[within, 1.0]

    def hung(shares: Array, lift: float) -> Mesh:
        t: Array = np.repeat(shares, len(turns))
        a: Array = np.tile(2 * np.pi * turns, len(shares))
        y = waist + (knee - waist) * t
        index, near = hull.shares(a, y, 24, 0.02)
        phase = (a / (2 * np.pi) * PLEATS) % 1
        fold: Array = np.where(phase < 0.82, phase / 0.82, (1 - phase) / 0.18)
        r: Array = (hull.radii[index] * near).sum(axis=1) * (0.97 + 0.03 * t) + 0.009 + 0.033 * t + lift
        r += (0.003 + 0.016 * t) * (fold - 0.5)
        over, nearby = coat.shares(a, y, 8, 0.004)
        over_it: Array = (coat.radii[over] * nearby).sum(axis=1)
        coat_hem = float(tailor.at("hips")[1]) - 0.035 + 0.012 * np.cos(a)
        covered = smoothstep((y - coat_hem + 0.016) / 0.02)
        under: Array = np.minimum(np.maximum(r, over_it - UNDER_BLAZER_M[1]), over_it - UNDER_BLAZER_M[0])
        r += (under - r) * covered
        vertices: Array = np.c_[np.sin(a) * r, y, depth + np.cos(a) * r]
        weights: Array = (helper.weights[index] * near[..., None]).sum(axis=1)
        # Under the blazer it is moved as the blazer is.
        weights += (borrowed_weights(vertices, outer) - weights) * covered[:, None]
        return Mesh(vertices, weights, grid_faces(len(shares), len(turns), flip=True))

    stripes = [hung(np.linspace(*ends, 3), 0.0013) for ends in HEM_BANDS]
    return hung(np.linspace(0, 1, rows), 0.0), joined(stripes)
