"""The band uniform: blazer, shirt, skirt, tights and shoes, cut from the body's helper surfaces."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from body.joint_names import SIDES
from common.meshes import Mesh, edged, joined, smoothstep
from common.parts import Part, Surface
from dress.hang import hung, lengthened
from dress.seams import BESIDE_EDGE_M, EDGE_M, FRONT_M, Seam, sewn, until
from dress.skirt import PLAIN_PLEAT, PLEAT, skirt
from dress.sleeves import creased, cuffs, fitted, padded, softened

if TYPE_CHECKING:
    from collections.abc import Mapping

    from body.figure_file import Colour
    from dress.tailor import Tailor

    Colours = Mapping[str, Colour]

Array = NDArray[np.float64]

NECKLINE_M = 0.066  # radius of the blazer's neck
NECKLINE_HEIGHT_M = ((0.0, -0.060), (0.9, -0.045), (1.25, -0.012), (1.6, 0.003), (2.2, 0.006), (np.pi, 0.001))
COLLAR_SEAM_M = ((0.0, -0.037), (0.7, -0.026), (1.2, 0.000), (1.6, 0.010), (2.1, 0.010), (np.pi, 0.002))
UNDER_COLLAR_M = 0.028  # how far over the collar's seam the shirt goes on, hidden by the collar
OPENING_M = 0.068  # half the width of the V between the lapels, at the neck
FRONT_EDGE_M = 0.014  # where its fronts overlap, from the middle
BLAZER_SLEEVE = 0.86  # the sleeve ends at this share of the forearm


def top_button_y(tailor: Tailor) -> float:
    """Height of the blazer's top button, metres."""
    return float(tailor.at("upperChest")[1]) - 0.055


def opening(tailor: Tailor, y: Array) -> Array:
    """Half width (N,) of the blazer's V at heights `y`."""
    low, high = top_button_y(tailor), tailor.neck_y - 0.005
    return OPENING_M * np.clip((y - low) / (high - low), 0, 1.3) ** 0.85


def front_edge(tailor: Tailor, y: Array, buttoned: float) -> Array:
    """Where (N,) the upper front ends below the opening, metres from the middle; `buttoned`: which it is."""
    below: Array = np.clip((top_button_y(tailor) - y) / 0.035, 0, 1)
    return buttoned * FRONT_EDGE_M * below


def _above_hips(tailor: Tailor) -> NDArray[np.bool_]:
    tights = tailor.tights
    return (tights.vertices[:, 1] > tailor.at("hips")[1] - 0.10) & (tailor.leg_weight(tights.weights) < 0.97)


def coat(tailor: Tailor, subdivisions: int, buttoned: float) -> Mesh:
    """The blazer's cloth before it is cut: over trunk and arms, with its folds.

    `buttoned`: 1 if its right front lies over the left, as hers does, -1 if the left over the right.
    """
    mesh = hung(tailor, fitted(tailor, tailor.cloth(_above_hips(tailor), 0.013, 22, subdivisions)))
    if subdivisions:
        mesh = creased(tailor, mesh)
    mesh = padded(tailor, softened(tailor, _flare(tailor, _waisted(tailor, mesh))))
    if not subdivisions:
        return mesh
    front = Seam(
        lambda v: v[:, 0] - front_edge(tailor, v[:, 1], buttoned),
        lambda v: until(top_button_y(tailor) - 0.01 - v[:, 1]) * (v[:, 2] > 0.02),
        *FRONT_M,
    )
    return sewn(tailor, mesh, front)


def blazer(
    tailor: Tailor, cloth: Mesh, buttoned: float, *, longer_m: float = 0.0, turned_in: bool = True
) -> Mesh:
    """The coat cut: open in a V to the top button, with a neck, a hem and sleeves to the cuffs.

    `longer_m` more than to the hips; its edges are `turned_in` where they can be seen to be.
    """
    v, w = cloth.vertices, cloth.weights
    hips, chest = tailor.at("hips"), tailor.at("upperChest")
    keep = v[:, 1] - (hips[1] - 0.035) - 0.012 * np.cos(np.arctan2(v[:, 0], v[:, 2]))
    for side, _ in SIDES:
        arm, along = tailor.forearm(v, w, side)
        keep = np.where(arm, np.minimum(keep, (BLAZER_SLEEVE - along) * 0.2), keep)
    button = top_button_y(tailor)
    parted = np.where(v[:, 1] < button - 0.16, (button - 0.16 - v[:, 1]) * 0.25, 0)
    front = v[:, 2] > chest[2] + 0.01
    from_edge = np.abs(v[:, 0] - front_edge(tailor, v[:, 1], buttoned))
    parted = np.maximum(opening(tailor, v[:, 1]), parted)
    keep = np.where(front & (parted > 0), np.minimum(keep, from_edge - parted), keep)
    from_axis = v[:, 2] - neck_axis_z(tailor, v[:, 1])
    around_neck = np.hypot(v[:, 0], from_axis) - NECKLINE_M
    below_neck = tailor.neck_y + neckline_height(np.arctan2(v[:, 0], from_axis)) - v[:, 1]
    keep = np.minimum(keep, np.maximum(around_neck, below_neck))
    if turned_in:  # evenly: along a line of vertices beside the edge
        cloth, keep = cloth.scored(keep - BESIDE_EDGE_M)
        keep = keep + BESIDE_EDGE_M
    cut = cloth.clipped(keep)
    if longer_m:
        cut = lengthened(tailor, cut, longer_m, buttoned * FRONT_EDGE_M)
    return edged(cut, EDGE_M) if turned_in else cut


def neckline_height(angle: Array) -> Array:
    """Height (N,) of the coat's neckline over the neck's joint toward each angle (0 is the front)."""
    return _round_the_neck(NECKLINE_HEIGHT_M, angle)


def collar_seam_height(angle: Array) -> Array:
    """Height (N,) of the shirt collar's seam over the neck's joint toward each angle (0 is the front)."""
    return _round_the_neck(COLLAR_SEAM_M, angle)


def _round_the_neck(heights_m: tuple[tuple[float, float], ...], angle: Array) -> Array:
    """Heights (N,) toward each angle, the same on both sides, of pairs of angle and height."""
    around: Array = np.abs((angle + np.pi) % (2 * np.pi) - np.pi)
    height: Array = np.interp(around, [a for a, _ in heights_m], [height for _, height in heights_m])
    return height


def neck_axis_z(tailor: Tailor, y: Array) -> Array:
    """Depth (N,) of the neck's middle at heights `y`; the neck leans forward."""
    return 0.0205 + 0.37 * np.clip(y - tailor.neck_y, -0.03, 0.06)


def _flare(tailor: Tailor, mesh: Mesh) -> Mesh:
    """Let the blazer's skirt stand away from the hips."""
    v, hips = mesh.vertices, tailor.at("hips")
    outward = np.c_[v[:, 0], np.zeros(len(v)), v[:, 2] - hips[2]]
    torso = tailor.leg_weight(mesh.weights) + tailor.weight_of(mesh.weights, "hips", "spine")
    amount = np.clip((hips[1] + 0.07 - v[:, 1]) / 0.10, 0, 1) * np.minimum(torso, 1) * 0.006 / 0.14
    mesh.vertices = v + outward * amount[:, None]
    return mesh


def _waisted(tailor: Tailor, mesh: Mesh) -> Mesh:
    """Let the cloth fall straighter than the waist under it."""
    v = mesh.vertices
    waist = float(tailor.at("chest")[1]) + 0.02
    arms = np.any([tailor.forearm(v, mesh.weights, side)[0] for side, _ in SIDES], axis=0)
    amount = -0.075 * np.exp(-(((v[:, 1] - waist) / 0.085) ** 2)) * ~arms * (np.abs(v[:, 0]) < 0.2)
    centre = np.array([0.0, 0.0, tailor.at("chest")[2]])
    mesh.vertices = v - (v - centre) * amount[:, None] * [1.0, 0.0, 0.6]
    return mesh


def shirt(tailor: Tailor, subdivisions: int, underlap_m: float) -> Mesh:
    """Only the shirt that shows: the V at the chest, which goes on under the lapels, and the neck.

    It ends under the collar.
    """
    mesh = tailor.cloth(_above_hips(tailor), 0.0032, 4, subdivisions)
    v = mesh.vertices
    turn = np.arctan2(v[:, 0], v[:, 2] - neck_axis_z(tailor, v[:, 1]))
    top = tailor.neck_y + collar_seam_height(turn) + UNDER_COLLAR_M
    keep = np.minimum(v[:, 1] - (tailor.at("hips")[1] + 0.02), top - v[:, 1])
    front = (v[:, 2] > tailor.at("upperChest")[2]) & (v[:, 1] > top_button_y(tailor) - 0.03)
    under_collar = 0.012 * np.clip((v[:, 1] - tailor.neck_y + 0.055) / 0.03, 0, 1)
    shown = np.where(front, opening(tailor, v[:, 1]) + underlap_m - under_collar - np.abs(v[:, 0]), -1.0)
    around_neck = 0.056 - np.hypot(v[:, 0], v[:, 2] - neck_axis_z(tailor, v[:, 1]))
    shown = np.maximum(shown, np.minimum(v[:, 1] - (tailor.neck_y - 0.028), around_neck))
    arms = np.any([tailor.forearm(v, mesh.weights, side)[0] for side, _ in SIDES], axis=0)
    shown = np.where(arms, -1.0, shown)
    return mesh.clipped(np.minimum(keep, shown))


def tights(tailor: Tailor, subdivisions: int) -> Mesh:
    """Cloth close over the legs."""
    mesh, waist = tailor.tights, tailor.at("hips")[1] - 0.09  # under the skirt
    return tailor.cloth(
        (tailor.leg_weight(mesh.weights) > 0.3) & (mesh.vertices[:, 1] < waist), 0.0015, 0, subdivisions
    )


VAMP_M = 0.090  # how far before the ankle her vamp begins
SOLE_M = (0.014, 0.022)  # up to where the sole reaches, and over what height upper and sole meet
WELT_M = (0.010, 0.018)  # how high the sole is at the toes and at the heel
WELT_SEAM_M = (0.0022, 0.0024)
STRAP_M = (0.052, 0.016)  # the strap's middle before the ankle, and its width


def shoes(tailor: Tailor, subdivisions: int, *, vamp_m: float, strap: bool) -> Mesh:
    """Leather shoes with flat soles on the floor: a vamp from `vamp_m` before the ankle, a strap or none."""
    mesh = tailor.cloth(tailor.tights.vertices[:, 1] < 0.12, 0.007, 10, subdivisions)
    v = mesh.vertices
    before = v[:, 2] - tailor.at("leftFoot")[2]
    over_heel = 0.066 - v[:, 1]
    over_toes = 0.050 - v[:, 1] - 0.10 * np.clip(before - 0.03, 0, 0.1)
    behind = smoothstep((0.024 - before) / 0.024)
    keep = np.maximum(over_heel * behind + over_toes * (1 - behind), before - vamp_m)
    if strap:
        keep = np.maximum(keep, 0.5 * STRAP_M[1] - np.abs(before - STRAP_M[0]))
    mesh = mesh.clipped(keep)
    # Only the sole comes down to the floor: the upper stays over the foot.
    height = mesh.vertices[:, 1]
    low = 1 - smoothstep((height - SOLE_M[0]) / SOLE_M[1])
    mesh.vertices[:, 1] = np.maximum(height - 0.0105 * low, 0.0)
    if not subdivisions:
        return mesh
    # The welt: higher at the heel, where the sole is thicker.
    ankle = float(tailor.at("leftFoot")[2])
    return Seam(
        lambda v: v[:, 1] - WELT_M[0] - (WELT_M[1] - WELT_M[0]) * smoothstep((ankle + 0.03 - v[:, 2]) / 0.04),
        lambda v: np.ones(len(v)),
        *WELT_SEAM_M,
    ).into(mesh)


def shirt_surface(colours: Colours) -> Surface:
    """The shirt's cotton."""
    return Surface("shirt", 0.75, colour=colours["shirt"], both_sides=True, shade=(0.50, 0.50, 0.56))


def shirt_part(tailor: Tailor, subdivisions: int, colours: Colours, underlap_m: float = 0.022) -> Part:
    """What shows of the shirt, with its cuffs."""
    cloth = joined([shirt(tailor, subdivisions, underlap_m), cuffs(tailor, 20 + 12 * subdivisions)])
    return Part("Shirt", cloth, shirt_surface(colours))


def shoes_part(tailor: Tailor, subdivisions: int, colours: Colours, *, vamp_m: float, strap: bool) -> Part:
    """The shoes."""
    surface = Surface("shoes", 0.28, colour=colours["shoes"], both_sides=True)
    return Part("Shoes", shoes(tailor, subdivisions, vamp_m=vamp_m, strap=strap), surface)


def uniform_parts(
    tailor: Tailor, subdivisions: int, skirt_rows: int, outer: Mesh, colours: Colours
) -> list[Part]:
    """All cloth but the trimmings; `outer` is the blazer, cut beforehand because trimmings lie on it."""
    pleated, stripes = skirt(tailor, outer, skirt_rows, PLEAT if subdivisions else PLAIN_PLEAT)
    return [
        shirt_part(tailor, subdivisions, colours),
        Part("Blazer", outer, Surface("blazer", 0.82, colour=colours["coat"], both_sides=True)),
        Part(
            "Skirt",
            pleated,
            Surface("skirt", 0.85, colour=colours["legs"], both_sides=True),
        ),
        Part("Hem", stripes, Surface("piping", 0.7, colour=colours["piping"], both_sides=True)),
        Part("Tights", tights(tailor, subdivisions), Surface("tights", 0.55, colour=colours["tights"])),
        shoes_part(tailor, subdivisions, colours, vamp_m=VAMP_M, strap=True),
    ]
