"""Cymbals of lathed bronze, in their own frames: the origin in the hole, +Y up."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from common.turning import Workpiece
from drums import measures as m

if TYPE_CHECKING:
    from drums.materials import KitMaterials
    from drums.measures import Array, Cymbal


def radii(cymbal: Cymbal, rows: int) -> Array:
    """Where the profile is cut, from the hole to the edge: closer on the bell and where it joins the bow."""
    bell, edge = cymbal.bell, cymbal.radius
    on_bell = np.linspace(m.HOLE, bell, max(4, round(0.6 * rows)))
    turn = bell + 0.74 * (edge - bell)
    if cymbal.flange:
        bow = np.r_[np.linspace(bell, turn, rows // 2 + 1)[1:], np.linspace(turn, edge, rows // 2 + 1)[1:]]
    else:
        bow = np.linspace(bell, edge, rows + 1)[1:]
    return np.unique(np.r_[on_bell, bell + 0.0015, bow])


def bronze(detail: float, materials: KitMaterials, cymbal: Cymbal, *, over: bool = False) -> Workpiece:
    """Upper and lower side and the edge between; `over` turns it over, as a hi-hat's lower one lies."""
    piece = Workpiece(detail)
    sign = -1.0 if over else 1.0
    sides = piece.facets(64 if cymbal.radius > 0.15 else 52, 20)
    angle = np.linspace(0, 2 * np.pi, sides + 1)
    spoke = np.stack([np.sin(angle), np.zeros(sides + 1), -np.cos(angle)], axis=1)
    up = np.array([0.0, 1.0, 0.0])
    for rows, side in ((piece.facets(11, 5), 1.0), (piece.facets(6, 4), -1.0)):
        r = radii(cymbal, rows)
        edge = r > cymbal.radius - 1e-6
        thick = np.where(edge, 0.4, 1.0) * m.CYMBAL_THICKNESS
        slope = np.array([cymbal.slope(float(x)) for x in np.clip(r, m.HOLE, cymbal.radius - 1e-4)])
        y = cymbal.height(r) - (0.0 if side > 0 else 1.0) * thick
        vertices = spoke[None] * r[:, None, None] + up * (sign * y)[:, None, None]
        normals = side * (up * sign - spoke[None] * (sign * slope)[:, None, None])
        normals = normals / np.linalg.norm(normals, axis=2, keepdims=True)
        u, v = np.meshgrid(angle / (2 * np.pi) * 4, r / cymbal.radius)
        index = np.arange(len(r) * (sides + 1)).reshape(len(r), -1)
        a, b, c, d = (index[i : i - 1 or None, j : j - 1 or None].ravel() for i in (0, 1) for j in (0, 1))
        faces = np.vstack([np.c_[a, b, c], np.c_[b, d, c]])
        uv = np.c_[u.ravel(), v.ravel()]
        piece.add(materials.bronze, vertices.reshape(-1, 3), normals.reshape(-1, 3), faces, uv)
    rim = float(cymbal.height(cymbal.radius))
    edge_profile = [(sign * (rim - 0.4 * m.CYMBAL_THICKNESS), cymbal.radius), (sign * rim, cymbal.radius)]
    piece.lathe(materials.bronze, (0, 0, 0), up, edge_profile, 64 if cymbal.radius > 0.15 else 52)
    return piece


def felt(piece: Workpiece, materials: KitMaterials, low: float, high: float, radius: float) -> None:
    """A washer of felt between two heights."""
    soft = 0.25 * (high - low)
    profile = [
        (low, 0.004),
        (low, radius - soft),
        (low + soft, radius),
        (high - soft, radius),
        (high, radius - soft),
        (high, 0.004),
    ]
    piece.lathe(materials.felt, (0, 0, 0), (0, 1, 0), profile, 18)


def wing_nut(piece: Workpiece, materials: KitMaterials, y: float) -> None:
    """The nut that holds a cymbal, with its two wings."""
    body = [(y, 0.0), (y, 0.0085), (y + 0.003, 0.0085), (y + 0.010, 0.0055), (y + 0.0105, 0.0)]
    piece.lathe(materials.chrome, (0, 0, 0), (0, 1, 0), body, 14)
    for side in (-1, 1):
        path = np.array([[side * x, y + h, 0.0] for x, h in ((0.004, 0.005), (0.011, 0.009), (0.017, 0.017))])
        piece.sweep(materials.chrome, path, np.array([0.0038, 0.0034, 0.0040]), 8, caps=True, oval=(1.0, 0.5))


def stand_top(detail: float, materials: KitMaterials) -> Workpiece:
    """The top of a stand in the cymbal's frame at rest: seat, felts, sleeve, rod and wing nut."""
    piece = Workpiece(detail)
    cup = [
        (-0.022, 0.0),
        (-0.022, 0.0095),
        (-0.0165, 0.0130),
        (-0.0145, 0.0170),
        (-0.0130, 0.0170),
        (-0.0130, 0.003),
    ]
    piece.lathe(materials.chrome, (0, 0, 0), (0, 1, 0), cup, 20)
    felt(piece, materials, -0.0130, -m.CYMBAL_THICKNESS - 0.0004, 0.0185)
    felt(piece, materials, 0.0006, 0.0105, 0.0165)
    rod = [(-0.0130, 0.0039), (0.0340, 0.0030), (0.0340, 0.0)]
    piece.lathe(materials.chrome, (0, 0, 0), (0, 1, 0), rod, 10)
    wing_nut(piece, materials, 0.0110)
    return piece
