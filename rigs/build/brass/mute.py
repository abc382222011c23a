"""A straight mute: a spun cone of aluminium, closed at its wide end, held by three strips of cork.

Made in the instrument's frame, where it stands in the bell; the parameter `<horn>/mute` shows it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from common.turning import Workpiece

if TYPE_CHECKING:
    from brass.measures import Horn
    from brass.metals import Metals

# Place along the axis from the bell's end (positive outside) and radius on a trumpet; clear of the bell by a
# millimetre.
WALL = (
    (-0.105, 0.0085), (-0.105, 0.0108), (-0.090, 0.0118), (-0.070, 0.0142), (-0.050, 0.0180),
    (-0.030, 0.0236), (-0.010, 0.0308), (0.010, 0.0382), (0.026, 0.0440), (0.031, 0.0455),
)  # fmt: skip
END = ((0.031, 0.0455), (0.0335, 0.0460), (0.0350, 0.0450), (0.0352, 0.0430))
BOTTOM = ((0.0352, 0.0430), (0.0332, 0.0400), (0.0326, 0.0300), (0.0330, 0.0150), (0.0332, 0.0))
CORK_FROM, CORK_TO = -0.094, -0.052


def wall_radius(place: float) -> float:
    """The cone's outer radius at a place along the bell's axis, metres from the bell's end."""
    return float(np.interp(place, [z for z, _ in WALL[1:]], [r for _, r in WALL[1:]]))


def straight_mute(detail: float, metals: Metals, horn: Horn) -> Workpiece:
    """Cone, bottom and corks."""
    piece, width = Workpiece(detail), horn.mute_width
    origin, axis = [horn.bell.x, horn.bell.y, horn.bell.end], [0, 0, 1]
    for profile in (WALL, END, BOTTOM):
        wide = [(place, radius * width) for place, radius in profile]
        piece.lathe(metals.aluminium, origin, axis, wide, 48, smooth=True)
    places = np.linspace(CORK_FROM, CORK_TO, piece.facets(9, 4))
    # Each cork fills what is between the cone and the bell.
    inner = width * np.array([wall_radius(float(z)) for z in places])
    outer = np.array([horn.bell_radius(float(-z)) - 0.0008 for z in places])
    for angle in np.deg2rad([90.0, 210.0, 330.0]):
        spoke = np.array([np.cos(angle), np.sin(angle), 0.0])
        middle = 0.5 * (inner + outer)
        path = np.array(origin) + middle[:, None] * spoke + places[:, None] * np.array([0.0, 0.0, 1.0])
        piece.sweep(metals.cork, path, 0.5 * (outer - inner) + 0.0004, 10, caps=True)
    return piece
