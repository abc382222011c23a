"""Pedals: boards on their hinges, the bass drum's beater with its chain, the hi-hat's rod and clutch."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from common.turning import Workpiece
from drums import measures as m
from drums.hardware import UP, tilter, tube
from drums.measures import unit

if TYPE_CHECKING:
    from drums.materials import KitMaterials
    from drums.measures import Array, Pedal

RIBS = 9
LINK = 0.0046
"""From one link's middle to the next's."""
FRAME_HALF = 0.058
"""Half of the width between a bass drum pedal's two posts."""


def board(detail: float, materials: KitMaterials, pedal: Pedal) -> Workpiece:
    """The footboard in its own frame: origin in the hinge, +Z along it, +Y out of its top."""
    piece = Workpiece(detail)
    length, half, top = pedal.length, pedal.half_width, m.BOARD_TOP
    share = np.linspace(0.035, 1.0, 15)
    width = half * (0.80 + 0.22 * np.sin(np.pi * np.clip(share * 0.92, 0, 1)) ** 0.8)
    width *= np.sqrt(np.clip((1.03 - share) / 0.12, 0.12, 1))
    z = share * length
    bevel = 0.0016
    rows: list[Array] = []
    normals: list[Array] = []
    # Across the board: under one edge, up its side, over the bevel, the top, and down again.
    section = [
        (-1.0, -0.008, -1.0, 0.0),
        (-1.0, top - bevel, -1.0, 0.0),
        (-1.0 + 0.035, top, 0.0, 1.0),
        (0.0, top, 0.0, 1.0),
        (1.0 - 0.035, top, 0.0, 1.0),
        (1.0, top - bevel, 1.0, 0.0),
        (1.0, -0.008, 1.0, 0.0),
    ]
    for across, y, nx, ny in section:
        rows.append(np.stack([across * width, np.full_like(z, y), z], axis=1))
        normals.append(np.tile([nx, ny, 0.0], (len(z), 1)))
    vertices, out = np.stack(rows), np.stack(normals)
    index = np.arange(vertices.shape[0] * vertices.shape[1]).reshape(vertices.shape[:2])
    a, b, c, d = (index[i : i - 1 or None, j : j - 1 or None].ravel() for i in (0, 1) for j in (0, 1))
    faces = np.vstack([np.c_[a, b, c], np.c_[b, d, c]])
    piece.add(materials.steel, vertices.reshape(-1, 3), out.reshape(-1, 3), faces)
    under = np.array([[s * w, -0.002, at] for s in (-1, 1) for w, at in zip(width, z, strict=True)])
    ends = np.arange(len(z) - 1)
    flat = np.vstack(
        [np.c_[ends, ends + 1, ends + len(z)], np.c_[ends + 1, ends + 1 + len(z), ends + len(z)]]
    )
    piece.add(materials.steel, under, np.tile([0.0, -1.0, 0.0], (len(under), 1)), flat)
    # Raised ribs, on which a sole holds.
    for k in range(RIBS if detail > 0.5 else 0):
        at = length * (0.22 + 0.62 * k / (RIBS - 1))
        wide = float(np.interp(at, z, width)) * 1.36
        piece.block(materials.chrome, (0, top + 0.0002, at), (wide, 0.0016, 0.0042), 0.0007)
    tube(piece, materials.chrome, np.array([-half * 0.8, 0, 0]), np.array([half * 0.8, 0, 0]), 0.0045, 10)
    tube(
        piece,
        materials.chrome,
        np.array([-0.012, -0.004, 0.985 * length]),
        np.array([0.012, -0.004, 0.985 * length]),
        0.004,
        8,
    )
    return piece


def heel_plate(piece: Workpiece, materials: KitMaterials, pedal: Pedal) -> None:
    """The plate on the floor behind the hinge, in the kit's frame."""
    x = unit(np.cross(UP, pedal.ahead))
    axes = np.column_stack([x, UP, pedal.ahead])
    middle = pedal.hinge * [1, 0, 1] - pedal.ahead * 0.043
    piece.block(materials.steel, middle + UP * 0.014, (0.078, 0.014, 0.074), 0.003, axes)
    piece.block(materials.chrome, middle + UP * 0.0218, (0.050, 0.0016, 0.046), 0.0006, axes)
    for side in (-1, 1):
        at = pedal.hinge + x * side * 0.037
        piece.block(materials.steel, at - UP * 0.006, (0.006, 0.026, 0.022), 0.002, axes)
        piece.block(
            materials.rubber,
            at * [1, 0, 1] + UP * 0.0035 - pedal.ahead * 0.03,
            (0.014, 0.007, 0.05),
            0.002,
            axes,
        )


def beater(detail: float, materials: KitMaterials) -> Workpiece:
    """Felt on a rod, its hub, and the sprocket with the chain that lies on it; +Y to the felt."""
    piece = Workpiece(detail)
    reach, half = m.BEATER_REACH, m.BEATER_HALF
    tube(piece, materials.chrome, np.array([0, -0.012, 0.0]), np.array([0, reach - 0.006, 0.0]), 0.0031, 10)
    x = np.array([1.0, 0.0, 0.0])
    # A felt drum lying across, flattened where it strikes.
    across = 0.020
    profile = [
        (-across, 0.0),
        (-across, half - 0.006),
        (-across + 0.002, half - 0.002),
        (-across + 0.006, half),
        (across - 0.006, half),
        (across - 0.002, half - 0.002),
        (across, half - 0.006),
        (across, 0.0),
    ]
    piece.lathe(materials.felt, [0, reach, 0], x, profile, 32)
    cap = [(-across - 0.0008, 0.0), (-across - 0.0008, 0.007), (-across + 0.001, 0.007)]
    for sign in (-1, 1):
        piece.lathe(materials.chrome, [0, reach, 0], x * sign, [(-a, r) for a, r in cap], 12)
    hub = [(-0.009, 0.0), (-0.009, 0.009), (0.009, 0.009), (0.009, 0.0)]
    piece.lathe(materials.chrome, [0, 0, 0], x, hub, 16)
    piece.block(materials.chrome, (0, 0.012, 0), (0.012, 0.020, 0.012), 0.003)
    tube(piece, materials.chrome, x * -FRAME_HALF, x * FRAME_HALF, 0.0046, 10)
    radius = m.SPROCKET
    plate = [(-0.0016, 0.010), (-0.0016, radius - 0.006), (0.0016, radius - 0.006), (0.0016, 0.010)]
    for side in (-1, 1):
        piece.lathe(materials.steel, x * side * 0.0062, x, plate, 30)
    # The chain on the sprocket: it leaves toward the drum, wherever the beater is.
    start = -np.radians(m.BEATER_REST_DEG)
    for k in range(int(1.45 * radius / LINK)):
        turn = start - 0.16 + k * LINK / radius
        at = np.array([0.0, np.sin(turn), np.cos(turn)]) * (radius - 0.002)
        link(piece, materials, at, np.array([0.0, np.cos(turn), -np.sin(turn)]), k)
    spring = np.array([0.048, 0.0, 0.0])
    piece.block(materials.chrome, (spring[0], -0.004, -0.012), (0.006, 0.012, 0.030), 0.002)
    return piece


def link(piece: Workpiece, materials: KitMaterials, at: Array, along: Array, number: int) -> None:
    """One link of a roller chain: two side plates, closer together in every second one."""
    if piece.detail < 0.5:
        if number % 3 == 0:
            axes = np.column_stack([[1.0, 0.0, 0.0], along, np.cross([1.0, 0.0, 0.0], along)])
            piece.block(materials.chrome, at, (0.0085, 3 * LINK, 0.005), 0.001, axes)
        return
    axes = np.column_stack([[1.0, 0.0, 0.0], along, np.cross([1.0, 0.0, 0.0], along)])
    gap = 0.0030 if number % 2 else 0.0042
    for side in (-1, 1):
        piece.block(
            materials.chrome, at + axes[:, 0] * side * gap, (0.0011, 1.45 * LINK, 0.0046), 0.0005, axes
        )
    tube(piece, materials.steel, at - axes[:, 0] * 0.003, at + axes[:, 0] * 0.003, 0.0017, 6)


def board_chain(piece: Workpiece, materials: KitMaterials) -> None:
    """The chain from the bass drum's board up to the sprocket, in the board's frame."""
    pedal = m.KICK_PEDAL
    low = np.array([0.0, 0.0, 0.985 * pedal.length])
    top = pedal.rotation.T @ (m.AXLE + np.array([0.0, 0.010, m.SPROCKET - 0.002]) - pedal.hinge)
    length = float(np.linalg.norm(top - low))
    along = unit(top - low)
    for k in range(int(length / LINK)):
        link(piece, materials, low + along * (k + 0.5) * LINK, along, k)


def kick_frame(piece: Workpiece, materials: KitMaterials) -> None:
    """The bass drum pedal's base, posts, hoop clamp and spring, in the kit's frame."""
    pedal, axle = m.KICK_PEDAL, m.AXLE
    heel_plate(piece, materials, pedal)
    x = np.array([1.0, 0.0, 0.0])
    z0 = float(pedal.hinge[2])
    piece.block(
        materials.steel, (axle[0], 0.005, (z0 + axle[2]) / 2), (0.072, 0.008, axle[2] - z0 + 0.10), 0.002
    )
    for side in (-1, 1):
        foot = np.array([axle[0] + side * FRAME_HALF, 0.012, axle[2]])
        top = axle + x * side * FRAME_HALF
        piece.block(
            materials.chrome, (foot + top) / 2, (0.013, top[1] - 0.012, 0.022), 0.003, taper=(1.0, 0.8)
        )
        ball = [(-0.009, 0.0), (-0.009, 0.012), (0.009, 0.012), (0.009, 0.0)]
        piece.lathe(materials.chrome, top, x, ball, 18)
        piece.block(materials.steel, foot, (0.024, 0.018, 0.040), 0.004)
    piece.block(materials.steel, (axle[0], 0.010, axle[2] + 0.010), (2 * FRAME_HALF, 0.012, 0.036), 0.003)
    hoop_low = m.KICK.centre[1] - m.KICK.hoop_radius
    z = m.KICK.centre[2] - m.KICK_HOOP_OVER + 0.014
    piece.block(materials.steel, (axle[0], hoop_low - 0.010, z - 0.012), (0.046, 0.010, 0.060), 0.003)
    piece.block(materials.steel, (axle[0], hoop_low + 0.010, z), (0.030, 0.008, 0.022), 0.003)
    tube(
        piece,
        materials.chrome,
        np.array([axle[0] + 0.03, hoop_low - 0.02, z - 0.030]),
        np.array([axle[0] + 0.03, hoop_low + 0.028, z - 0.030]),
        0.0042,
        8,
    )
    # The spring hangs beside the right post, from the axle's rocker to the base.
    at = axle + x * -0.048
    helix(
        piece,
        materials,
        at - UP * 0.016 - [0, 0, 0.024],
        at * [1, 0, 1] + UP * 0.052 - [0, 0, 0.024],
        0.0058,
        11,
    )
    tube(
        piece,
        materials.chrome,
        at * [1, 0, 1] + UP * 0.012 - [0, 0, 0.024],
        at * [1, 0, 1] + UP * 0.054 - [0, 0, 0.024],
        0.0028,
        8,
    )


def helix(
    piece: Workpiece, materials: KitMaterials, top: Array, low: Array, radius: float, turns: int
) -> None:
    """A coil spring; a plain tube where detail is low."""
    if piece.detail < 0.5:
        tube(piece, materials.steel, top, low, radius, 8)
        return
    t = np.linspace(0, 1, turns * 9)
    turn = 2 * np.pi * turns * t
    path = top + (low - top) * t[:, None]
    path = path + radius * np.stack([np.cos(turn), np.zeros_like(t), np.sin(turn)], axis=1)
    piece.sweep(materials.chrome, path, 0.0011, 5)


def hat_base(piece: Workpiece, materials: KitMaterials) -> None:
    """What of the hi-hat's pedal stands still: heel plate, bars to the stand, the frame around the toe."""
    pedal = m.HAT_PEDAL
    heel_plate(piece, materials, pedal)
    x = unit(np.cross(UP, pedal.ahead))
    rod = np.array([m.HAT_X, 0.0, m.HAT_Z])
    for side in (-1, 1):
        near = pedal.hinge * [1, 0, 1] + x * side * 0.036 + UP * 0.010
        far = rod + x * side * 0.036 + UP * 0.010
        tube(piece, materials.chrome, near, far, 0.0038, 8)
        piece.sweep(
            materials.chrome,
            np.array([far, far + UP * 0.10, rod + x * side * 0.012 + UP * 0.20]),
            0.0050,
            8,
            caps=True,
        )
    axes = np.column_stack([x, UP, pedal.ahead])
    piece.block(materials.steel, rod + UP * 0.008, (0.086, 0.014, 0.026), 0.004, axes)


def hat_moving(detail: float, materials: KitMaterials) -> Workpiece:
    """The rod, clutch and felts that go up and down with the upper cymbal, in its frame."""
    piece = Workpiece(detail)
    low = 0.46 - m.HI_HAT_TOP.pivot[1]
    tube(piece, materials.chrome, np.array([0, low, 0.0]), np.array([0, 0.185, 0.0]), 0.0031, 10)
    y = np.array([0.0, 1.0, 0.0])
    for profile in (
        [(-0.0108, 0.0), (-0.0108, 0.0090), (-0.0064, 0.0100), (-0.0064, 0.003)],
        [(0.0105, 0.0), (0.0105, 0.0130), (0.0135, 0.0140), (0.0165, 0.0130), (0.0165, 0.0)],
        [(0.0170, 0.0), (0.0170, 0.0100), (0.0540, 0.0100), (0.0560, 0.0080), (0.0560, 0.0)],
    ):
        piece.lathe(materials.chrome, (0, 0, 0), y, profile, 20)
    for low_y, high_y in ((-0.0064, -0.0018), (0.0006, 0.0105)):
        profile = [
            (low_y, 0.004),
            (low_y, 0.014),
            (low_y + 0.001, 0.0155),
            (high_y - 0.001, 0.0155),
            (high_y, 0.014),
            (high_y, 0.004),
        ]
        piece.lathe(materials.felt, (0, 0, 0), y, profile, 18)
    tilter(piece, materials, np.array([0.0, 0.044, 0.0]), y, small=True)
    return piece
