"""The flugelhorn's wrap: a mouthpipe that slides for tuning, a bow before the valves, and into the third."""

from __future__ import annotations

from typing import TYPE_CHECKING

from brass import measures as m
from brass.leadpipe import RECEIVER, leadpipe_obstacles
from brass.paths import bezier, joined_path, line, u_bend
from common.turning import Workpiece

if TYPE_CHECKING:
    from brass.measures import Horn
    from brass.metals import Metals
    from brass.paths import Array

COLLAR_Z = -0.096  # where the mouthpipe goes into its sleeve
COLLAR = 0.016
PIPE = 0.0054  # its radius
BOW_PIECES = 6


def _way(horn: Horn, bow_points: int, entry_points: int) -> Array:
    """The middle of the tube from the leadpipe's end to the third valve (N, 3)."""
    x, y, z = horn.x_return, horn.y_return, horn.front
    bow = u_bend(m.X_LEADPIPE, x, m.Y_TOP, y, z, horn.front_depth, bow_points)
    third = m.VALVE_Z[2]
    entry = bezier(
        [x, y, z], [x, y, z - 0.014], [-0.004, y, third + 0.020], [0, y, third + 0.006], entry_points
    )
    return joined_path(bow, entry)


def fixed(body: Workpiece, metals: Metals, horn: Horn) -> None:
    """The sleeve with its clamping screw, the leadpipe past the valves and its bow."""
    x, y = m.X_LEADPIPE, m.Y_TOP
    body.sweep(metals.brass, line([x, y, COLLAR_Z], [x, y, horn.front], 6), m.TUBE)
    body.sweep(metals.brass, _way(horn, body.facets(48, 14), body.facets(16, 6)), m.TUBE)
    body.ferrule(metals.silver, [x, y, COLLAR_Z - 0.001], [x, y, COLLAR_Z + COLLAR], m.TUBE + 0.0012)
    # The screw, with a wing to turn it by.
    middle = COLLAR_Z + 0.5 * COLLAR
    body.lathe(
        metals.silver,
        [x, y + m.TUBE, middle],
        [0, 1, 0],
        [(0, 0.0042), (0.003, 0.0042), (0.0032, 0.0020), (0.0085, 0.0020), (0.0087, 0.0)],
        20,
    )
    body.sweep(
        metals.silver,
        line([x, y + m.TUBE + 0.0095, middle - 0.0055], [x, y + m.TUBE + 0.0095, middle + 0.0055], 5),
        0.0030,
        10,
        caps=True,
        oval=(0.5, 1.0),
    )
    for leg_x, leg_y in ((x, y), (horn.x_return, horn.y_return)):
        body.ferrule(
            metals.silver,
            [leg_x, leg_y, horn.front - 0.005],
            [leg_x, leg_y, horn.front + 0.005],
            m.TUBE + 0.0010,
        )


def tuning_slide(detail: float, metals: Metals, horn: Horn) -> Workpiece:
    """The mouthpipe: the receiver and the tube that slides in the sleeve."""
    piece = Workpiece(detail)
    x, y = m.X_LEADPIPE, m.Y_TOP
    piece.lathe(metals.brass, [x, y, horn.receiver], [0, 0, 1], RECEIVER, 36)
    piece.sweep(metals.silver, line([x, y, horn.receiver + 0.03], [x, y, COLLAR_Z + 0.004], 6), PIPE)
    return piece


def obstacles(horn: Horn) -> list[tuple[Array, float]]:
    """Mouthpiece, mouthpipe and leadpipe, the bow and the way into the third valve."""
    return [*leadpipe_obstacles(horn, horn.front), (_way(horn, BOW_PIECES, 4), m.TUBE)]
