"""Where each piece is struck: points of its surface with the way out, and how far off a tip may land."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from drums import measures as m

if TYPE_CHECKING:
    from drums.measures import Array, Cymbal, Drum

EDGE_IN = 0.028
"""A head's edge zone lies so far inside of its shell's wall."""
RIM_TURN = 0.0


def zones() -> list[dict[str, Any]]:
    """All of them, as rig.json holds them."""
    result: list[dict[str, Any]] = []

    def add(piece: str, zone: str, joint: str, position: Array, normal: Array, radius: float) -> None:
        result.append(
            {
                "piece": piece,
                "zone": zone,
                "joint": joint,
                "position": [float(x) for x in position],
                "normal": [float(x) for x in normal / np.linalg.norm(normal)],
                "radius": radius,
            }
        )

    for drum in m.DRUMS:
        if drum is m.KICK:
            add(drum.name, "centre", "kit", beater_point(drum), drum.axis, 0.012)
            continue
        add(drum.name, "centre", "kit", drum.at(0), drum.axis, round(0.30 * drum.radius, 3))
        add(drum.name, "edge", "kit", drum.at(0, drum.radius - EDGE_IN), drum.axis, 0.016)
        add(drum.name, "rim", "kit", drum.at(m.HOOP_TOP, drum.hoop_radius), drum.axis, 0.001)
    for cymbal in m.CYMBALS:
        piece = cymbal.name.removesuffix("_top")
        for zone, distance, radius in (
            ("bow", cymbal.bell + 0.52 * (bow_end(cymbal) - cymbal.bell), 0.03),
            ("bell", 0.66 * cymbal.bell, 0.008),
            ("edge", cymbal.radius - 0.006, 0.005),
        ):
            position, normal = on_cymbal(cymbal, distance)
            add(piece, zone, cymbal.name, position, normal, min(radius, 0.2 * cymbal.radius))
    # The upper side of the cowbell, by its mouth and further back.
    along = m.unit(m.COWBELL_BACK - m.COWBELL_MOUTH)
    for zone, share, radius in (("edge", 0.03, 0.004), ("centre", 0.33, 0.015)):
        half = 0.5 * ((1 - share) * m.COWBELL_MOUTH_SIZE[1] + share * m.COWBELL_BACK_SIZE[1])
        up = np.array([0.0, 1.0, 0.0])
        middle = m.COWBELL_MOUTH + (m.COWBELL_BACK - m.COWBELL_MOUTH) * share
        length = float(np.linalg.norm(m.COWBELL_BACK - m.COWBELL_MOUTH))
        fall = (m.COWBELL_BACK_SIZE[1] - m.COWBELL_MOUTH_SIZE[1]) / (2 * length)
        upright = m.unit(up - along * (up @ along))
        add("cowbell", zone, "kit", middle + upright * half, upright - along * fall, radius)
    return result


def bow_end(cymbal: Cymbal) -> float:
    """Where the bow ends: at the edge, or where the flange turns up."""
    return cymbal.bell + 0.74 * (cymbal.radius - cymbal.bell) if cymbal.flange else cymbal.radius


def on_cymbal(cymbal: Cymbal, distance: float) -> tuple[Array, Array]:
    """A point of the upper surface on the player's side, and the normal there, in the cymbal's frame."""
    position = np.array([0.0, float(cymbal.height(distance)), -distance])
    normal = np.array([0.0, 1.0, cymbal.slope(distance)])
    return position, normal


def beater_point(drum: Drum) -> Array:
    """Where the beater lands."""
    turn = m.beater_contact_rad()
    height = m.AXLE[1] + m.BEATER_REACH * np.cos(turn)
    return np.array([m.AXLE[0], height, drum.centre[2]])
