"""Paths that tubes follow."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Point = Sequence[float] | Array


def line(start: Point, end: Point, points: int = 2) -> Array:
    """Points (N, 3) evenly from start to end."""
    return np.linspace(start, end, points)


def bezier(p0: Point, p1: Point, p2: Point, p3: Point, points: int) -> Array:
    """A cubic Bézier curve (N, 3)."""
    t = np.linspace(0, 1, points)[:, None]
    a, b, c, d = (np.asarray(p, dtype=np.float64) for p in (p0, p1, p2, p3))
    return (1 - t) ** 3 * a + 3 * (1 - t) ** 2 * t * b + 3 * (1 - t) * t * t * c + t**3 * d


def joined_path(*pieces: Array) -> Array:
    """Pieces end to end; a point that two of them share is kept once."""
    result = [np.asarray(pieces[0], dtype=np.float64)]
    for piece in pieces[1:]:
        shared = np.linalg.norm(piece[0] - result[-1][-1]) < 1e-6
        result.append(np.asarray(piece[1:] if shared else piece, dtype=np.float64))
    return np.vstack(result)


def arc_length(path: Array) -> Array:
    """Distance (N,) along the path to each of its points."""
    return np.r_[0, np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))]


def at_lengths(path: Array, lengths: Array) -> Array:
    """Points (N, 3) on the path at these distances along it."""
    known = arc_length(path)
    return np.column_stack([np.interp(lengths, known, path[:, k]) for k in range(3)])


def u_bend(
    x_top: float, x_bottom: float, y_top: float, y_bottom: float, z: float, depth: float, points: int
) -> Array:
    """A half-round bow in the YZ plane.

    From (x_top, y_top) to (x_bottom, y_bottom) at z, reaching `depth` beyond.
    """
    a = np.linspace(0, np.pi, points)
    middle, half = (y_top + y_bottom) / 2, (y_top - y_bottom) / 2
    x = x_top + (x_bottom - x_top) * (1 - np.cos(a)) / 2
    return np.column_stack([x, middle + half * np.cos(a), z + depth * np.sin(a)])
