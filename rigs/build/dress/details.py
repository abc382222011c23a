"""What makes a uniform of plain cloth: piping, pocket flaps, a crest, bands on sleeves, the placket."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from body.joint_names import SIDES
from common.meshes import Mesh, joined
from common.raycast import ray_distances
from common.shapes import grid_faces, tube
from dress.buttons import SHIRT, button
from dress.collars import Drape
from dress.tailor import Tailor, borrowed_weights
from dress.uniform import opening, top_button_y

if TYPE_CHECKING:
    from collections.abc import Sequence

Array = NDArray[np.float64]

PIPING_M = 0.0013  # the cord's radius
SLEEVE_BANDS = (0.775, 0.745)  # places along the forearm
BAND_M = 0.0075
CREST = (
    (-1.0, 0.75),
    (0.0, 1.0),
    (1.0, 0.75),
    (0.95, -0.15),
    (0.55, -0.75),
    (0.0, -1.1),
    (-0.55, -0.75),
    (-0.95, -0.15),
)
CREST_M = 0.0125


def piping(edges: Sequence[Array], cloth: Mesh) -> Mesh:
    """Cords along edges (N, 3) each."""
    cords: list[Mesh] = []
    for edge in edges:
        points, faces, _ = tube(edge, PIPING_M, np.array([0.0, 0.0, 1.0]), 6)
        cords.append(Mesh(points, borrowed_weights(points, cloth), faces))
    return joined(cords)


def patch(
    drape: Drape, middle: Array, size: tuple[float, float], lift: float, tilt: float, grid: int
) -> Mesh:
    """A piece of cloth sewn flat on another: width and height, metres, turned by `tilt`, edges tucked in."""
    s, t = (
        axis.ravel()
        for axis in np.meshgrid(np.linspace(-1, 1, grid), np.linspace(-1, 1, grid), indexing="ij")
    )
    x, y = 0.5 * size[0] * s, 0.5 * size[1] * t
    front = middle[2] > 0
    flat = np.c_[x * np.cos(tilt) - y * np.sin(tilt), x * np.sin(tilt) + y * np.cos(tilt), 0 * x]
    on, out = drape.surface(middle + flat)
    edge = np.maximum(np.abs(s), np.abs(t)) > 0.999
    points = on + out * np.where(edge, 0.0004, lift)[:, None]
    return Mesh(points, borrowed_weights(points, drape.cloth), grid_faces(grid, grid, flip=front))


def pockets(tailor: Tailor, drape: Drape, grid: int) -> Mesh:
    """Two flaps at the hips, and a welt over the heart."""
    hips, chest = tailor.at("hips"), tailor.at("upperChest")
    places = [(sign * 0.088, float(hips[1]) + 0.042, (0.092, 0.036), sign * 0.10) for sign in (1, -1)] + [
        (0.092, float(chest[1]) - 0.015, (0.070, 0.014), 0.16)
    ]
    return joined([patch(drape, drape.front(x, y), size, 0.0042, tilt, grid) for x, y, size, tilt in places])


def crest(tailor: Tailor, drape: Drape) -> Mesh:
    """The band's badge over the welt of the breast pocket: a small shield."""
    chest = tailor.at("upperChest")
    middle = drape.front(0.092, float(chest[1]) + 0.022)
    rim = np.array(CREST) * CREST_M
    rings = [np.c_[rim * share, np.zeros(len(rim))] for share in (1.0, 0.8)]
    on, out = drape.surface(np.vstack([middle + ring for ring in rings] + [middle[None]]))
    lift = np.r_[np.full(len(rim), 0.001), np.full(len(rim), 0.0028), 0.0032]
    points = on + out * lift[:, None]
    n = len(rim)
    faces: list[list[int]] = []
    for i in range(n):
        j = (i + 1) % n
        faces += [[j, i, n + i], [n + j, j, n + i], [n + j, n + i, 2 * n]]
    return Mesh(points, borrowed_weights(points, drape.cloth), np.array(faces))


def sleeve_bands(tailor: Tailor, outer: Mesh, columns: int) -> Mesh:
    """Two bands round each sleeve, near the cuff."""
    angle = np.linspace(0, 2 * np.pi, columns + 1)
    bands: list[Mesh] = []
    for side, _ in SIDES:
        elbow, wrist = tailor.at(f"{side}LowerArm"), tailor.at(f"{side}Hand")
        axes, along = tailor.skeleton.axes[f"{side}LowerArm"], wrist - elbow
        near = np.linalg.norm(outer.vertices - elbow - 0.76 * along, axis=1) < 0.10
        local = outer.faces[near[outer.faces].all(axis=1)]
        spokes = np.cos(angle)[:, None] * axes[:, 1] + np.sin(angle)[:, None] * axes[:, 2]
        width = BAND_M / float(np.linalg.norm(along))
        for place in SLEEVE_BANDS:
            rows: list[Array] = []
            for share, lift in ((-0.5, 0.0004), (-0.45, 0.0018), (0.45, 0.0018), (0.5, 0.0004)):
                centre = elbow + (place + share * width) * along
                radii = np.array(
                    [ray_distances(centre, spoke, outer.vertices, local)[0] for spoke in spokes[:-1]]
                )
                rows.append(centre + spokes * (np.r_[radii, radii[:1]] + lift)[:, None])
            points = np.vstack(rows)
            bands.append(Mesh(points, borrowed_weights(points, outer), grid_faces(4, columns + 1)))
    return joined(bands)


def placket(tailor: Tailor, shirt: Mesh, rows: int) -> Mesh:
    """The shirt's front edge with its buttons, from under the bow to the blazer's own."""
    drape = Drape(shirt)
    y = np.linspace(top_button_y(tailor) + 0.012, tailor.neck_y - 0.052, rows)
    half = np.minimum(0.0125, 0.8 * opening(tailor, y) + 0.001)
    lines: list[Array] = []
    for share, lift in ((-1.0, 0.0002), (-0.94, 0.0014), (0.0, 0.0016), (0.94, 0.0014), (1.0, 0.0002)):
        at = np.c_[share * half, y, np.full(rows, 0.1)]
        at[:, 2] = [drape.front(x, height)[2] for x, height in at[:, :2]]
        on, out = drape.surface(at)
        lines.append(on + out * lift)
    points = np.stack(lines, axis=1).reshape(-1, 3)
    pieces = [Mesh(points, borrowed_weights(points, shirt), grid_faces(rows, 5))]
    heights: list[float] = np.arange(float(y[-1]) - 0.035, float(y[0]) + 0.02, -0.062).tolist()
    pieces.extend(button(drape, drape.front(0.0, height), SHIRT, 10) for height in heights)
    return joined(pieces)
