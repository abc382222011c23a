"""The cowbell, the floor tom's legs, the bass drum's spurs, and a stick."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from common.turning import Workpiece
from drums import measures as m
from drums.drum_pieces import outward, polar
from drums.hardware import UP, tube
from drums.measures import unit

if TYPE_CHECKING:
    from drums.materials import KitMaterials
    from drums.measures import Array, Drum

FLOOR_LEGS = tuple(np.radians([60.0, 180.0, 300.0]))


def rounded(width: float, height: float, corner: float, steps: int) -> tuple[Array, Array]:
    """A rectangle with round corners about the origin: points (K, 2) and normals out of it."""
    turns: Array = np.concatenate(
        [np.linspace(0.5 * np.pi * q, 0.5 * np.pi * (q + 1), steps) for q in range(4)]
    )
    out = np.stack([np.cos(turns), np.sin(turns)], axis=1)
    middle = np.repeat([[1, 1], [-1, 1], [-1, -1], [1, -1]], steps, axis=0)
    points = middle * (np.array([width, height]) / 2 - corner) + corner * out
    return np.vstack([points, points[:1]]), np.vstack([out, out[:1]])


def cowbell(piece: Workpiece, materials: KitMaterials) -> None:
    """Folded sheet: its mouth toward the player, closed behind, with the welded seams at its sides."""
    mouth, back = m.COWBELL_MOUTH, m.COWBELL_BACK
    z = unit(back - mouth)
    x = unit(np.cross(UP, z))
    y = np.cross(z, x)
    steps = piece.facets(6, 2)
    sizes = (m.COWBELL_MOUTH_SIZE, m.COWBELL_BACK_SIZE)

    def ring(share: float, inside: float) -> tuple[Array, Array]:
        width, height = ((1 - share) * np.array(sizes[0]) + share * np.array(sizes[1])) - 2 * inside
        points, out = rounded(width, height, 0.010 + 0.006 * (1 - share) - inside, steps)
        at = mouth + (back - mouth) * share
        return at + points[:, :1] * x + points[:, 1:] * y, out[:, :1] * x + out[:, 1:] * y

    for inside, sign in ((0.0, 1.0), (0.0014, -1.0)):
        rows = [ring(share, inside) for share in (0.0, 0.25, 0.5, 0.75, 1.0)]
        vertices = np.stack([row[0] for row in rows])
        fall = (sizes[1][1] - sizes[0][1]) / 2 / float(np.linalg.norm(back - mouth))
        normals = np.stack([row[1] for row in rows]) - z * fall
        normals = sign * normals / np.linalg.norm(normals, axis=2, keepdims=True)
        piece.sheet(materials.steel, vertices, normals)
    lip = np.stack([ring(0.0, 0.0)[0], ring(0.0, 0.0014)[0]])
    piece.sheet(materials.steel, lip, np.broadcast_to(-z, lip.shape))
    end = np.vstack([back, ring(1.0, 0.0)[0]])
    fan = np.array([[0, n + 1, n + 2] for n in range(len(end) - 2)])
    piece.add(materials.steel, end, np.tile(z, (len(end), 1)), fan)


def floor_legs(piece: Workpiece, materials: KitMaterials, drum: Drum, to_kit: Array) -> None:
    """Three legs of the floor tom, in the drum's frame; `to_kit` is its frame in the kit's."""
    down = to_kit.T @ -UP
    for turn in FLOOR_LEGS:
        axes = outward(turn)
        at = polar(drum.radius + 0.020, turn, -0.16)
        high = at - down * 0.03
        height = float((np.array(drum.centre) + to_kit @ at)[1])
        knee = at + down * (height - 0.075)
        foot = at + down * (height - 0.016) + axes[:, 2] * 0.020
        piece.sweep(materials.chrome, np.array([high, at, knee, foot]), 0.0050, 10, caps=True)
        shoe = [(-0.028, 0.0), (-0.028, 0.008), (-0.006, 0.0115), (0.0, 0.0105), (0.0, 0.0)]
        piece.lathe(materials.rubber, foot + down * 0.016, down, shoe, 12)
        plate = polar(drum.radius + 0.002, turn, -0.20)
        piece.block(materials.chrome, plate, (0.040, 0.062, 0.004), 0.0015, axes)
        piece.block(materials.chrome, plate + axes[:, 2] * 0.014, (0.026, 0.040, 0.024), 0.005, axes)


def spurs(piece: Workpiece, materials: KitMaterials) -> None:
    """The bass drum's two spurs, in the kit's frame: out and forward to the floor."""
    drum = m.KICK
    middle = np.array(drum.centre) + np.array([0.0, 0.0, 0.78 * drum.depth])
    for side in (-1, 1):
        out = unit((side * 0.90, -0.44, 0.0))
        root = middle + out * (drum.radius + 0.012)
        foot = root * [1, 0, 1] + np.array([side * 0.105, 0.014, 0.10])
        tube(piece, materials.chrome, root - (foot - root) * 0.10, foot, 0.0055, 10)
        piece.lathe(
            materials.rubber,
            foot,
            unit(foot - root),
            [(-0.02, 0.0), (-0.02, 0.009), (0.0, 0.0105), (0.012, 0.004), (0.012, 0)],
            12,
        )
        frame = np.column_stack([[0.0, 0.0, 1.0], np.cross(out, [0.0, 0.0, 1.0]), out])
        piece.block(
            materials.chrome, middle + out * (drum.radius + 0.003), (0.055, 0.050, 0.006), 0.002, frame
        )
        piece.block(materials.chrome, root, (0.030, 0.032, 0.026), 0.006, frame)


def stick(detail: float, material: int) -> Workpiece:
    """A 5A stick: origin in the grip, +Z to the tip; a round butt, a long taper, an oval bead."""
    piece = Workpiece(detail)
    butt, tip, r = -m.STICK_BUTT, m.STICK_LENGTH - m.STICK_BUTT, m.STICK_RADIUS
    bead = tip - m.BEAD_LENGTH
    rounds = np.linspace(0, np.pi / 2, piece.facets(7, 3))
    profile = [(butt + 0.006 * (1 - np.cos(a)), r * np.sin(a)) for a in rounds]
    shaft = np.linspace(butt + 0.006, bead - 0.075, piece.facets(5, 3))[1:]
    profile += [(float(z), r) for z in shaft]
    taper = np.linspace(0, 1, piece.facets(8, 4))[1:]
    profile += [(bead - 0.075 + 0.075 * t, r + (0.0029 - r) * (t**1.35)) for t in taper]
    turn: Array = np.linspace(float(np.arcsin(0.0029 / m.BEAD_RADIUS)), np.pi, piece.facets(11, 6))
    middle = bead + m.BEAD_LENGTH / 2
    profile += [
        (middle - 0.5 * m.BEAD_LENGTH * np.cos(a), m.BEAD_RADIUS * np.sin(a) ** 0.92) for a in turn[1:-1]
    ]
    profile.append((tip, 0.0))
    piece.lathe(material, (0, 0, 0), (0, 0, 1), profile, 16, smooth=True)
    return piece
