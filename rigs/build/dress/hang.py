"""How a coat hangs: across what lies between the parts of the body that carry it, it goes straight."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter
from scipy.spatial import ConvexHull

from body.joint_names import SIDES
from common.meshes import Mesh, smoothstep
from dress.sleeves import ARM_PARTS

if TYPE_CHECKING:
    from dress.tailor import Tailor

Array = NDArray[np.float64]

SLICE_M = 0.008
ANGLES = 96
SOFT = (2.0, 2.0)  # slices and angles over which radii are eased
FADE_M = ((-0.05, 0.05), (0.08, 0.18))  # over the upper chest's joint, in front and behind: where it ends


def hung(tailor: Tailor, mesh: Mesh) -> Mesh:
    """The coat with its trunk spanned over the hollows of back, seat and front, slice by slice."""
    v = mesh.vertices
    arms = tailor.weight_of(mesh.weights, *(f"{side}{part}" for side, _ in SIDES for part in ARM_PARTS))
    trunk = arms < 0.25
    centre_z = float(tailor.at("chest")[2])
    top = float(tailor.at("upperChest")[1]) + FADE_M[1][1]
    heights: Array = np.arange(float(v[:, 1].min()), top + SLICE_M, SLICE_M)
    angles: Array = np.linspace(-np.pi, np.pi, ANGLES, endpoint=False)
    radii = np.array([_span(v[trunk], y, centre_z, angles) for y in heights])
    radii = gaussian_filter(radii, SOFT, mode=("nearest", "wrap"))
    turn = np.arctan2(v[:, 0], v[:, 2] - centre_z)
    own = np.hypot(v[:, 0], v[:, 2] - centre_z)
    wide = _between(radii, (v[:, 1] - heights[0]) / SLICE_M, (turn + np.pi) / (2 * np.pi) * ANGLES)
    back = 0.5 - 0.5 * np.cos(turn)
    chest = float(tailor.at("upperChest")[1])
    begins = chest + FADE_M[0][0] + (FADE_M[1][0] - FADE_M[0][0]) * back
    ends = chest + FADE_M[0][1] + (FADE_M[1][1] - FADE_M[0][1]) * back
    share = smoothstep((ends - v[:, 1]) / (ends - begins)) * smoothstep((0.5 - arms) / 0.5)
    grow = 1 + share * np.maximum(wide / np.maximum(own, 1e-6) - 1, 0)
    mesh.vertices = np.c_[v[:, 0] * grow, v[:, 1], centre_z + (v[:, 2] - centre_z) * grow]
    return mesh


def _span(points: Array, y: float, centre_z: float, angles: Array) -> Array:
    """Radii (A,) toward each angle of the band drawn tight round the points near a height."""
    near = points[np.abs(points[:, 1] - y) < 1.5 * SLICE_M]
    flat = np.c_[near[:, 0], near[:, 2] - centre_z]
    hull = ConvexHull(flat)
    # Each side of the hull is a line n·p = d; a ray goes out as far as the first of them lets it.
    normal, distance = hull.equations[:, :2], -hull.equations[:, 2]
    toward = normal @ np.stack([np.sin(angles), np.cos(angles)])
    reach = np.where(toward > 1e-9, distance[:, None] / np.maximum(toward, 1e-9), np.inf)
    radii: Array = reach.min(axis=0)
    return radii


def _between(table: Array, row: Array, column: Array) -> Array:
    """The table's values (N,) between rows and, round and round, between columns."""
    row = np.clip(row, 0, len(table) - 1.001)
    i, j = row.astype(int), column.astype(int)
    s, t = row - i, column - j
    count = table.shape[1]
    j, after = j % count, (j + 1) % count
    low: Array = table[i, j] * (1 - t) + table[i, after] * t
    high: Array = table[i + 1, j] * (1 - t) + table[i + 1, after] * t
    return low * (1 - s) + high * s
