"""Drums: shells, hoops with lugs and rods, heads, the snare drum's gear.

Each is made in the drum's own frame: the origin in the middle of the batter head, +Y out of it, −Z toward
the player.
"""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np

from common.turning import Workpiece
from drums import measures as m
from drums.images import HOOP_ROWS

if TYPE_CHECKING:
    from drums.materials import KitMaterials
    from drums.measures import Array, Drum

ROD = 0.0026
LUG_LENGTH = 0.048


def frame(drum: Drum) -> Array:
    """The drum's own frame in the kit's, a matrix."""
    z = -drum.toward_player
    return np.column_stack([np.cross(drum.axis, z), drum.axis, z])


def polar(radius: float, turn: float, y: float = 0.0) -> Array:
    """A point of the drum's frame, turned from the player's side as `Drum.at` turns."""
    return np.array([radius * np.sin(turn), y, -radius * np.cos(turn)])


def outward(turn: float) -> Array:
    """Axes as a matrix's columns: x around the drum, y along it, z out of it."""
    z = polar(1.0, turn)
    y = np.array([0.0, 1.0, 0.0])
    return np.column_stack([np.cross(y, z), y, z])


def shell(detail: float, materials: KitMaterials, drum: Drum) -> Workpiece:
    """The wood, with its vent and badge; what shows of the edges under the hoops is bare."""
    piece = Workpiece(detail)
    r, depth = drum.radius, drum.depth
    sides = piece.facets(72 if drum is m.KICK else 56, 20)
    around = np.linspace(0, 2 * np.pi, sides + 1)
    rows = np.linspace(0, 1, 5)
    out = np.stack([np.sin(around), np.zeros(sides + 1), -np.cos(around)], axis=1)
    heights = -0.003 - rows * (depth - 0.006)
    vertices = r * out[None] + heights[:, None, None] * np.array([0.0, 1.0, 0.0])
    normals = np.broadcast_to(out[None], vertices.shape)
    u, v = np.meshgrid(around / (2 * np.pi) * round(r / 0.1), HOOP_ROWS + 0.01 + rows * (0.98 - HOOP_ROWS))
    index = np.arange(len(rows) * (sides + 1)).reshape(len(rows), sides + 1)
    a, b, c, d = (index[i : i - 1 or None, j : j - 1 or None].ravel() for i in (0, 1) for j in (0, 1))
    faces = np.vstack([np.c_[a, b, c], np.c_[b, d, c]])
    piece.add(
        materials.shell, vertices.reshape(-1, 3), normals.reshape(-1, 3), faces, np.c_[u.ravel(), v.ravel()]
    )
    badge = outward(np.pi if drum is not m.KICK else 0.0)
    at = polar(r, np.pi if drum is not m.KICK else 0.0, -0.38 * depth)
    if detail > 0.5:
        piece.block(materials.bronze, at, (0.030, 0.042, 0.003), 0.001, badge)
        piece.ring(materials.chrome, at + badge[:, 2] * 0.0016, badge[:, 2], 0.005, 0.0014, 16, 6)
    return piece


def head(detail: float, materials: KitMaterials, drum: Drum) -> Workpiece:
    """The batter head: flat out to the bearing edge, then down to the hoop; as the moving node has it."""
    piece = Workpiece(detail)
    r = drum.radius
    rings = np.r_[np.linspace(0.0, r - 0.012, 7), r - 0.004, r + 0.0015, r + 0.0035]
    drop = np.r_[np.zeros(7), -0.0001, -0.0016, -0.0065]
    piece.lathe(materials.skin, [0, 0, 0], [0, 1, 0], np.c_[drop, rings][::-1], 56, smooth=True)
    return piece


def bottom_head(detail: float, materials: KitMaterials, drum: Drum) -> Workpiece:
    """The resonant head; the bass drum's has the picture, with its upper side up."""
    piece = Workpiece(detail)
    y, r = -drum.depth, drum.radius
    if drum is not m.KICK:
        profile = [(y, 0.0), (y, 0.5 * r), (y, r - 0.006), (y + 0.004, r + 0.002)]
        piece.lathe(materials.skin, [0, 0, 0], [0, 1, 0], profile, 40)
        return piece
    sides = piece.facets(72, 24)
    turn = np.linspace(0, 2 * np.pi, sides + 1)
    rings = np.array([0.0, 0.3, 0.6, 0.9, 1.0])
    x, up = np.outer(rings, np.sin(turn)), np.outer(rings, np.cos(turn))
    # In the drum's frame the player's side of this drum lies at its foot, so that up is +Z.
    vertices = np.stack([x * (r + 0.003), np.full_like(x, y), up * (r + 0.003)], axis=2)
    normals = np.broadcast_to([0.0, -1.0, 0.0], vertices.shape)
    index = np.arange(vertices.shape[0] * vertices.shape[1]).reshape(vertices.shape[:2])
    a, b, c, d = (index[i : i - 1 or None, j : j - 1 or None].ravel() for i in (0, 1) for j in (0, 1))
    uv = np.stack([0.5 + x / 2, 0.5 - up / 2], axis=2)
    faces = np.vstack([np.c_[a, b, c], np.c_[b, d, c]])
    piece.add(
        materials.front, vertices.reshape(-1, 3), normals.reshape(-1, 3).copy(), faces, uv.reshape(-1, 2)
    )
    return piece


def metal_hoop(piece: Workpiece, materials: KitMaterials, drum: Drum, head_y: float, sign: float) -> None:
    """A triple-flanged hoop; `sign` is 1 for the batter side, whose flange stands up."""
    out, wall = drum.hoop_radius, m.HOOP_WALL / 2
    low = m.HOOP_OVER - m.HOOP_DEPTH
    profile = [
        (m.HOOP_OVER, out + wall),
        (low + 0.004, out + wall),
        (low + 0.001, out + wall + 0.002),
        (low, out + wall + 0.008),
        (low - 0.0018, out + wall + 0.008),
        (low - 0.0018, out),
        (-0.002, out - wall),
        (m.HOOP_OVER, out - wall),
    ]
    piece.lathe(materials.chrome, [0, head_y, 0], [0, sign, 0], profile, 56)
    piece.ring(materials.chrome, [0, head_y + sign * m.HOOP_OVER, 0], [0, 1, 0], out, m.HOOP_BEAD, 56, 8)


def wooden_hoop(piece: Workpiece, materials: KitMaterials, drum: Drum, head_y: float, sign: float) -> None:
    """The bass drum's hoop: maple, rounded at its edges."""
    out, half, width = drum.hoop_radius, m.KICK_HOOP_THICK / 2, m.KICK_HOOP_WIDTH
    top, round_by = m.KICK_HOOP_OVER, 0.0025
    profile = [
        (top - 0.006, out - half),
        (top - round_by, out - half),
        (top, out - half + round_by),
        (top, out + half - round_by),
        (top - round_by, out + half),
        (top - width + round_by, out + half),
        (top - width, out + half - round_by),
        (top - width, out - half),
    ]
    sides = piece.facets(84, 24)
    turn = np.linspace(0, 2 * np.pi, sides + 1)
    spoke = np.stack([np.sin(turn), np.zeros(sides + 1), -np.cos(turn)], axis=1)
    for k, ((y0, r0), (y1, r1)) in enumerate(itertools.pairwise(profile)):
        normal = spoke * (y0 - y1) + np.array([0.0, sign * (r1 - r0), 0.0])
        normal = normal / np.linalg.norm(normal, axis=1, keepdims=True)
        rings = np.stack([spoke * r + [0, head_y + sign * y, 0] for y, r in ((y0, r0), (y1, r1))])
        u = np.tile(turn / (2 * np.pi) * 3, 2)
        v = np.repeat(np.array([0.2, 0.8]) * HOOP_ROWS * (0.9 if k % 2 else 1.0), sides + 1)
        index = np.arange(2 * (sides + 1)).reshape(2, -1)
        a, b, c, d = index[0, :-1], index[0, 1:], index[1, :-1], index[1, 1:]
        piece.add(
            materials.shell,
            rings.reshape(-1, 3),
            np.vstack([normal, normal]),
            np.vstack([np.c_[a, b, c], np.c_[b, d, c]]),
            np.c_[u, v],
        )


def lug(detail: float, materials: KitMaterials, length: float) -> Workpiece:
    """A lug on a shell: origin on the wood, z out of it, y along the drum; a foot, a body, two sleeves."""
    piece = Workpiece(detail)
    piece.block(materials.chrome, (0, 0, 0.0015), (0.019, 0.9 * length, 0.003), 0.001)
    piece.block(materials.chrome, (0, 0, 0.007), (0.0125, 0.62 * length, 0.012), 0.003)
    ends = [
        (-length / 2, 0.0048),
        (-length / 2 + 0.002, 0.0062),
        (length / 2 - 0.002, 0.0062),
        (length / 2, 0.0048),
    ]
    closed = [(-length / 2, 0.0), *ends, (length / 2, 0.0)]
    piece.lathe(materials.chrome, (0, 0, 0.0125), (0, 1, 0), closed, 12)
    return piece


def lugs_and_hoops(detail: float, materials: KitMaterials, drum: Drum) -> Workpiece:
    """All that is metal on a drum, and the hoops."""
    piece = Workpiece(detail)
    wooden = drum is m.KICK
    bottom = -drum.depth
    for y, sign in ((0.0, 1.0), (bottom, -1.0)):
        (wooden_hoop if wooden else metal_hoop)(piece, materials, drum, y, sign)
    tube = drum is m.SNARE
    length = drum.depth - 0.062 if tube else LUG_LENGTH
    one = lug(detail, materials, length)
    rod_at = drum.radius + 0.0125
    for turn in drum.lug_turns():
        axes = outward(turn)
        places = [bottom / 2] if tube else [-0.052, bottom + 0.052]
        if drum.depth < 0.19 and not tube:
            places = [-0.050, bottom + 0.050]
        for y in places:
            piece.include(one, axes, polar(drum.radius, turn, y))
        for y, sign in ((0.0, 1.0), (bottom, -1.0)):
            over = m.KICK_HOOP_OVER + 0.003 if wooden else m.HOOP_OVER - m.HOOP_DEPTH + 0.001
            top, low = y + sign * over, y - sign * 0.036
            at = rod_at + (0.004 if wooden else 0.0)
            piece.sweep(materials.chrome, np.array([polar(at, turn, low), polar(at, turn, top)]), ROD, 7)
            if wooden:
                claw(piece, materials, drum, turn, y, sign)
            else:
                nut = [(0.0, 0.0062), (0.0014, 0.0062), (0.0016, 0.0042), (0.0100, 0.0036), (0.0100, 0.0)]
                piece.lathe(materials.chrome, polar(at, turn, top), [0, sign, 0], nut, 8)
    return piece


def claw(piece: Workpiece, materials: KitMaterials, drum: Drum, turn: float, y: float, sign: float) -> None:
    """A claw over the wooden hoop, with the rod's key end."""
    axes, out = outward(turn), drum.hoop_radius
    over = y + sign * (m.KICK_HOOP_OVER + 0.0015)
    piece.block(materials.chrome, polar(out + 0.004, turn, over), (0.020, 0.003, 0.024), 0.001, axes)
    piece.block(
        materials.chrome, polar(out + 0.0075, turn, over - sign * 0.018), (0.020, 0.036, 0.005), 0.0015, axes
    )
    key = [(0.0, 0.005), (0.006, 0.005), (0.006, 0.003), (0.012, 0.003), (0.012, 0.0)]
    piece.lathe(materials.chrome, polar(drum.radius + 0.0165, turn, over), [0, sign, 0], key, 8)


def snare_gear(detail: float, materials: KitMaterials, drum: Drum) -> Workpiece:
    """The strainer with its lever, the butt plate, and the wires under the lower head."""
    piece = Workpiece(detail)
    y, r = -drum.depth, drum.radius
    for turn, height in ((0.5 * np.pi, 0.060), (-0.5 * np.pi, 0.040)):
        axes = outward(turn)
        piece.block(
            materials.chrome, polar(r + 0.008, turn, y / 2 - 0.02), (0.026, height, 0.016), 0.004, axes
        )
        piece.block(materials.steel, polar(r + 0.007, turn, y - 0.002), (0.020, 0.030, 0.006), 0.001, axes)
    lever = outward(0.5 * np.pi)
    piece.block(
        materials.chrome, polar(r + 0.022, 0.5 * np.pi, y / 2 + 0.012), (0.010, 0.050, 0.008), 0.003, lever
    )
    if detail > 0.5:
        for k in range(12):
            z = (k - 5.5) * 0.0034
            piece.sweep(
                materials.steel, np.array([[-0.125, y - 0.0016, z], [0.125, y - 0.0016, z]]), 0.0012, 5
            )
    for side in (-1, 1):
        piece.block(materials.chrome, (side * 0.128, y - 0.002, 0), (0.016, 0.003, 0.046), 0.001)
    return piece


def tom_bracket(detail: float, materials: KitMaterials, drum: Drum, turn: float, depth: float) -> Workpiece:
    """The plate on the shell through which the holder's arm or the leg goes."""
    piece = Workpiece(detail)
    axes, r = outward(turn), drum.radius
    piece.block(materials.chrome, polar(r + 0.002, turn, -depth), (0.052, 0.062, 0.004), 0.0015, axes)
    piece.block(materials.chrome, polar(r + 0.014, turn, -depth), (0.030, 0.034, 0.024), 0.005, axes)
    return piece
