"""What rig.json says of the kit and of a stick."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from drums import measures as m
from drums.obstacles import capsules, cylinders
from drums.zones import zones

if TYPE_CHECKING:
    from drums.measures import Array

TIERS = ("full", "medium", "low")
SWING_DEG = 30.0
"""How far a cymbal leans about its stand's top, each way."""
HEAD_TRAVEL = 0.003
"""How far a struck head goes in, at its parameter's 1."""
LANE = (-0.12, 1.12, 1.0)
"""Where the lane of notes begins: over the toms, before the cymbals."""
HEADS = tuple(drum.name for drum in m.DRUMS)


def quaternion(matrix: Array) -> list[float]:
    """A rotation matrix as x, y, z, w with w ≥ 0; for turns of less than 180°."""
    w = 0.5 * np.sqrt(1.0 + np.trace(matrix))
    x = (matrix[2, 1] - matrix[1, 2]) / (4 * w)
    y = (matrix[0, 2] - matrix[2, 0]) / (4 * w)
    z = (matrix[1, 0] - matrix[0, 1]) / (4 * w)
    q = np.array([x, y, z, w])
    return [float(c) for c in q / np.linalg.norm(q)]


def about_x(angle_deg: float) -> Array:
    """The matrix of a turn about X."""
    c, s = np.cos(np.radians(angle_deg)), np.sin(np.radians(angle_deg))
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


def joint(
    name: str, parent: str | None, at: Array, rotation: Array, limits: dict[str, Any] | None = None
) -> dict[str, Any]:
    """A joint as rig.json has it."""
    item: dict[str, Any] = {
        "name": name,
        "parent": parent,
        "translation": [float(x) for x in at],
        "rotation": quaternion(rotation),
        "node": name,
    }
    if limits is not None:
        item["limits"] = limits
    return item


def about(x: tuple[float, float], z: tuple[float, float] = (0.0, 0.0)) -> dict[str, Any]:
    """Limits of a turn from rest about X and Z, degrees."""
    ranges = {axis: [float(np.radians(end)) for end in ends] for axis, ends in (("x", x), ("z", z))}
    return {"order": "yxz", "x": ranges["x"], "y": [0.0, 0.0], "z": ranges["z"]}


def joints() -> list[dict[str, Any]]:
    """What moves of it as a skeleton."""
    lean = (-SWING_DEG, SWING_DEG)
    result = [joint("kit", None, np.zeros(3), np.eye(3))]
    for cymbal in m.CYMBALS:
        swing = about((-6.0, 6.0), (-6.0, 6.0)) if cymbal is m.HI_HAT_TOP else about(lean, lean)
        result.append(joint(cymbal.name, "kit", np.array(cymbal.pivot), cymbal.rotation, swing))
    forward = float(np.degrees(m.beater_contact_rad())) - m.BEATER_REST_DEG
    result.append(joint("kick_beater", "kit", m.AXLE, about_x(m.BEATER_REST_DEG), about((0.0, forward))))
    return result + [
        joint(pedal.name, "kit", pedal.hinge, pedal.rotation, about((0.0, pedal.down_deg)))
        for pedal in m.PEDALS
    ]


def parts() -> list[dict[str, Any]]:
    """What parameters alone move: the hi-hat's top along its rod, and the heads."""
    result: list[dict[str, Any]] = [
        {"node": "hi_hat_top", "parameter": "drums/hi_hat/pedal", "travel": [0.0, -m.HAT_GAP, 0.0]}
    ]
    for drum in m.DRUMS:
        travel = [float(x) for x in -HEAD_TRAVEL * drum.axis]
        result.append({"node": f"{drum.name}_head", "parameter": f"drums/{drum.name}/head", "travel": travel})
    return result


def contacts() -> list[dict[str, Any]]:
    """Where the player sits and where the feet rest; where the beater meets the head; where notes come to."""
    result: list[dict[str, Any]] = [{"name": "seat", "joint": "kit", "offset": [0.0, m.SEAT_TOP, 0.0]}]
    for side, pedal in (("right", m.KICK_PEDAL), ("left", m.HAT_PEDAL)):
        ball = [0.0, m.BOARD_TOP, m.BALL * pedal.length]
        result.append({"name": f"{side}Pedal", "joint": pedal.name, "offset": ball})
        heel = pedal.hinge - 0.035 * pedal.ahead
        result.append(
            {"name": f"{side}Heel", "joint": "kit", "offset": [float(heel[0]), 0.022, float(heel[2])]}
        )
    # Where the beater's felt is when it lies against the head, in the beater's own frame.
    turn = m.beater_contact_rad()
    felt = [0.0, m.BEATER_REACH + m.BEATER_HALF * np.sin(turn), m.BEATER_HALF * np.cos(turn)]
    result.append({"name": "beater", "joint": "kick_beater", "offset": [float(x) for x in felt]})
    # Where the notes that come are played into it: over the toms, and the bass drum's front, which is seen.
    result.append({"name": "lane", "joint": "kit", "offset": list(LANE)})
    front = m.KICK.at(-m.KICK.depth)
    result.append({"name": "lane_kick", "joint": "kit", "offset": [float(x) for x in front]})
    return result


def kit_content() -> dict[str, Any]:
    """rig.json of the kit."""
    return {
        "name": "drumkit",
        "licence": "CC0-1.0",
        "models": {tier: f"{tier}.glb" for tier in TIERS},
        "joints": joints(),
        "effectors": [],
        "contacts": contacts(),
        "capsules": capsules(),
        "cylinders": cylinders(),
        "morphs": [],
        "chains": [],
        "parts": parts(),
        "zones": zones(),
    }


def stick_content(side: str) -> dict[str, Any]:
    """rig.json of a stick: one joint in the grip, +Z to the tip."""
    name = f"{side}Stick"
    tip = m.STICK_LENGTH - m.STICK_BUTT
    return {
        "name": f"{side}_stick",
        "licence": "CC0-1.0",
        "models": {tier: f"{tier}.glb" for tier in TIERS},
        "joints": [joint(name, None, np.zeros(3), np.eye(3))],
        "effectors": [
            {"name": f"{name}Tip", "joint": name, "offset": [0.0, -m.BEAD_RADIUS, tip - m.BEAD_LENGTH / 2]}
        ],
        "contacts": [{"name": "butt", "joint": name, "offset": [0.0, 0.0, -m.STICK_BUTT]}],
        "capsules": [
            {
                "joint": name,
                "from": [0.0, 0.0, -m.STICK_BUTT + m.STICK_RADIUS],
                "to": [0.0, 0.0, 0.6 * tip],
                "radius": m.STICK_RADIUS,
            },
            {"joint": name, "from": [0.0, 0.0, 0.6 * tip], "to": [0.0, 0.0, tip - 0.016], "radius": 0.005},
            {
                "joint": name,
                "from": [0.0, 0.0, tip - m.BEAD_LENGTH + m.BEAD_RADIUS],
                "to": [0.0, 0.0, tip - m.BEAD_RADIUS],
                "radius": m.BEAD_RADIUS,
            },
        ],
        "morphs": [],
        "chains": [],
    }
