"""The cornet's wrap: a bow before the valves, back on the right, the tuning slide behind them, and forward.

The tube passes the valves three times, so that the horn is short.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brass import measures as m
from brass.leadpipe import leadpipe, leadpipe_obstacles, water_key
from brass.paths import bezier, joined_path, line, u_bend
from common.turning import Workpiece

if TYPE_CHECKING:
    from brass.measures import Horn
    from brass.metals import Metals
    from brass.paths import Array

SLIDE_Z = -0.052  # where the tuning slide's legs begin, behind the valves
SLIDE_BOW_Z = -0.078
DROP = 0.020  # from the leg that goes back to the one that goes forward
ENTRY_Z = 0.004  # where the last leg begins to turn into the third valve
BOW_PIECES = 6


def _front_bow(horn: Horn, points: int) -> Array:
    x, low = horn.x_return, horn.y_return
    return u_bend(m.X_LEADPIPE, x, m.Y_TOP, low, horn.front, horn.front_depth, points)


def _slide_bow(horn: Horn, points: int) -> Array:
    x, y = horn.x_return, horn.y_return
    return u_bend(x, x, y, y - DROP, SLIDE_BOW_Z, -0.5 * DROP, points)


def _last_leg(horn: Horn, points: int) -> Array:
    x, y = horn.x_return, horn.y_return - DROP
    into = bezier(
        [x, y, ENTRY_Z], [x, y, 0.018], [-0.016, y, m.VALVE_Z[2]], [-0.006, y, m.VALVE_Z[2]], points
    )
    return joined_path(line([x, y, SLIDE_Z], [x, y, ENTRY_Z], 4), into)


def fixed(body: Workpiece, metals: Metals, horn: Horn) -> None:
    """Leadpipe, front bow, both legs beside the valves, and the inner legs of the tuning slide."""
    x, y, front = horn.x_return, horn.y_return, horn.front
    leadpipe(body, metals, horn, front)
    bow = _front_bow(horn, body.facets(48, 14))
    body.sweep(metals.brass, joined_path(bow, line(bow[-1], [x, y, SLIDE_Z], 6)), m.TUBE)
    body.sweep(metals.brass, _last_leg(horn, body.facets(20, 8)), m.TUBE)
    for leg_x, leg_y in ((m.X_LEADPIPE, m.Y_TOP), (x, y)):
        body.ferrule(
            metals.silver, [leg_x, leg_y, front - 0.006], [leg_x, leg_y, front + 0.006], m.TUBE + 0.0010
        )
    for leg_y in (y, y - DROP):
        body.ferrule(metals.silver, [x, leg_y, SLIDE_Z - 0.002], [x, leg_y, SLIDE_Z + 0.010], m.TUBE + 0.0010)
        body.sweep(metals.silver, line([x, leg_y, SLIDE_Z], [x, leg_y, SLIDE_Z - 0.013]), m.TUBE + 0.0001)
    for z in (m.VALVE_Z[0], m.VALVE_Z[1]):
        body.brace(metals.brass, [x + 0.005, y - DROP, z], [-0.009, y - DROP, z], 0.0022)
    body.brace(metals.brass, [x, y - 0.005, 0.006], [x, y - DROP + 0.005, 0.006], 0.0019)


def tuning_slide(detail: float, metals: Metals, horn: Horn) -> Workpiece:
    """The main tuning slide behind the valves, with its water key."""
    piece, x, y = Workpiece(detail), horn.x_return, horn.y_return
    begin, bow = SLIDE_Z - 0.011, _slide_bow(horn, piece.facets(40, 14))
    piece.sweep(
        metals.brass,
        joined_path(line([x, y, begin], bow[0], 4), bow, line(bow[-1], [x, y - DROP, begin], 4)),
        m.TUBE,
    )
    for leg_y in (y, y - DROP):
        piece.ferrule(metals.silver, [x, leg_y, begin], [x, leg_y, begin - 0.007], m.TUBE + 0.0009)
    water_key(piece, metals, np.array([x, y - DROP - 0.007, SLIDE_BOW_Z + 0.002]), 1.0)
    # A ring to pull it by.
    piece.ring(
        metals.brass,
        [x, y - 0.5 * DROP, SLIDE_BOW_Z - 0.5 * DROP - m.TUBE - 0.002],
        [1, 0, 0],
        0.0032,
        0.0008,
        20,
        8,
    )
    return piece


def obstacles(horn: Horn) -> list[tuple[Array, float]]:
    """Leadpipe, mouthpiece, both bows and the legs between."""
    x, y = horn.x_return, horn.y_return
    return [
        *leadpipe_obstacles(horn, horn.front),
        (_front_bow(horn, BOW_PIECES), m.TUBE),
        (line([x, y, horn.front], [x, y, SLIDE_BOW_Z]), m.TUBE),
        (_slide_bow(horn, BOW_PIECES), m.TUBE),
        (line([x, y - DROP, SLIDE_BOW_Z], [x, y - DROP, SLIDE_Z]), m.TUBE),
        (_last_leg(horn, BOW_PIECES), m.TUBE),
    ]
