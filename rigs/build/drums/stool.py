"""The stool: a round seat on a tripod."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from drums import measures as m
from drums.hardware import UP, lock, tripod, tube
from drums.stands_plan import THRONE_LEGS_DEG, THRONE_REACH, Stand

if TYPE_CHECKING:
    from common.turning import Workpiece
    from drums.materials import KitMaterials


def stool(piece: Workpiece, materials: KitMaterials) -> None:
    """In the kit's frame, under its origin."""
    legs = Stand("stool", (0.0, 0.0), 0.40, (0.0, 0.42, 0.0), THRONE_LEGS_DEG, reach=THRONE_REACH, hub=0.26)
    tripod(piece, materials, legs)
    tube(piece, materials.chrome, UP * 0.07, UP * 0.33, 0.0155)
    tube(piece, materials.chrome, UP * 0.32, UP * 0.41, 0.0120)
    lock(piece, materials, UP * 0.325, UP, 0.0155, 2.6)
    top, thick, radius = m.SEAT_TOP, m.SEAT_THICK, m.SEAT_RADIUS
    turn = np.linspace(0, np.pi / 2, 7)
    soft = 0.030
    over = [(top - soft + soft * np.sin(a), radius - soft + soft * np.cos(a)) for a in turn]
    low = top - thick
    cushion = [(low, 0.0), (low, radius - 0.022), (low + 0.004, radius - 0.012), (low + 0.016, radius), *over]
    cushion += [(top - 0.0015, 0.5 * radius), (top - 0.003, 0.0)]
    piece.lathe(materials.rubber, (0, 0, 0), UP, cushion, 48, smooth=True)
    piece.ring(materials.rubber, (0, top - soft, 0), UP, radius + 0.0005, 0.0022, 56, 8)
    piece.ring(materials.rubber, (0, low + 0.016, 0), UP, radius, 0.0022, 56, 8)
    plate = [(low - 0.018, 0.0), (low - 0.018, 0.030), (low, 0.050), (low, 0.0)]
    piece.lathe(materials.steel, (0, 0, 0), UP, plate, 24)
