"""Where a ray meets a triangle mesh; slow and plain, for the few rays that a build needs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Indices = NDArray[np.int64]


def ray_distances(origin: Array, direction: Array, vertices: Array, faces: Indices) -> Array:
    """The sorted distances (N,) at which a ray along unit `direction` crosses faces (Möller and Trumbore)."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    edge1, edge2 = b - a, c - a
    p = np.cross(direction, edge2)
    determinant = (edge1 * p).sum(axis=1)
    safe = np.where(np.abs(determinant) < 1e-14, 1.0, determinant)
    t = origin - a
    u = (t * p).sum(axis=1) / safe
    q = np.cross(t, edge1)
    v = (q * direction).sum(axis=1) / safe
    distance = (edge2 * q).sum(axis=1) / safe
    hit = (np.abs(determinant) >= 1e-14) & (u >= 0) & (v >= 0) & (u + v <= 1) & (distance > 0)
    sorted_distances: Array = np.sort(distance[hit])
    return sorted_distances


def first_hit(origin: Array, direction: Array, vertices: Array, faces: Indices) -> Array:
    """The nearest point (3,) where the ray meets the mesh; raises ValueError when it misses."""
    distances = ray_distances(origin, direction, vertices, faces)
    if not len(distances):
        raise ValueError(f"no surface from {origin} along {direction}")
    return origin + distances[0] * direction
