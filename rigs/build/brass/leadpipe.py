"""What every wrap has: the leadpipe with its receiver, and a water key."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brass import measures as m
from brass.paths import joined_path, line

if TYPE_CHECKING:
    from brass.measures import Horn
    from brass.metals import Metals
    from brass.paths import Array
    from common.turning import Workpiece

RECEIVER = (
    (0, 0.0056), (0, 0.0074), (0.004, 0.0076), (0.005, 0.0070), (0.030, 0.0066), (0.0345, 0.0072),
    (0.036, 0.0072), (0.0365, 0.0056),
)  # fmt: skip


def leadpipe(body: Workpiece, metals: Metals, horn: Horn, to_z: float) -> None:
    """The tube from the receiver past the valves, widening."""
    x, y = m.X_LEADPIPE, m.Y_TOP
    body.sweep(
        metals.brass,
        line([x, y, horn.receiver + 0.03], [x, y, to_z], 6),
        np.linspace(0.0052, m.TUBE, 6),
    )
    body.lathe(metals.brass, [x, y, horn.receiver], [0, 0, 1], RECEIVER, 36)


def leadpipe_obstacles(horn: Horn, to_z: float) -> list[tuple[Array, float]]:
    """Leadpipe and mouthpiece as paths and their radii."""
    x, y = m.X_LEADPIPE, m.Y_TOP
    return [
        (line([x, y, horn.receiver], [x, y, to_z]), m.TUBE),
        (line([x, y, horn.z_mouthpiece - 0.05], [x, y, horn.receiver]), 0.006),
    ]


def water_key(piece: Workpiece, metals: Metals, key: Array, lever: float = -1.0) -> None:
    """A key under a tube that runs along Z: its cork 8 mm to one side of `key`, its lever to the other.

    `lever` is 1 where it points to the bell.
    """
    along = np.array([0.0, 0.0, -lever])
    drop = np.array([0.0, -0.001, 0.0])
    arm = joined_path(
        line(key + drop + 0.010 * along, key + 3 * drop - 0.008 * along, 6),
        line(key + 3 * drop - 0.008 * along, key + drop - 0.030 * along, 8),
    )
    piece.sweep(metals.brass, arm, 0.0013, 10, caps=True, oval=(1.6, 0.7))
    piece.lathe(
        metals.brass,
        key + np.array([0.0, 0.004, 0.0]) + 0.008 * along,
        [0, -1, 0],
        [(0, 0.0034), (0.006, 0.0034), (0.0062, 0)],
        20,
    )
    hinge = key + drop - 0.006 * along
    side = np.array([0.005, 0.0, 0.0])
    piece.sweep(metals.brass, line(hinge - side, hinge + side), 0.0015, 10, caps=True)
