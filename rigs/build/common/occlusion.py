"""How open each vertex of a model lies, so that folds and what is under another part are drawn darker.

All parts are marked in a grid of cells in the rest pose; from each vertex rays go out over its normal, and
count for as far as they come (ambient obscurance: Zhukov, Iones, Kronin, Rendering Techniques 1998).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from common.meshes import even_normals, smoothed, smoothstep

if TYPE_CHECKING:
    from collections.abc import Sequence

    from common.parts import Part

Array = NDArray[np.float64]

RAYS = 40
WAY_OUT = 0.1  # a place is as open as its walls are far if this share of its rays gets out
FACING_M = 0.011
FACING_AMONG = 32  # of the nearest vertices
NEARLY_CLOSED = 0.22
CLOSED = 0.3  # of its shade's light a place has into which no ray comes
SMOOTHING = 2  # rounds over a part's faces: rays are few


@dataclass(frozen=True)
class Grain:
    """How fine a model is looked at, metres: a cell's width, a ray's first look, and what shades no more."""

    cell_m: float
    start_m: float
    reach_m: float


FIGURE = Grain(0.004, 0.007, 0.15)
INSTRUMENT = Grain(0.0012, 0.0026, 0.045)


class Cells:
    """The cells that surfaces, (vertices, faces) each, go through."""

    def __init__(self, grain: Grain, surfaces: Sequence[tuple[Array, NDArray[np.int64]]]) -> None:
        self.grain = grain
        points = np.vstack([covering_points(*surface, 0.7 * grain.cell_m) for surface in surfaces])
        self.low: Array = points.min(axis=0) - 2 * grain.cell_m
        size = np.ceil((points.max(axis=0) - self.low) / grain.cell_m).astype(np.int64) + 3
        self.filled = np.zeros(size, dtype=bool)
        self.filled[tuple(self._index(points).T)] = True

    def _index(self, points: Array) -> NDArray[np.int64]:
        index: NDArray[np.int64] = ((points - self.low) / self.grain.cell_m).astype(np.int64)
        return index

    def at(self, points: Array) -> NDArray[np.bool_]:
        """Which of the points (N, 3) lie in a filled cell; outside of the grid nothing is."""
        high = self.low + self.grain.cell_m * np.array(self.filled.shape)
        inside = np.all((points >= self.low) & (points < high), axis=1)
        hit = np.zeros(len(points), dtype=bool)
        hit[inside] = self.filled[tuple(self._index(points[inside]).T)]
        return hit


def covering_points(vertices: Array, faces: NDArray[np.int64], spacing_m: float) -> Array:
    """Points (N, 3) on triangles, at most so far apart."""
    corners = vertices[faces]
    edges = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    splits = np.clip(np.ceil(edges / spacing_m).astype(np.int64), 1, 200)
    found: list[Array] = [vertices[np.unique(faces)]]
    for count in range(1, int(splits.max(initial=1)) + 1):
        chosen = corners[splits == count]
        if not len(chosen):
            continue
        i, j = np.indices((count + 1, count + 1)).reshape(2, -1)
        shares: Array = np.stack([i, j, count - i - j], axis=1)[i + j <= count] / count
        found.append(np.einsum("sk,nkj->nsj", shares, chosen).reshape(-1, 3))
    return np.vstack(found)


def hemisphere(count: int) -> Array:
    """Directions (count, 3) over the third axis, as dense as a matt surface weighs them, on a spiral."""
    k = np.arange(count) + 0.5
    radius = np.sqrt(k / count)
    turn = np.pi * (3 - np.sqrt(5)) * k
    return np.c_[radius * np.cos(turn), radius * np.sin(turn), np.sqrt(1 - radius**2)]


def openness(cells: Cells, points: Array, out: Array) -> Array:
    """How open (N,) each point with its unit normal (N, 3) lies: 1 in the open, 0 wholly covered."""
    points = points + out * cells.grain.cell_m  # what is sewn on a cloth is not shaded by it
    side = np.where(np.abs(out[:, :1]) < 0.9, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    first = np.cross(side, out)
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    second = np.cross(out, first)
    start, reach = cells.grain.start_m, cells.grain.reach_m
    looks: Array = np.arange(start, reach, cells.grain.cell_m)  # no wall is thinner than a cell
    total, gone = np.zeros(len(points)), np.zeros(len(points))
    for a, b, c in hemisphere(RAYS):
        ray = a * first + b * second + c * out
        free = np.ones(len(points), dtype=bool)
        far = np.ones(len(points))
        for distance in looks:
            hit = np.zeros(len(points), dtype=bool)
            hit[free] = cells.at(points[free] + ray[free] * distance)
            far[hit] = (distance - start) / (reach - start)
            free &= ~hit
        total += np.sqrt(far)
        gone += free
    # However far its walls are, a place is dark from which nothing gets out.
    return total / RAYS * np.minimum(gone / (RAYS * WAY_OUT), 1)


def apart(vertices: Array, out: Array) -> Array:
    """How far (V,) what faces a vertex stands off, as a share of `FACING_M`: 0 where lips or lids are closed.

    Rays begin too far out to see it.
    """
    distance, index = cKDTree(vertices).query(vertices, k=min(FACING_AMONG, len(vertices)))
    way = vertices[index] - vertices[:, None]
    ahead = (way * out[:, None]).sum(axis=2) > 0.5 * distance
    opposite = (out[index] * out[:, None]).sum(axis=2) < -0.3
    off = np.where(ahead & opposite & (distance > 0), distance / FACING_M, 1.0)
    nearest: Array = np.minimum(off.min(axis=1), 1.0)
    return nearest


def shaded(parts: list[Part]) -> None:
    """Give each part its vertices' colours: white in the open, the surface's `shade` where all is covered."""
    cells = Cells(FIGURE, [(part.mesh.vertices, part.mesh.faces) for part in parts])
    for part in parts:
        if part.surface.shade is None:
            continue
        mesh = part.mesh
        out = even_normals(mesh.vertices, mesh.faces) if part.normals is None else part.normals
        light = openness(cells, mesh.vertices, out) * apart(mesh.vertices, out)
        light = smoothed(light[:, None], mesh.faces, SMOOTHING)
        part.colours = tinted(light, part.surface.shade)


def tinted(light: Array, shade: tuple[float, float, float]) -> Array:
    """Colours (V, 3) from the shade's to white by openness (V, 1); what is nearly closed goes on to black."""
    dark = np.array(shade)
    return (dark + (1 - dark) * light) * (CLOSED + (1 - CLOSED) * smoothstep(light / NEARLY_CLOSED))
