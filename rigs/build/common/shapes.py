"""Simple shapes built from paths."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Indices = NDArray[np.int64]


def grid_faces(rows: int, columns: int, *, flip: bool = False) -> Indices:
    """Triangles of a grid of rows × columns vertices, row by row."""
    i, j = np.meshgrid(np.arange(rows - 1), np.arange(columns - 1), indexing="ij")
    a = (i * columns + j).ravel()
    b, c, d = a + 1, a + columns, a + columns + 1
    order = [np.c_[a, c, b], np.c_[b, c, d]] if flip else [np.c_[a, b, c], np.c_[b, d, c]]
    return np.hstack(order).reshape(-1, 3)


def tube(
    path: Array, radius: Array | float, up: Array, sides: int = 10, flat: float = 1.0
) -> tuple[Array, Indices, Array]:
    """A closed-round tube along `path` (N, 3); `up` (N, 3) or (3,) gives the flattened axis.

    Vertices, faces, uv.
    """
    count = len(path)
    radii = np.broadcast_to(radius, count)
    tangent = np.gradient(path, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    side = np.cross(tangent, np.broadcast_to(up, (count, 3)))
    side /= np.maximum(np.linalg.norm(side, axis=1, keepdims=True), 1e-9)
    over = np.cross(side, tangent)
    angle = np.linspace(0, 2 * np.pi, sides + 1)
    ring = side[:, None] * np.cos(angle)[:, None] + flat * over[:, None] * np.sin(angle)[:, None]
    vertices = (path[:, None] + radii[:, None, None] * ring).reshape(-1, 3)
    u, v = np.meshgrid(np.linspace(0, 1, sides + 1), np.linspace(0, 1, count))
    return vertices, grid_faces(count, sides + 1, flip=True), np.c_[u.ravel(), v.ravel()]
