"""The kit as capsules and flat-ended cylinders: what sticks, hands and legs must not pass through."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any

import numpy as np

from drums import measures as m
from drums.stands_plan import HAT_STAND, POST_FOOT, POST_TOP, STANDS, THRONE_LEGS_DEG, THRONE_REACH

if TYPE_CHECKING:
    from drums.measures import Array, Cymbal

CYMBAL_STEPS = 5
HOOP_PIECES = 24
LUG_OUT = 0.012
"""A lug as a capsule: its middle lies so far outside of the shell."""
LUG_RADIUS = 0.011


def capsules() -> list[dict[str, Any]]:
    """What is round at its ends: stands, pedals, the beater, the post."""
    result: list[dict[str, Any]] = []

    def add(piece: str, joint: str, start: Array, end: Array, radius: float) -> None:
        ends = {"from": listed(start), "to": listed(end)}
        result.append({"piece": piece, "joint": joint, **ends, "radius": radius})

    for stand in STANDS:
        for start, end, radius in stand.lines():
            add(stand.name, "kit", start, end, radius)
    add(
        HAT_STAND.name,
        "kit",
        np.array(HAT_STAND.top),
        np.array([m.HAT_X, m.HAT_EDGE_Y - 0.03, m.HAT_Z]),
        0.008,
    )
    add("tom_mount", "kit", POST_FOOT, np.array([POST_FOOT[0], POST_TOP, POST_FOOT[2]]), 0.014)
    for turn in np.radians(THRONE_LEGS_DEG):
        foot = np.array([THRONE_REACH * np.sin(turn), 0.012, THRONE_REACH * np.cos(turn)])
        add("stool", "kit", np.array([0, 0.26, 0.0]), foot, 0.008)
    for pedal in m.PEDALS:
        for side in (-1, 0, 1):
            across = np.array([side * (pedal.half_width - 0.008), 0.0, 0.0])
            ahead = np.array([0.0, 0.0, pedal.length])
            add(pedal.name, pedal.name, across + 0.03 * ahead, across + 0.97 * ahead, m.BOARD_TOP)
    for drum in m.DRUMS:
        wooden = drum is m.KICK
        for over in (
            (m.KICK_HOOP_OVER - m.KICK_HOOP_THICK / 2, -drum.depth) if wooden else (m.HOOP_OVER, -drum.depth)
        ):
            turns = np.linspace(0, 2 * np.pi, HOOP_PIECES + 1)
            ring = [drum.at(over, drum.hoop_radius, turn) for turn in turns]
            for start, end in itertools.pairwise(ring):
                add(drum.name, "kit", start, end, m.KICK_HOOP_THICK / 2 if wooden else m.HOOP_BEAD)
        for turn in drum.lug_turns():
            top, low = (drum.at(y, drum.radius + LUG_OUT, turn) for y in (-0.008, 0.008 - drum.depth))
            add(drum.name, "kit", top, low, LUG_RADIUS)
    for drum in (m.TOM_FLOOR,):
        for turn in np.radians([60, 180, 300]):
            out = drum.at(-0.18, drum.radius + 0.02, turn)
            add(drum.name, "kit", out, np.array([out[0], 0.012, out[2]]), 0.0055)
    top, across = np.array([0, m.BEATER_REACH, 0]), np.array([0.016, 0, 0])
    add("kick_pedal", "kick_beater", np.zeros(3), top, 0.004)
    add("kick_pedal", "kick_beater", top - across, top + across, m.BEATER_HALF)
    return result


def cylinders() -> list[dict[str, Any]]:
    """What is flat at its ends: drums, cymbals, seat, cowbell."""
    result: list[dict[str, Any]] = []

    def add(piece: str, joint: str, start: Array, end: Array, radius: float) -> None:
        ends = {"from": listed(start), "to": listed(end)}
        result.append({"piece": piece, "joint": joint, **ends, "radius": radius})

    for drum in m.DRUMS:
        add(drum.name, "kit", drum.at(0), drum.at(-drum.depth), drum.radius)
    for cymbal in m.CYMBALS:
        for start, end, radius in cymbal_steps(cymbal):
            add(
                cymbal.name.removesuffix("_top"),
                cymbal.name,
                np.array([0, start, 0]),
                np.array([0, end, 0]),
                radius,
            )
    low = m.HI_HAT_TOP
    bottom = m.HAT_EDGE_Y - m.HAT_GAP
    add(
        "hi_hat",
        "kit",
        np.array([m.HAT_X, bottom - 0.030, m.HAT_Z]),
        np.array([m.HAT_X, bottom, m.HAT_Z]),
        low.radius,
    )
    add(
        "stool",
        "kit",
        np.array([0, m.SEAT_TOP - m.SEAT_THICK, 0.0]),
        np.array([0, m.SEAT_TOP, 0.0]),
        m.SEAT_RADIUS,
    )
    back = m.COWBELL_MOUTH_SIZE
    half = 0.5 * min(back)
    for across in (-1, 1):
        side = np.array([across * (0.5 * back[0] - half), 0.0, 0.0])
        narrow = np.array([across * (0.5 * m.COWBELL_BACK_SIZE[0] - half), 0.0, 0.0])
        add(
            "cowbell",
            "kit",
            m.COWBELL_MOUTH + side,
            m.COWBELL_BACK + np.maximum(narrow * across, 0) * across,
            half,
        )
    return result


def cymbal_steps(cymbal: Cymbal) -> list[tuple[float, float, float]]:
    """A cymbal as flat steps, filled from its lowest point up: from, to (along its axis) and radius."""
    radii = np.r_[cymbal.radius, np.linspace(cymbal.radius, cymbal.bell, CYMBAL_STEPS)[1:], 0.6 * cymbal.bell]
    floor = float(cymbal.height(np.linspace(0.0, cymbal.radius, 200)).min()) - m.CYMBAL_THICKNESS
    steps: list[tuple[float, float, float]] = []
    for radius in radii:
        inside: Array = np.linspace(0.0, float(radius), 100)
        steps.append((floor, max(float(cymbal.height(inside).min()), floor + 0.001), float(radius)))
    return steps


def listed(point: Array) -> list[float]:
    """A point as JSON has it."""
    return [float(x) for x in point]
