"""The trumpet's wrap: a long leadpipe, the tuning slide before the valves, and back into the third."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brass import measures as m
from brass.leadpipe import leadpipe, leadpipe_obstacles, water_key
from brass.paths import joined_path, line, u_bend
from common.turning import Workpiece

if TYPE_CHECKING:
    from brass.measures import Horn
    from brass.metals import Metals
    from brass.paths import Array

BOW_PIECES = 6


def fixed(body: Workpiece, metals: Metals, horn: Horn) -> None:
    """Leadpipe with its receiver, the tube into the third valve, the slide's inner legs."""
    x, y, front = m.X_LEADPIPE, m.Y_TOP, horn.front
    leadpipe(body, metals, horn, front)
    body.sweep(
        metals.brass,
        line([horn.x_return, horn.y_return, front], [0, m.Y_LOW, m.VALVE_Z[2] + 0.008], 4),
        m.TUBE,
    )
    for leg_x, leg_y in ((x, y), (horn.x_return, horn.y_return)):
        body.ferrule(metals.silver, [leg_x, leg_y, 0.110], [leg_x, leg_y, 0.122], m.TUBE + 0.0010)
        body.sweep(metals.silver, line([leg_x, leg_y, 0.12], [leg_x, leg_y, 0.135]), m.TUBE + 0.0001)


def tuning_slide(detail: float, metals: Metals, horn: Horn) -> Workpiece:
    """The main tuning slide with its water key."""
    piece, x, low_x = Workpiece(detail), m.X_LEADPIPE, horn.x_return
    bow = u_bend(x, low_x, m.Y_TOP, m.Y_LOW, 0.158, horn.front_depth, piece.facets(48, 14))
    piece.sweep(
        metals.brass,
        joined_path(line([x, m.Y_TOP, 0.133], bow[0], 4), bow, line(bow[-1], [low_x, m.Y_LOW, 0.133], 4)),
        m.TUBE,
    )
    for leg_x, y in ((x, m.Y_TOP), (low_x, m.Y_LOW)):
        piece.ferrule(metals.silver, [leg_x, y, 0.133], [leg_x, y, 0.141], m.TUBE + 0.0009)
    piece.brace(metals.brass, [x, m.Y_TOP - 0.005, 0.152], [low_x, m.Y_LOW + 0.005, 0.152], 0.0019)
    water_key(piece, metals, np.array([low_x, m.Y_LOW - 0.007, 0.170]))
    return piece


def obstacles(horn: Horn) -> list[tuple[Array, float]]:
    """Leadpipe, mouthpiece, bow, the way back, and the stay between its legs."""
    x, low_x, low = m.X_LEADPIPE, horn.x_return, m.Y_LOW
    return [
        *leadpipe_obstacles(horn, 0.158),
        (u_bend(x, low_x, m.Y_TOP, low, 0.158, horn.front_depth, BOW_PIECES), m.TUBE),
        (line([low_x, low, 0.158], [low_x, low, horn.front]), m.TUBE),
        (line([low_x, low, horn.front], [0, low, m.VALVE_Z[2]]), m.TUBE),
        (line([x, m.Y_TOP, 0.092], [low_x, low, 0.092]), 0.0022),
    ]
