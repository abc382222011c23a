"""Collars and lapels: ribbons turned over along the coat's edge, and the shirt's fold-down collar."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.spatial import cKDTree

from common.meshes import Mesh, joined, normals
from common.raycast import ray_distances
from common.shapes import grid_faces
from dress.tailor import Tailor, borrowed_weights
from dress.uniform import NECKLINE_M, collar_seam_height, neck_axis_z, neckline_height, opening, top_button_y

Array = NDArray[np.float64]

GORGE_RAD = 1.12  # where round the neck (0 is the front) collar and lapel are sewn together
LAPEL_M = 0.060  # the lapel's width at its notch, and the blazer collar's beside it
COLLAR_M = 0.034
OVERLAP = 2  # rows of the edge that lapel and collar share
UNDER_LAPEL = 0.03  # the share of the collar's edge at each end that the lapels cover
STAND_M = 0.014  # how high the blazer collar stands at the nape


class Drape:
    """Smooth projection onto a cloth."""

    def __init__(self, cloth: Mesh) -> None:
        self.cloth = cloth
        self.tree = cKDTree(cloth.vertices)
        self.normals = normals(cloth.vertices, cloth.faces)

    def front(self, x: float, y: float) -> Array:
        """The place (3,) on the cloth's front at x, y."""
        before = self.cloth.vertices[self.cloth.vertices[:, 2] > 0.0]
        near = np.argsort((before[:, 0] - x) ** 2 + (before[:, 1] - y) ** 2)[:6]
        return np.array([x, y, float(before[near, 2].mean())])

    def surface(self, points: Array) -> tuple[Array, Array]:
        """The nearest places (N, 3) on the cloth and its normals (N, 3) there, eased over a centimetre."""
        normal = points
        for _ in range(3):
            distance, index = self.tree.query(points, k=14)
            near = 1 / (distance**2 + 0.007**2)
            near /= near.sum(axis=1, keepdims=True)
            centre = (self.cloth.vertices[index] * near[..., None]).sum(axis=1)
            normal = (self.normals[index] * near[..., None]).sum(axis=1)
            normal /= np.linalg.norm(normal, axis=1, keepdims=True)
            points = points - ((points - centre) * normal).sum(axis=1, keepdims=True) * normal
        return points, normal


def _eased(values: Array, width: float) -> Array:
    """Rows of values (N, …), smoothed along the first axis by a bell of this many steps."""
    eased: Array = cast("Any", ndimage).gaussian_filter1d(values, width, axis=0, mode="nearest")
    return eased


def _resampled(path: Array, steps: int) -> Array:
    """The path (N, 3) at `steps` equal distances."""
    length = np.r_[0, np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))]
    at: Array = np.linspace(0, float(length[-1]), steps)
    return np.column_stack([np.interp(at, length, path[:, k]) for k in range(3)])


def _sheet(rows: list[Array], count: int) -> Array:
    """Lines (N, 3) side by side, thinned to `count` places along each: (count, lines, 3)."""
    places = np.round(np.linspace(0, len(rows[0]) - 1, count)).astype(int)
    return np.stack(rows, axis=1)[places]


def _edge(tailor: Tailor, drape: Drape, sign: int) -> tuple[Array, int]:
    """The line (N, 3) on which the coat's front turns over.

    From the button up and round the neck to the nape; and at which row collar and lapel meet.
    """
    low = top_button_y(tailor)
    y = np.linspace(low, tailor.neck_y - 0.050, 40)
    x = sign * (opening(tailor, y) + 0.001)
    v = drape.cloth.vertices
    before = v[v[:, 2] > tailor.at("upperChest")[2]]
    z = before[cKDTree(before[:, :2]).query(np.c_[x, y])[1], 2]
    front = drape.surface(np.c_[x, y, z])[0]
    angle = np.linspace(1.25, np.pi, 30)
    y = tailor.neck_y + neckline_height(angle)
    centre_z = neck_axis_z(tailor, y)
    guess = np.c_[sign * np.sin(angle) * NECKLINE_M, y, centre_z + np.cos(angle) * NECKLINE_M]
    around = drape.surface(guess)[0]
    line = _eased(_resampled(np.vstack([front, around]), 120), 4.0)
    turn = np.arctan2(np.abs(line[:, 0]), line[:, 2] - neck_axis_z(tailor, line[:, 1]))
    high = line[:, 1] > tailor.neck_y - 0.09
    return line, int(np.flatnonzero(high & (turn > GORGE_RAD))[0])


def _aside(line: Array, normal: Array, sign: int) -> Array:
    """Unit directions (N, 3) along the cloth, square to the line, away from the opening."""
    tangent = np.gradient(line, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    aside = np.cross(normal, tangent) * -sign
    unit: Array = aside / np.linalg.norm(aside, axis=1, keepdims=True)
    return unit


def lapels(tailor: Tailor, cloth: Mesh, count: int, thick: float) -> tuple[Mesh, list[Array]]:
    """Two lapels turned over along the opening, widest at the notch; and their outer edges (N, 3).

    `count` rows each, `thick` times as high over the coat.
    """
    drape, steps = Drape(cloth), 40
    strips: list[Mesh] = []
    edges: list[Array] = []
    for sign in (1, -1):
        line, gorge = _edge(tailor, drape, sign)
        line = _resampled(line[: gorge + OVERLAP], steps)
        normal = drape.surface(line)[1]
        aside = _eased(_aside(line, normal, sign), 3.0)
        t = np.linspace(0, 1, steps)
        width = 0.004 + (LAPEL_M - 0.004) * np.sin(t**0.85 * np.pi / 2) ** 1.1
        rows: list[Array] = []
        for share, lift in (
            (-0.10, -0.0020), (-0.03, 0.0020), (0.06, 0.0055), (0.30, 0.0062), (0.65, 0.0052), (0.96, 0.0045),
            (1.0, 0.0022),
        ):  # fmt: skip
            places = line + aside * (width * share)[:, None]
            places[:, 1] += 0.010 * np.clip(share, 0, 1) * t**6  # the notch's upper edge rises a little
            on, out = drape.surface(places)
            rows.append(_eased(on + out * (thick * lift), 1.0))
        sheet = _sheet(rows, count)
        points = sheet.reshape(-1, 3)
        strips.append(Mesh(points, borrowed_weights(points, cloth), grid_faces(count, 7, flip=sign < 0)))
        edges.append(np.vstack([sheet[:, 5], sheet[-1, 4:1:-1]]))
    return joined(strips), edges


def blazer_collar(tailor: Tailor, cloth: Mesh, count: int) -> tuple[Mesh, Array]:
    """The blazer's collar, and its edge (N, 3).

    It stands at the nape, turns over, and meets the lapels at the notch.
    """
    drape, steps = Drape(cloth), 61
    halves: list[Array] = []
    for sign in (1, -1):
        line, gorge = _edge(tailor, drape, sign)
        half = line[gorge - OVERLAP :]
        halves.append(half if sign > 0 else half[::-1])
    line = _eased(_resampled(np.vstack([halves[0], halves[1][1:]]), steps), 1.5)
    normal = drape.surface(line)[1]
    aside = _eased(_aside(line, normal, 1), 2.0)
    back = np.sin(np.linspace(0, np.pi, steps))
    stand = 0.002 + (STAND_M - 0.002) * np.clip(back * 1.25, 0, 1) ** 1.2
    width = COLLAR_M + 0.004 * back
    top = line + stand[:, None] * np.array([0.0, 1.0, 0.0]) + aside * 0.0015
    under = line - aside * 0.001 - normal * 0.004
    fall, out = drape.surface(line + aside * width[:, None])
    edge, hem = fall + out * 0.0062, fall + out * 0.0030 + aside * 0.0006
    middle = drape.surface(line + aside * (0.5 * width)[:, None])[0]
    middle = middle + drape.normals[drape.tree.query(middle)[1]] * (0.0065 + 0.20 * stand)[:, None]
    crown = top + aside * 0.0045 + np.array([0.0, 0.0018, 0.0])
    shoulder = 0.55 * crown + 0.45 * middle + normal * 0.0022
    rows = [under, top, crown, shoulder, _eased(middle, 2.0), _eased(edge, 1.5), _eased(hem, 1.5)]
    sheet = _sheet(rows, count)
    points = sheet.reshape(-1, 3)
    weights = _eased(borrowed_weights(points, cloth).reshape(count, len(rows), -1), 2.0 * count / steps)
    mesh = Mesh(points, weights.reshape(len(points), -1), grid_faces(count, len(rows)))
    covered = round(count * UNDER_LAPEL)
    return mesh, sheet[covered : count - covered, 5]


def shirt_collar(tailor: Tailor, count: int) -> Mesh:
    """The shirt's collar: a band round the neck, folded down to two points in front."""
    steps = 72
    share = np.linspace(0, 1, steps + 1)
    inner = 2 * np.pi * share  # the band is buttoned; the fall's two points part from there
    outer = 0.40 + (2 * np.pi - 0.80) * share
    front = ((1 + np.cos(inner)) / 2) ** 4
    base = tailor.neck_y + collar_seam_height(inner)
    top = base + 0.037 - 0.004 * front
    low = tailor.neck_y + collar_seam_height(outer) + 0.002 - 0.034 * ((1 + np.cos(outer)) / 2) ** 5
    bottom = _eased(_neck_radius(tailor, inner, base), 4) + 0.004
    upper = np.minimum(_eased(_neck_radius(tailor, inner, top), 4) + 0.0045, bottom + 0.004)
    profile = (
        (inner, bottom, base),
        (inner, upper, top - 0.001),
        (0.8 * inner + 0.2 * outer, upper + 0.0022, top + 0.0012),
        (0.7 * inner + 0.3 * outer, upper + 0.0050, top - 0.0015),
        (0.4 * inner + 0.6 * outer, np.maximum(upper, bottom) + 0.0055, 0.45 * top + 0.55 * low),
        (outer, bottom + 0.0055 + 0.015 * front, low),
        (outer, bottom + 0.0035 + 0.015 * front, low + 0.001),
    )
    rows = [np.c_[np.sin(a) * r, y, neck_axis_z(tailor, y) + np.cos(a) * r] for a, r, y in profile]
    points = _sheet(rows, count).reshape(-1, 3)
    weights = tailor.rigid(len(points), neck=0.4, upperChest=0.6)
    return Mesh(points, weights, grid_faces(count, len(profile)))


def _neck_radius(tailor: Tailor, angles: Array, heights: Array) -> Array:
    """The neck's radius (N,) about its axis toward each angle (0 is the front) at each height."""
    body = tailor.figure.body
    faces = tailor.figure.mesh.triangles(["body"])
    near = (np.abs(body[:, 1] - tailor.neck_y) < 0.12) & (np.abs(body[:, 0]) < 0.13)
    faces = faces[near[faces].all(axis=1)]
    radii: list[float] = []
    for angle, y in zip(angles, heights, strict=True):
        axis = np.array([0.0, y, float(neck_axis_z(tailor, np.array([y]))[0])])
        hits = ray_distances(axis, np.array([np.sin(angle), 0.0, np.cos(angle)]), body, faces)
        radii.append(min(float(hits[0]) if len(hits) else 0.05, 0.068))
    return np.array(radii)
