"""What is sewn on the uniform: lapels, buttons, collar and ribbon bow."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.spatial import cKDTree

from common.meshes import Mesh, joined
from common.parts import Part, Surface
from common.shapes import grid_faces, tube
from dress.tailor import Tailor, borrowed_weights
from dress.uniform import SHIRT, opening, top_button_y

Array = NDArray[np.float64]

LAPEL = Surface("lapel", 0.75, colour=(0.13, 0.155, 0.27), both_sides=True)
BRASS = Surface("button", 0.3, 1.0, colour=(0.85, 0.68, 0.32))
RIBBON = Surface("ribbon", 0.6, colour=(0.62, 0.10, 0.14), both_sides=True)


def _eased(values: Array, width: float) -> Array:
    """A row of values (N,), smoothed by a bell of this many steps."""
    eased: Array = cast("Any", ndimage).gaussian_filter1d(values, width)
    return eased


def _front_z(tailor: Tailor, outer: Mesh, x: Array, y: Array) -> Array:
    """Depth (N,) of the chest's front at (x, y), carried on into the opening by the nearest cloth."""
    cloth = outer.vertices[outer.vertices[:, 2] > tailor.at("upperChest")[2] - 0.02]
    distance, index = cKDTree(cloth[:, :2]).query(np.c_[x, y], k=8)
    near = 1 / (distance + 0.004)
    depth: Array = (cloth[index, 2] * near).sum(axis=1) / near.sum(axis=1)
    return depth


def lapels(tailor: Tailor, outer: Mesh, steps: int = 28) -> Mesh:
    """Two strips turned over along the opening's edge, notched near the collar."""
    low, high = top_button_y(tailor), tailor.neck_y + 0.007
    t = np.linspace(0, 1, steps)
    y = low + (high - low) * t
    edge = opening(tailor, y)
    notch = np.where(t < 0.80, 1, 1 - (t - 0.80) * 2.2)
    width = 0.006 + 0.040 * np.sin(np.minimum(1, t * 1.25) * np.pi / 2) * notch
    strips: list[Mesh] = []
    for sign in (1, -1):
        rows: list[Array] = []
        for share, lift in ((-0.06, 0.0005), (0.08, 0.0062), (0.5, 0.0072), (0.92, 0.0066), (1.0, 0.0040)):
            x, yy = edge + 0.001 + width * share, y + width * 0.15 * max(share, 0)
            z = _eased(_front_z(tailor, outer, sign * np.maximum(x, edge + 0.008), yy), 3.5) + lift
            rows.append(np.c_[sign * x, yy, z])
        points = np.stack(rows, axis=1).reshape(-1, 3)
        strips.append(Mesh(points, borrowed_weights(points, outer), grid_faces(steps, 5, flip=sign < 0)))
    return joined(strips)


def buttons(tailor: Tailor, outer: Mesh, sides: int = 16) -> Mesh:
    """Two brass buttons below the opening."""
    discs: list[Mesh] = []
    for k in range(2):
        y = top_button_y(tailor) - 0.025 - 0.075 * k
        depth = float(_front_z(tailor, outer, np.array([0.004]), np.array([y]))[0])
        angle = np.linspace(0, 2 * np.pi, sides, endpoint=False)
        rings = [
            np.c_[0.004 + r * np.cos(angle), y + r * np.sin(angle), np.full(sides, depth + z)]
            for r, z in ((0.0078, 0.0), (0.0070, 0.0030))
        ]
        points = np.vstack([*rings, [[0.004, y, depth + 0.0038]]])
        faces: list[list[int]] = []
        for i in range(sides):
            j = (i + 1) % sides
            faces += [[i, j, sides + i], [j, sides + j, sides + i], [sides + i, sides + j, 2 * sides]]
        discs.append(Mesh(points, borrowed_weights(points, outer), np.array(faces)))
    return joined(discs)


def collar(tailor: Tailor, steps: int = 64) -> Mesh:
    """The shirt's collar: a band round the neck, folded down, open in front."""
    centre_z = _neck_centre_z(tailor)
    angle = np.linspace(0.16, 2 * np.pi - 0.16, steps + 1)
    front = (1 + np.cos(angle)) / 2
    base = tailor.neck_y + 0.012 - 0.030 * front
    inner = _eased(_neck_radius(tailor, centre_z, angle, base + 0.010), 5) + 0.010
    upper = _eased(_neck_radius(tailor, centre_z, angle, base + 0.034), 5) + 0.007
    top = base + 0.034
    profile = (
        (inner, base),
        (upper, top),
        (upper + 0.0035, top + 0.0022),
        (upper + 0.0075, top + 0.0005),
        (inner + 0.014 + 0.010 * front, base - 0.006 - 0.018 * front**6),
    )
    rows = [np.c_[np.sin(angle) * r, y, centre_z + np.cos(angle) * r] for r, y in profile]
    points = np.stack(rows, axis=1).reshape(-1, 3)
    return Mesh(
        points, tailor.rigid(len(points), neck=0.45, upperChest=0.55), grid_faces(steps + 1, 5, flip=True)
    )


def blazer_collar(tailor: Tailor, outer: Mesh, steps: int = 48) -> Mesh:
    """The blazer's own collar: a fold round the nape that runs into the lapels on both sides."""
    centre_z = _neck_centre_z(tailor)
    angle = np.linspace(1.30, 2 * np.pi - 1.30, steps + 1)
    back = (1 - np.cos(angle)) / 2
    stand = (
        _eased(_neck_radius(tailor, centre_z, angle, np.full(steps + 1, tailor.neck_y + 0.012)), 6) + 0.0285
    )
    top = tailor.neck_y + 0.002 + 0.016 * back
    shoulder = _outer_height(tailor, outer, centre_z, angle, stand + 0.026)
    fall = np.maximum(_eased(shoulder, 3) + 0.0035, top - 0.040)
    profile = (
        (stand - 0.001, top - 0.016),
        (stand, top),
        (stand + 0.004, top + 0.0025),
        (stand + 0.010, top * 0.8 + fall * 0.2 + 0.001),
        (stand + 0.018, top * 0.4 + fall * 0.6 + 0.001),
        (stand + 0.026, fall),
    )
    rows = [np.c_[np.sin(angle) * r, y, centre_z + np.cos(angle) * r] for r, y in profile]
    points = np.stack(rows, axis=1).reshape(-1, 3)
    weights = 0.5 * borrowed_weights(points, outer) + 0.5 * tailor.rigid(
        len(points), upperChest=0.75, neck=0.25
    )
    return Mesh(points, weights, grid_faces(steps + 1, len(profile), flip=True))


def _outer_height(tailor: Tailor, outer: Mesh, centre_z: float, angles: Array, radii: Array) -> Array:
    """Height (N,) of the blazer's shoulders at places round the neck."""
    cloth = outer.vertices[outer.vertices[:, 1] > tailor.neck_y - 0.14]
    distance, index = cKDTree(cloth[:, [0, 2]]).query(
        np.c_[np.sin(angles) * radii, centre_z + np.cos(angles) * radii], k=6
    )
    near = 1 / (distance + 0.003)
    height: Array = (cloth[index, 1] * near).sum(axis=1) / near.sum(axis=1)
    return height


def bow(tailor: Tailor) -> Mesh:
    """A ribbon bow at the collar: two loops, two tails, a knot."""
    centre_z = _neck_centre_z(tailor)
    radius = float(_neck_radius(tailor, centre_z, np.zeros(1), np.array([tailor.neck_y]))[0])
    knot = np.array([0.0, tailor.neck_y - 0.026, centre_z + radius + 0.034])
    t = np.linspace(0, 1, 9)
    pieces: list[Mesh] = []
    for sign in (1, -1):
        swell = np.sin(t * np.pi)
        loop = np.c_[sign * 0.048 * t, 0.004 * swell, 0.006 * swell - 0.012 * t * t]
        loop_width = 0.005 + 0.016 * np.sin(np.minimum(t * 1.15, 1) * np.pi / 2)
        tail = np.c_[sign * (0.006 + 0.020 * t), -0.075 * t, 0.002 - 0.004 * t]
        for path, width, across in (
            (loop, loop_width, [0, 1, 0]),
            (tail, 0.005 + 0.009 * t, [1, 0.25 * sign, 0]),
        ):
            rows = [
                knot + path + np.outer(width * k, across) + [0, 0, 0.004 * (1 - abs(k))] for k in (-1, 0, 1)
            ]
            points = np.stack(rows, axis=1).reshape(-1, 3)
            pieces.append(Mesh(points, tailor.rigid(len(points), upperChest=1), grid_faces(9, 3)))
    path = knot + np.array([[0, 0.009, 0.002], [0, 0.005, 0.006], [0, -0.005, 0.006], [0, -0.009, 0.002]])
    points, faces, _ = tube(path, np.array([0.004, 0.008, 0.008, 0.004]), np.array([0.0, 0.0, 1.0]), 10)
    pieces.append(Mesh(points, tailor.rigid(len(points), upperChest=1), faces))
    return joined(pieces)


def _neck_centre_z(tailor: Tailor) -> float:
    body, weights = tailor.figure.body, tailor.weights[: len(tailor.figure.body)]
    ring = (np.abs(body[:, 1] - (tailor.neck_y + 0.035)) < 0.012) & (
        tailor.weight_of(weights, "head", "neck") > 0.2
    )
    return float(body[ring, 2].mean())


def _neck_radius(tailor: Tailor, centre_z: float, angles: Array, heights: Array) -> Array:
    """The neck's radius (N,) about its axis toward each angle (0 is the front) at each height."""
    body = tailor.figure.body
    near_axis = np.hypot(body[:, 0], body[:, 2] - centre_z)
    radii: list[float] = []
    for angle, y in zip(angles, heights, strict=True):
        rows = np.flatnonzero((np.abs(body[:, 1] - y) < 0.012) & (near_axis < 0.09))
        turn = np.arctan2(body[rows, 0], body[rows, 2] - centre_z) - angle
        nearest = np.argsort(np.abs((turn + np.pi) % (2 * np.pi) - np.pi), kind="stable")[:8]
        radii.append(float(near_axis[rows[nearest]].mean()))
    return np.array(radii)


def trimming_parts(tailor: Tailor, outer: Mesh) -> list[Part]:
    """All trimmings, made for the blazer `outer`."""
    return [
        Part("Lapels", joined([lapels(tailor, outer), blazer_collar(tailor, outer)]), LAPEL),
        Part("Buttons", buttons(tailor, outer), BRASS),
        Part("Collar", collar(tailor), SHIRT),
        Part("Ribbon", bow(tailor), RIBBON),
    ]
