"""Metal shapes: swept tubes, turned (lathed) parts, rings; normals are exact and winding follows them."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from common.occlusion import Cells, openness, tinted
from common.shapes import grid_faces

if TYPE_CHECKING:
    from common.glb import GlbWriter

Array = NDArray[np.float64]
Point = Sequence[float] | Array
Turned = tuple[Array, Array, NDArray[np.int64]]
Shade = tuple[float, float, float]


class Workpiece:
    """One moving piece of the instrument: geometry by material, `detail` scales the number of facets."""

    def __init__(self, detail: float) -> None:
        self.detail = detail
        self._pieces: dict[int, list[tuple[Array, Array, NDArray[np.int64]]]] = {}

    def facets(self, wanted: int, least: int = 6) -> int:
        """How many facets a round shape gets in this tier."""
        return max(least, round(wanted * self.detail))

    def add(self, material: int, vertices: Array, normals: Array, faces: NDArray[np.int64]) -> None:
        """Add faces, turning those that look against their normals and dropping those without area."""
        a, b, c = (vertices[faces[:, k]] for k in range(3))
        area = np.cross(b - a, c - a)
        against = (area * normals[faces].sum(axis=1)).sum(axis=1) < 0
        faces = faces.copy()
        faces[against] = faces[against][:, [0, 2, 1]]
        faces = faces[np.linalg.norm(area, axis=1) > 1e-11]
        self._pieces.setdefault(material, []).append((vertices, normals, faces))

    def surfaces(self) -> dict[int, Turned]:
        """Vertices (V, 3), normals (V, 3) and faces (F, 3) by material."""
        result: dict[int, Turned] = {}
        for material, pieces in self._pieces.items():
            starts = np.cumsum([0] + [len(v) for v, _, _ in pieces[:-1]])
            faces = np.vstack([f + start for (_, _, f), start in zip(pieces, starts, strict=True)])
            vertices, normals = np.vstack([v for v, _, _ in pieces]), np.vstack([n for _, n, _ in pieces])
            used = np.unique(faces)
            index = np.full(len(vertices), -1)
            index[used] = np.arange(len(used))
            result[material] = vertices[used], normals[used], index[faces]
        return result

    def primitives(
        self, writer: GlbWriter, shades: Mapping[int, Shade], cells: Cells | None, place: Point = (0, 0, 0)
    ) -> list[dict[str, object]]:
        """The piece as glTF primitives, one a material, darker where `cells` shade it standing at `place`."""
        result: list[dict[str, object]] = []
        for material, (vertices, normals, faces) in self.surfaces().items():
            colours = None
            if cells is not None:
                light = openness(cells, vertices + np.asarray(place, dtype=np.float64), normals)
                colours = tinted(light[:, None], shades[material])
            result.append(writer.primitive(vertices, normals, faces, material, colours=colours))
        return result

    def sweep(
        self, material: int, path: Array, radius: Array | float, sides: int = 18, *, caps: bool = False,
        oval: tuple[float, float] = (1.0, 1.0),
    ) -> None:  # fmt: skip
        """A tube along `path` (N, 3) with one radius or one a point; `oval` squeezes its two cross axes."""
        count, sides = len(path), self.facets(sides, 5)
        radii = np.broadcast_to(np.asarray(radius, dtype=np.float64), count)
        tangent = np.gradient(path, axis=0)
        tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
        frames = _carried_frames(tangent)
        length = np.r_[0, np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))]
        slope = np.gradient(radii, length)
        angle = np.linspace(0, 2 * np.pi, sides + 1)
        ring = (
            np.cos(angle)[:, None] * frames[:, None, 0] * oval[0]
            + np.sin(angle)[:, None] * frames[:, None, 1] * oval[1]
        )
        vertices = path[:, None] + radii[:, None, None] * ring
        normals = ring - (slope[:, None] * tangent)[:, None]
        normals /= np.linalg.norm(normals, axis=2, keepdims=True)
        self.add(
            material, vertices.reshape(-1, 3), normals.reshape(-1, 3), grid_faces(count, sides + 1, flip=True)
        )
        if caps:
            for end, sign in ((0, -1), (count - 1, 1)):
                disc = np.vstack([path[end], vertices[end]])
                fan = np.array([[0, k + 1, k + 2] for k in range(sides)])
                self.add(material, disc, np.tile(tangent[end] * sign, (len(disc), 1)), fan)

    def lathe(
        self,
        material: int,
        origin: Point,
        axis: Point,
        profile: Sequence[Point],
        sides: int = 40,
        *,
        smooth: bool = False,
    ) -> None:
        """Turn a profile of (axial, radius) points about an axis; flat between its points unless `smooth`."""
        start, along, u, w = _axes(origin, axis)
        angle = np.linspace(0, 2 * np.pi, self.facets(sides, 8) + 1)
        spokes = np.cos(angle)[:, None] * u + np.sin(angle)[:, None] * w
        points = np.array(profile, dtype=np.float64)
        columns = len(angle)
        if smooth:
            step = np.gradient(points, axis=0)
            vertices = start + along * points[:, 0, None, None] + spokes * points[:, 1, None, None]
            normals = spokes * step[:, 0, None, None] - along * step[:, 1, None, None]
            normals /= np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), 1e-9)
            self.add(
                material, vertices.reshape(-1, 3), normals.reshape(-1, 3), grid_faces(len(points), columns)
            )
            return
        for (z0, r0), (z1, r1) in itertools.pairwise(points):
            normals = spokes * (z1 - z0) - along * (r1 - r0)
            lengths = np.linalg.norm(normals, axis=1, keepdims=True)
            if lengths.max() < 1e-9:
                continue
            normals = normals / lengths
            rings = np.vstack([start + along * z0 + spokes * r0, start + along * z1 + spokes * r1])
            self.add(material, rings, np.vstack([normals, normals]), grid_faces(2, columns))

    def ring(
        self,
        material: int,
        centre: Point,
        axis: Point,
        radius: float,
        thickness: float,
        sides: int = 32,
        round_sides: int = 8,
    ) -> None:
        """A torus."""
        middle, along, u, w = _axes(centre, axis)
        a = np.linspace(0, 2 * np.pi, self.facets(sides, 10) + 1)
        b = np.linspace(0, 2 * np.pi, self.facets(round_sides, 5) + 1)
        spoke = np.cos(a)[:, None] * u + np.sin(a)[:, None] * w
        normals = np.cos(b)[None, :, None] * spoke[:, None] + np.sin(b)[None, :, None] * along
        vertices = middle + radius * spoke[:, None] + thickness * normals
        self.add(
            material, vertices.reshape(-1, 3), normals.reshape(-1, 3), grid_faces(len(a), len(b), flip=True)
        )

    def ferrule(self, material: int, start: Point, end: Point, radius: float) -> None:
        """A sleeve over a tube with a bead at each end."""
        a, b = np.asarray(start, dtype=np.float64), np.asarray(end, dtype=np.float64)
        length = float(np.linalg.norm(b - a))
        self.lathe(
            material,
            a,
            b - a,
            [(0, radius - 0.0006), (0, radius), (length, radius), (length, radius - 0.0006)],
            28,
        )
        if self.detail > 0.5:
            for z in (0.0008, length - 0.0008):
                self.ring(material, a + (b - a) / length * z, b - a, radius, 0.0006)

    def brace(self, material: int, start: Point, end: Point, radius: float = 0.0022) -> None:
        """A turned stay with a bead in the middle and feet at its ends."""
        a, b = np.asarray(start, dtype=np.float64), np.asarray(end, dtype=np.float64)
        t = np.linspace(0, 1, self.facets(17, 7))
        bead = (
            0.55 * np.exp(-(((t - 0.5) / 0.1) ** 2))
            + 0.9 * np.exp(-((t / 0.08) ** 2))
            + 0.9 * np.exp(-(((t - 1) / 0.08) ** 2))
        )
        self.sweep(material, a + (b - a) * t[:, None], radius * (1 + bead), 12)


def _carried_frames(tangent: Array) -> Array:
    """Two cross axes (N, 2, 3) a point, carried along the path without twist."""
    u = np.cross(tangent[0], [0.3, 1.0, 0.2])
    frames = np.zeros((len(tangent), 2, 3))
    for k, t in enumerate(tangent):
        u = u - t * (u @ t)
        u /= np.linalg.norm(u)
        frames[k] = u, np.cross(t, u)
    return frames


def _axes(origin: Point, axis: Point) -> tuple[Array, Array, Array, Array]:
    along = np.asarray(axis, dtype=np.float64) / np.linalg.norm(axis)
    u = np.cross(along, [0.3, 0.5, 1.0] if abs(along[2]) < 0.9 else [1.0, 0.2, 0.0])
    u /= np.linalg.norm(u)
    return np.asarray(origin, dtype=np.float64), along, u, np.cross(along, u)
