"""Triangle meshes with skin weights, and the few operations that the clothes need."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np
import scipy.sparse as sparse
from numpy.typing import NDArray

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Flags = NDArray[np.bool_]


@dataclass
class Mesh:
    """`vertices` (V, 3) m, `weights` (V, J) per joint, `faces` (F, 3), and `uv` (V, 2) where it has them."""

    vertices: Array
    weights: Array
    faces: Indices
    uv: Array | None = None

    def compact(self) -> Mesh:
        """Drop the vertices that no face uses."""
        used = np.unique(self.faces)
        index = np.full(len(self.vertices), -1, dtype=np.int64)
        index[used] = np.arange(len(used))
        uv = None if self.uv is None else self.uv[used]
        return Mesh(self.vertices[used], self.weights[used], index[self.faces], uv)

    def where(self, flags: Flags) -> Mesh:
        """Keep the faces whose corners are all flagged; `flags` is (V,)."""
        return replace(self, faces=self.faces[flags[self.faces].all(axis=1)]).compact()

    def subdivided(self) -> Mesh:
        """Split each triangle into four at its edges' midpoints."""
        count, faces = len(self.vertices), self.faces
        edges = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
        unique, inverse = np.unique(edges, axis=0, return_inverse=True)
        ab, bc, ca = (count + part for part in np.split(inverse.ravel(), 3))
        a, b, c = faces.T
        split = [np.c_[a, ab, ca], np.c_[ab, b, bc], np.c_[ca, bc, c], np.c_[ab, bc, ca]]
        return Mesh(
            np.vstack([self.vertices, self.vertices[unique].mean(axis=1)]),
            np.vstack([self.weights, self.weights[unique].mean(axis=1)]),
            np.vstack(split),
        )

    def clipped(self, keep: Array) -> Mesh:
        """Keep where the scalar field `keep` (V,) is positive, cutting triangles exactly at its zero."""
        mesh, field = self.scored(keep, near_m=0.004)
        inside = (field[mesh.faces] >= 0).all(axis=1) & (field[mesh.faces] > 0).any(axis=1)
        return replace(mesh, faces=mesh.faces[inside]).compact()

    def scored(self, field: Array, within: Flags | None = None, near_m: float = 0.002) -> tuple[Mesh, Array]:
        """Put a line of vertices along the zero of a scalar field (V,), on edges with both ends `within`.

        Vertices `near_m` to the line are moved on it, so that no slivers are cut. With the field (V',) at the
        vertices after it.
        """
        count, faces = len(self.vertices), self.faces
        sides = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
        edges, inverse = np.unique(sides, axis=0, return_inverse=True)
        edges_within = np.ones(len(edges), dtype=bool) if within is None else within[edges].all(axis=1)
        vertices, weights, field = _snapped(self.vertices, self.weights, field, edges[edges_within], near_m)
        low, high = field[edges[:, 0]], field[edges[:, 1]]
        crossed = (low * high < 0) & edges_within
        t = (low[crossed] / (low[crossed] - high[crossed]))[:, None]
        a, b = edges[crossed].T
        new = np.full(len(edges), -1, dtype=np.int64)
        new[crossed] = count + np.arange(len(a))
        of_face = new[np.stack(np.split(inverse.ravel(), 3), axis=1)]
        split: list[list[int]] = faces[(of_face < 0).all(axis=1)].tolist()
        touched = (of_face >= 0).any(axis=1)
        for corners, cuts in zip(faces[touched].tolist(), of_face[touched].tolist(), strict=True):
            # Turned so that the first edge is cut; where two are, the second follows.
            turn = max(range(3), key=lambda n: (cuts[n] >= 0) + (cuts[n] >= 0 and cuts[(n + 1) % 3] >= 0))
            i, j, k = corners[turn:] + corners[:turn]
            first, second = cuts[turn], cuts[(turn + 1) % 3]
            if second < 0:
                split += [[i, first, k], [first, j, k]]
            else:
                split += [[first, j, second], [i, first, second], [i, second, k]]
        mesh = Mesh(
            np.vstack([vertices, vertices[a] * (1 - t) + vertices[b] * t]),
            np.vstack([weights, weights[a] * (1 - t) + weights[b] * t]),
            np.array(split, dtype=np.int64),
        )
        return mesh, np.r_[field, np.zeros(len(a))]


def _snapped(
    vertices: Array, weights: Array, field: Array, edges: Indices, near_m: float
) -> tuple[Array, Array, Array]:
    """Vertices, weights and field with what is near the field's zero along one of the edges moved on it."""
    low, high = field[edges[:, 0]], field[edges[:, 1]]
    edges = edges[low * high < 0]
    t = np.abs(field[edges[:, 0]]) / np.abs(field[edges[:, 0]] - field[edges[:, 1]])
    ends = np.vstack([edges, edges[:, ::-1]])
    share = np.r_[t, 1 - t]
    way = share * np.linalg.norm(vertices[ends[:, 0]] - vertices[ends[:, 1]], axis=1)
    near = np.flatnonzero((share < 0.45) & (way < near_m))
    near = near[np.lexsort((way[near], ends[near, 0]))]
    moved, first = np.unique(ends[near, 0], return_index=True)
    chosen = near[first]
    toward, s = ends[chosen, 1], share[chosen][:, None]
    vertices, weights, field = vertices.copy(), weights.copy(), field.copy()
    vertices[moved] = vertices[moved] * (1 - s) + vertices[toward] * s
    weights[moved] = weights[moved] * (1 - s) + weights[toward] * s
    field[moved] = 0.0
    return vertices, weights, field


def welded(mesh: Mesh, digits: int = 5) -> Mesh:
    """Join the vertices that lie at one place, to `digits` decimals of a metre."""
    _, first, inverse = np.unique(
        np.round(mesh.vertices, digits), axis=0, return_index=True, return_inverse=True
    )
    faces = inverse.ravel()[mesh.faces]
    proper = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 0] != faces[:, 2])
    return Mesh(mesh.vertices[first], mesh.weights[first], faces[proper])


def joined(meshes: list[Mesh]) -> Mesh:
    """Put meshes together into one; all or none of them have texture coordinates."""
    starts = np.cumsum([0] + [len(mesh.vertices) for mesh in meshes[:-1]])
    uv = None if meshes[0].uv is None else np.vstack([mesh.uv for mesh in meshes if mesh.uv is not None])
    return Mesh(
        np.vstack([mesh.vertices for mesh in meshes]),
        np.vstack([mesh.weights for mesh in meshes]),
        np.vstack([mesh.faces + start for mesh, start in zip(meshes, starts, strict=True)]),
        uv,
    )


def normals(vertices: Array, faces: Indices) -> Array:
    """Area-weighted unit vertex normals (V, 3)."""
    total = np.zeros_like(vertices)
    a, b, c = vertices[faces[:, 0]], vertices[faces[:, 1]], vertices[faces[:, 2]]
    area = np.cross(b - a, c - a)
    for corner in range(3):
        np.add.at(total, faces[:, corner], area)
    lengths = np.linalg.norm(total, axis=1, keepdims=True)
    unit: Array = np.where(lengths > 1e-12, total / np.maximum(lengths, 1e-12), [0.0, 1.0, 0.0])
    return unit


def even_normals(vertices: Array, faces: Indices) -> Array:
    """Angle-weighted unit vertex normals (V, 3): the same however a surface is cut into triangles.

    Thürmer and Wüthrich, Journal of Graphics Tools 3 (1998).
    """
    total = np.zeros_like(vertices)
    corners = vertices[faces]
    facing = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    facing /= np.maximum(np.linalg.norm(facing, axis=1, keepdims=True), 1e-15)
    for k in range(3):
        one, other = (corners[:, (k + n) % 3] - corners[:, k] for n in (1, 2))
        across = np.linalg.norm(np.cross(one, other), axis=1)
        angle = np.arctan2(across, (one * other).sum(axis=1))
        np.add.at(total, faces[:, k], facing * angle[:, None])
    lengths = np.linalg.norm(total, axis=1, keepdims=True)
    unit: Array = np.where(lengths > 1e-12, total / np.maximum(lengths, 1e-12), [0.0, 1.0, 0.0])
    return unit


def neighbour_mean(count: int, faces: Indices) -> Any:
    """The matrix (V, V) that takes each vertex to the mean of its neighbours."""
    edges = np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    edges = np.vstack([edges, edges[:, ::-1]])
    matrix: Any = sparse.coo_matrix((np.ones(len(edges)), (edges[:, 0], edges[:, 1])), (count, count)).tocsr()
    matrix.data[:] = 1
    degree = np.maximum(np.asarray(matrix.sum(axis=1)).ravel(), 1)
    return sparse.csr_matrix(cast("Any", sparse).diags(1 / degree) @ matrix)


def border_edges(faces: Indices) -> Indices:
    """The open edges (E, 2), each as its one face goes along it."""
    directed = np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    _, index, uses = np.unique(np.sort(directed, axis=1), axis=0, return_inverse=True, return_counts=True)
    return directed[uses[index.ravel()] == 1]


def on_border(count: int, faces: Indices) -> Flags:
    """Which vertices (V,) lie on an open edge."""
    edges = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    unique, uses = np.unique(edges, axis=0, return_counts=True)
    border = np.zeros(count, dtype=bool)
    border[unique[uses == 1].ravel()] = True
    return border


def edged(mesh: Mesh, thickness_m: float) -> Mesh:
    """The mesh with its open edges turned in against its normals, as cloth of that thickness is."""
    count, faces = len(mesh.vertices), mesh.faces
    a, b = border_edges(faces).T
    rim, place = np.unique(np.r_[a, b], return_inverse=True)
    inner_a, inner_b = np.split(count + place.ravel(), 2)
    inside = mesh.vertices[rim] - even_normals(mesh.vertices, faces)[rim] * thickness_m
    return Mesh(
        np.vstack([mesh.vertices, inside]),
        np.vstack([mesh.weights, mesh.weights[rim]]),
        np.vstack([faces, np.c_[b, a, inner_a], np.c_[b, inner_a, inner_b]]),
    )


def smoothed(
    values: Array, faces: Indices, rounds: int, fixed: Flags | None = None, step: float = 0.5
) -> Array:
    """Laplacian smoothing of per-vertex values (V, N); `fixed` vertices keep theirs."""
    mean = neighbour_mean(len(values), faces)
    values = values.copy()
    for _ in range(rounds):
        change: Array = mean @ values - values
        if fixed is not None:
            change[fixed] = 0
        values += step * change
    return values


def smoothstep(x: Array | float) -> Array:
    """The cubic that rises from 0 at x ≤ 0 to 1 at x ≥ 1."""
    clipped: Array = np.clip(np.asarray(x, dtype=np.float64), 0, 1)
    return clipped * clipped * (3 - 2 * clipped)
