"""How a coat hangs: across what lies between the parts of the body that carry it, it goes straight."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from body.joint_names import SIDES
from common.meshes import Mesh, border_edges, on_border, smoothstep
from dress.sleeves import ARM_PARTS

if TYPE_CHECKING:
    from dress.tailor import Tailor

Array = NDArray[np.float64]

SLICE_M = 0.008
ANGLES = 180
SOFT = (2.0, 2.0)  # slices and angles over which radii are eased
FADE_M = ((-0.05, 0.05), (0.08, 0.18))  # over the upper chest's joint, in front and behind: where it ends

LONGER_ROWS = 6
CUTAWAY_M = (0.034, 0.022, 0.10)  # how far the fronts part at the hem, how far they rise, and over what width
LONGER_FLARE = 0.08  # outward for each metre down


def hung(tailor: Tailor, mesh: Mesh) -> Mesh:
    """The coat with its trunk spanned over the hollows of back, seat and front, slice by slice."""
    v = mesh.vertices
    arms = tailor.weight_of(mesh.weights, *(f"{side}{part}" for side, _ in SIDES for part in ARM_PARTS))
    trunk = arms < 0.25
    centre_z = float(tailor.at("chest")[2])
    chest = float(tailor.at("upperChest")[1])
    heights: Array = np.arange(float(v[:, 1].min()), chest + FADE_M[1][1] + SLICE_M, SLICE_M)
    angles: Array = np.linspace(-np.pi, np.pi, ANGLES, endpoint=False)
    radii = _soft(np.array([_span(v[trunk], float(y), centre_z, angles) for y in heights]))
    turn = np.arctan2(v[:, 0], v[:, 2] - centre_z)
    own = np.hypot(v[:, 0], v[:, 2] - centre_z)
    wide = _between(radii, (v[:, 1] - heights[0]) / SLICE_M, (turn + np.pi) / (2 * np.pi) * ANGLES)
    back = 0.5 - 0.5 * np.cos(turn)
    begins = chest + FADE_M[0][0] + (FADE_M[1][0] - FADE_M[0][0]) * back
    ends = chest + FADE_M[0][1] + (FADE_M[1][1] - FADE_M[0][1]) * back
    share = smoothstep((ends - v[:, 1]) / (ends - begins)) * smoothstep((0.5 - arms) / 0.5)
    grow = 1 + share * np.maximum(wide / np.maximum(own, 1e-6) - 1, 0)
    mesh.vertices = np.c_[v[:, 0] * grow, v[:, 1], centre_z + (v[:, 2] - centre_z) * grow]
    return mesh


def lengthened(tailor: Tailor, coat: Mesh, by_m: float, front_x: float) -> Mesh:
    """The coat carried on below its hem: straight down, or out where the legs are wider.

    Its fronts part at `front_x`.
    """
    v, count = coat.vertices, len(coat.vertices)
    hips = tailor.at("hips")
    edges = border_edges(coat.faces)
    low = v[:, 1] < float(hips[1]) + 0.03
    front = np.abs(v[:, 0]) < 0.03
    hem_y = float(v[low & on_border(count, coat.faces) & ~front, 1].max())
    edges = edges[(v[edges, 1] < hem_y + 0.001).all(axis=1) & low[edges].all(axis=1)]
    rim, place = np.unique(edges.ravel(), return_inverse=True)
    a, b = place.reshape(-1, 2).T
    angles: Array = np.linspace(-np.pi, np.pi, ANGLES, endpoint=False)
    centre_z = float(tailor.at("chest")[2])
    legs = tailor.tights.vertices
    offset = v[rim] - [0.0, 0.0, centre_z]
    turn, reach = np.arctan2(offset[:, 0], offset[:, 2]), np.hypot(offset[:, 0], offset[:, 2])
    column = (turn + np.pi) / (2 * np.pi) * ANGLES

    def legs_reach(y: float) -> Array:
        eased = _soft(_span(legs, y, centre_z, angles))
        return _between(np.stack([eased, eased]), np.zeros(len(rim)), column)

    base = legs_reach(hem_y)
    # The fronts part below the last button, with round corners.
    from_parting = v[rim, 0] - front_x
    nearby = np.clip(1 - np.abs(from_parting) / CUTAWAY_M[2], 0, 1) * (offset[:, 2] > 0)
    beside = np.sign(from_parting) * nearby
    vertices, weights, faces = [v], [coat.weights], [coat.faces]
    last = rim
    for row in range(1, LONGER_ROWS + 1):
        drop = by_m * row / LONGER_ROWS
        radius = reach + np.maximum(legs_reach(hem_y - drop) - base, 0) + LONGER_FLARE * drop
        away = CUTAWAY_M[0] * beside * (drop / by_m) ** 1.6
        rise = CUTAWAY_M[1] * np.abs(beside) ** 3 * (drop / by_m) ** 2
        vertices.append(
            np.c_[np.sin(turn) * radius + away, v[rim, 1] - drop + rise, centre_z + np.cos(turn) * radius]
        )
        weights.append(coat.weights[rim])
        new = count + np.arange(len(rim))
        count += len(rim)
        faces += [np.c_[last[b], last[a], new[a]], np.c_[last[b], new[a], new[b]]]
        last = new
    return Mesh(np.vstack(vertices), np.vstack(weights), np.vstack(faces))


def _span(points: Array, y: float, centre_z: float, angles: Array) -> Array:
    """Radii (A,) toward each angle of the band drawn tight round the points near a height."""
    near = points[np.abs(points[:, 1] - y) < 1.5 * SLICE_M]
    outward = np.stack([np.sin(angles), np.cos(angles)], axis=1)
    # The band touches no point's far side: toward each normal it is as far out as the furthest point.
    support = (outward @ np.stack([near[:, 0], near[:, 2] - centre_z])).max(axis=1)
    toward = outward @ outward.T
    reach = np.where(toward > 0.05, support[:, None] / np.maximum(toward, 0.05), np.inf)
    radii: Array = reach.min(axis=0)
    return radii


def _soft(radii: Array) -> Array:
    """Radii (…, A) eased round and, if there are several slices, from slice to slice."""
    width = SOFT[-radii.ndim :]
    mode = ("nearest", "wrap")[-radii.ndim :]
    eased: Array = cast("Any", ndimage).gaussian_filter(radii, width, mode=mode)
    return eased


def _between(table: Array, row: Array, column: Array) -> Array:
    """The table's values (N,) between rows and, round and round, between columns."""
    row = np.clip(row, 0, len(table) - 1.001)
    i, j = row.astype(int), column.astype(int)
    s, t = row - i, column - j
    count = table.shape[1]
    j, after = j % count, (j + 1) % count
    low: Array = table[i, j] * (1 - t) + table[i, after] * t
    high: Array = table[i + 1, j] * (1 - t) + table[i + 1, after] * t
    return low * (1 - s) + high * s
