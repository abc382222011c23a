"""Turned shapes: swept tubes, lathed parts, rings, blocks; normals are exact and winding follows them."""

from __future__ import annotations

import itertools
from collections.abc import Collection, Mapping, Sequence
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
    """One moving piece of an instrument: geometry by material, `detail` scales the number of facets."""

    def __init__(self, detail: float) -> None:
        self.detail = detail
        self._pieces: dict[int, list[tuple[Array, Array, NDArray[np.int64], Array]]] = {}

    def facets(self, wanted: int, least: int = 6) -> int:
        """How many facets a round shape gets in this tier."""
        return max(least, round(wanted * self.detail))

    def add(
        self,
        material: int,
        vertices: Array,
        normals: Array,
        faces: NDArray[np.int64],
        uv: Array | None = None,
    ) -> None:
        """Add faces, turning those that look against their normals and dropping those without area.

        `uv` (V, 2) are places in the material's image, for materials that have one.
        """
        a, b, c = (vertices[faces[:, k]] for k in range(3))
        area = np.cross(b - a, c - a)
        against = (area * normals[faces].sum(axis=1)).sum(axis=1) < 0
        faces = faces.copy()
        faces[against] = faces[against][:, [0, 2, 1]]
        faces = faces[np.linalg.norm(area, axis=1) > 1e-11]
        places = np.zeros((len(vertices), 2)) if uv is None else uv
        self._pieces.setdefault(material, []).append((vertices, normals, faces, places))

    def sheet(self, material: int, vertices: Array, normals: Array, uv: Array | None = None) -> None:
        """Add a surface of vertices (R, C, 3) with their normals and their places in the image (R, C, 2)."""
        rows, columns = vertices.shape[:2]
        places = None if uv is None else uv.reshape(-1, 2)
        self.add(material, vertices.reshape(-1, 3), normals.reshape(-1, 3), grid_faces(rows, columns), places)

    def include(self, other: Workpiece, rotation: Array, at: Point) -> None:
        """Add all of another piece, turned by a matrix and moved."""
        for material, pieces in other._pieces.items():
            for vertices, normals, faces, uv in pieces:
                placed = vertices @ rotation.T + np.asarray(at, dtype=np.float64)
                self._pieces.setdefault(material, []).append((placed, normals @ rotation.T, faces, uv))

    def settle(self, step_m: float) -> None:
        """Put every vertex on a grid so fine that nobody sees it: its coordinates then take fewer bytes."""
        for material, pieces in self._pieces.items():
            self._pieces[material] = [(np.round(v / step_m) * step_m, n, f, uv) for v, n, f, uv in pieces]

    def surfaces(self) -> dict[int, Turned]:
        """Vertices (V, 3), normals (V, 3) and faces (F, 3) by material."""
        return {
            material: (vertices, normals, faces)
            for material, (vertices, normals, faces, _) in self._joined().items()
        }

    def _joined(self) -> dict[int, tuple[Array, Array, NDArray[np.int64], Array]]:
        result: dict[int, tuple[Array, Array, NDArray[np.int64], Array]] = {}
        for material, pieces in self._pieces.items():
            starts = np.cumsum([0] + [len(v) for v, _, _, _ in pieces[:-1]])
            faces = np.vstack([f + start for (_, _, f, _), start in zip(pieces, starts, strict=True)])
            vertices, normals = (
                np.vstack([piece[0] for piece in pieces]),
                np.vstack([piece[1] for piece in pieces]),
            )
            uv = np.vstack([piece[3] for piece in pieces])
            used = np.unique(faces)
            index = np.full(len(vertices), -1)
            index[used] = np.arange(len(used))
            result[material] = vertices[used], normals[used], index[faces], uv[used]
        return result

    def primitives(
        self,
        writer: GlbWriter,
        shades: Mapping[int, Shade],
        cells: Cells | None,
        place: Point = (0, 0, 0),
        *,
        rotation: Array | None = None,
        pictured: Collection[int] = (),
        grained: Collection[int] = (),
    ) -> list[dict[str, object]]:
        """The piece as glTF primitives, one a material, darker where `cells` shade it standing at `place`.

        Materials that are `pictured` have an image, and so their vertices their places in it; those that are
        `grained` reflect differently along u and across.
        """
        result: list[dict[str, object]] = []
        for material, (vertices, normals, faces, uv) in self._joined().items():
            colours = None
            if cells is not None:
                stood, out = (
                    (vertices, normals) if rotation is None else (vertices @ rotation.T, normals @ rotation.T)
                )
                light = openness(cells, stood + np.asarray(place, dtype=np.float64), out)
                colours = tinted(light[:, None], shades[material])
            places = uv if material in pictured else None
            along = _tangents(vertices, normals, faces, uv) if material in grained else None
            result.append(
                writer.primitive(
                    vertices, normals, faces, material, uv=places, colours=colours, tangents=along
                )
            )
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
        """Turn a profile of (axial, radius) points about an axis; flat between its points unless `smooth`.

        In an image, u is the share of a turn and v the share of the profile's length.
        """
        start, along, across, over = _axes(origin, axis)
        angle = np.linspace(0, 2 * np.pi, self.facets(sides, 8) + 1)
        spokes = np.cos(angle)[:, None] * across + np.sin(angle)[:, None] * over
        points = np.array(profile, dtype=np.float64)
        columns = len(angle)
        if smooth:
            step = np.gradient(points, axis=0)
            vertices = start + along * points[:, 0, None, None] + spokes * points[:, 1, None, None]
            normals = spokes * step[:, 0, None, None] - along * step[:, 1, None, None]
            normals /= np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), 1e-9)
            length: Array = np.r_[0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))]
            across: Array = np.tile(angle / (2 * np.pi), len(length))
            down: Array = np.repeat(length / max(length[-1], 1e-9), len(angle))
            faces = grid_faces(len(points), columns)
            self.add(material, vertices.reshape(-1, 3), normals.reshape(-1, 3), faces, np.c_[across, down])
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

    def block(
        self,
        material: int,
        centre: Point,
        size: Point,
        bevel: float,
        axes: Array | None = None,
        taper: tuple[float, float] = (1.0, 1.0),
    ) -> None:
        """A box with bevelled edges that shade as round ones; `axes` are its directions, a matrix's columns.

        `taper` is what is left of its x and z sizes at its upper end.
        """
        half = np.asarray(size, dtype=np.float64) / 2
        bevel = bevel if self.detail > 0.4 else 0.0
        inner = half - bevel
        corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float64)
        vertices, normals = np.empty((8, 3, 3)), np.empty((8, 3, 3))
        for k in range(3):
            out = np.zeros(3)
            out[k] = 1.0
            vertices[:, k] = corners * np.where(out > 0, half, inner)
            normals[:, k] = corners * out
        top = (vertices[..., 1] > 0)[..., None]
        vertices *= np.where(top, [taper[0], 1.0, taper[1]], 1.0)
        faces: list[list[int]] = []
        index = {tuple(corner): n for n, corner in enumerate(corners.astype(int).tolist())}

        def quad(a: int, b: int, c: int, d: int) -> None:
            faces.extend(([a, b, c], [a, c, d]))

        for k in range(3):
            i, j = (k + 1) % 3, (k + 2) % 3
            for sign in (-1, 1):
                ring: list[int] = []
                for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                    corner = [0, 0, 0]
                    corner[k], corner[i], corner[j] = sign, a, b
                    ring.append(3 * index[tuple(corner)] + k)
                quad(*ring)
            for a, b in itertools.product((-1, 1), repeat=2):
                ends: list[int] = []
                for sign in (-1, 1):
                    corner = [0, 0, 0]
                    corner[k], corner[i], corner[j] = sign, a, b
                    ends.append(3 * index[tuple(corner)])
                quad(ends[0] + i, ends[1] + i, ends[1] + j, ends[0] + j)
        faces += [[3 * n, 3 * n + 1, 3 * n + 2] for n in range(8)]
        turn = np.eye(3) if axes is None else axes
        placed = vertices.reshape(-1, 3) @ turn.T + np.asarray(centre, dtype=np.float64)
        self.add(material, placed, normals.reshape(-1, 3) @ turn.T, np.array(faces))

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


def _tangents(vertices: Array, normals: Array, faces: NDArray[np.int64], uv: Array) -> Array:
    """Unit directions (V, 4) in which u grows along the surface, and in the fourth place the sense of v."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    (u1, v1), (u2, v2) = ((uv[faces[:, k]] - uv[faces[:, 0]]).T for k in (1, 2))
    determinant = u1 * v2 - u2 * v1
    sense = np.where(determinant < 0, -1.0, 1.0)[:, None]
    along_u = sense * ((b - a) * v2[:, None] - (c - a) * v1[:, None])
    along_v = sense * ((c - a) * u1[:, None] - (b - a) * u2[:, None])
    total_u, total_v = np.zeros_like(vertices), np.zeros_like(vertices)
    for k in range(3):
        np.add.at(total_u, faces[:, k], along_u)
        np.add.at(total_v, faces[:, k], along_v)
    total_u -= normals * (total_u * normals).sum(axis=1, keepdims=True)
    length = np.linalg.norm(total_u, axis=1, keepdims=True)
    # Where u has no direction, any in the surface does.
    spare = np.cross(normals, np.where(np.abs(normals[:, :1]) < 0.9, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]))
    spare /= np.linalg.norm(spare, axis=1, keepdims=True)
    directed: Array = total_u / np.maximum(length, 1e-12)
    unit_u: Array = np.asarray(np.where(length > 1e-12, directed, spare), dtype=np.float64)
    hand = np.where((np.cross(normals, unit_u) * total_v).sum(axis=1) < 0, -1.0, 1.0)
    return np.c_[unit_u, hand]


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
