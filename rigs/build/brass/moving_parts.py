"""A horn's moving parts: slides of the valves, valves and mouthpiece.

All but the valves are made in the instrument's frame.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brass import measures as m
from brass.paths import joined_path, line, u_bend
from common.turning import Workpiece

if TYPE_CHECKING:
    from brass.measures import Horn
    from brass.metals import Metals


def _valve_slide(
    detail: float, metals: Metals, x: float, y: tuple[float, float], z: float, reach: float
) -> Workpiece:
    """A U-shaped slide from z, straight for |reach| less its bow; the sign of `reach` is its direction."""
    piece = Workpiece(detail)
    half, sign = (y[1] - y[0]) / 2, np.sign(reach)
    end = z + reach - sign * half
    bow = u_bend(x, x, y[1], y[0], end, sign * half, piece.facets(36, 12))
    piece.sweep(
        metals.brass, joined_path(line([x, y[1], z], bow[0], 4), bow, line(bow[-1], [x, y[0], z], 4)), m.TUBE
    )
    for height in y:
        piece.ferrule(metals.silver, [x, height, z], [x, height, z + sign * 0.007], m.TUBE + 0.0009)
    return piece


def first_slide(detail: float, metals: Metals) -> Workpiece:
    """With the thumb's saddle."""
    piece = _valve_slide(detail, metals, m.SLIDE1_X, m.SLIDE1_Y, m.SLIDE1_Z, -m.SLIDE1_REACH)
    a = np.linspace(-0.15, np.pi + 0.15, piece.facets(22, 9))
    x, y, z = m.SADDLE
    arch = np.column_stack([np.full(len(a), x), y - m.SADDLE_DEPTH * np.sin(a), z + 0.0118 * np.cos(a)])
    piece.sweep(metals.brass, arch, m.SADDLE_WIRE, 12, caps=True, oval=(2.1, 1))
    return piece


def second_slide(detail: float, metals: Metals) -> Workpiece:
    """The short slide on the right."""
    piece = Workpiece(detail)
    low, high = m.SLIDE2_Y
    middle, half = (low + high) / 2, (high - low) / 2
    a = np.linspace(0, np.pi, piece.facets(30, 10))
    bow = np.column_stack([-0.026 - half * np.sin(a), middle + half * np.cos(a), np.zeros(len(a))])
    piece.sweep(
        metals.brass,
        joined_path(line([-0.022, high, 0], bow[0], 3), bow, line(bow[-1], [-0.022, low, 0], 3)),
        m.TUBE * 0.95,
    )
    piece.ring(metals.brass, [-0.028 - half - m.TUBE, middle, 0], [0, 0, 1], 0.0032, 0.0008, 20, 8)
    return piece


def third_slide(detail: float, metals: Metals) -> Workpiece:
    """With the ring finger's ring on its upper leg."""
    piece = _valve_slide(detail, metals, m.SLIDE3_X, m.SLIDE3_Y, m.SLIDE3_Z, m.SLIDE3_REACH)
    piece.ring(metals.brass, m.RING, [1, 0, 0], m.RING_RADIUS, m.RING_WIRE, 40, 12)
    x, y, z = m.SLIDE3_X, m.SLIDE3_Y[1] + m.TUBE, m.RING[2]
    piece.sweep(metals.brass, line([x, y - 0.001, z], [x, y + 0.0015, z]), 0.003, 12)
    piece.sweep(metals.brass, line([x, m.SLIDE3_Y[0], z + 0.026], [x, m.SLIDE3_Y[1], z + 0.026]), 0.0018, 12)
    return piece


def valve(detail: float, metals: Metals) -> Workpiece:
    """Stem, felt and button, in the valve's own frame."""
    piece = Workpiece(detail)
    base = m.BUTTON_TOP - 0.0042
    # In short steps: the shade ends where it comes out of the casing.
    stem = [(float(y), 0.0030) for y in np.linspace(-0.030, 0.020, 11)]
    piece.lathe(metals.silver, [0, 0, 0], [0, 1, 0], stem, 20)
    piece.lathe(
        metals.felt,
        [0, base - 0.0020, 0],
        [0, 1, 0],
        [(0, 0.0030), (0, 0.0066), (0.002, 0.0066), (0.002, 0.003)],
        28,
    )
    button = [
        (0, 0.003),
        (0, 0.0058),
        (0.0008, 0.0078),
        (0.0022, 0.0085),
        (0.0036, 0.0086),
        (0.0044, 0.0082),
        (0.0046, 0.0074),
    ]
    piece.lathe(metals.silver, [0, base, 0], [0, 1, 0], button, 40)
    piece.lathe(
        metals.pearl,
        [0, base, 0],
        [0, 1, 0],
        [(0.0046, 0.0075), (0.0045, 0.0060), (0.0043, 0.0035), (0.0042, 0.0)],
        40,
        smooth=True,
    )
    return piece


def mouthpiece(detail: float, metals: Metals, horn: Horn) -> Workpiece:
    """Cup, rim and shank."""
    piece, shape = Workpiece(detail), horn.mouthpiece
    at = shape.rim_at
    rim = [(at + 0.0010 * np.sin(a), 0.0108 + 0.0022 * np.cos(a)) for a in np.linspace(0.1, np.pi - 0.3, 12)]
    cup = [
        (
            at - 0.0022 - shape.cup_depth * t,
            0.0084 * (1 - t**shape.cup_shape) ** 0.5 * 0.99 + 0.0019 * t,
        )
        for t in np.linspace(0, 1, 14)
    ]
    origin = [m.X_LEADPIPE, m.Y_TOP, horn.z_mouthpiece]
    piece.lathe(metals.silver, origin, [0, 0, -1], shape.outside, 48, smooth=True)
    piece.lathe(metals.silver, origin, [0, 0, -1], rim + cup, 48, smooth=True)
    return piece
