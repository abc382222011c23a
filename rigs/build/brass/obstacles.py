"""A horn as capsules, for collision tests: what a hand must not pass through."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any

import numpy as np

from brass import measures as m
from brass.body_tubes import bell_path, hook_path
from brass.paths import arc_length, at_lengths, u_bend
from brass.wraps import WRAPS

if TYPE_CHECKING:
    from brass.measures import Horn

BELL_PIECES = 14
SLIDE_BOW_PIECES = 6
RING_PIECES = 8


def capsules(horn: Horn) -> list[dict[str, Any]]:
    """Capsules on the horn's joint, in its frame."""
    result: list[dict[str, Any]] = []

    def add(start: Any, end: Any, radius: float) -> None:
        ends = [[float(x) for x in p] for p in (start, end)]
        result.append({"joint": horn.name, "from": ends[0], "to": ends[1], "radius": float(radius)})

    def add_path(path: np.ndarray, radius: float) -> None:
        for a, b in itertools.pairwise(path):
            add(a, b, radius)

    for z in m.VALVE_Z:
        add([0, m.CASING_BOTTOM, z], [0, m.CASING_TOP, z], m.CASING)
    path = bell_path(horn)
    lengths: np.ndarray[Any, np.dtype[np.float64]] = np.linspace(
        0, float(arc_length(path)[-1]), BELL_PIECES * 2 + 1
    )
    points = at_lengths(path, lengths)
    for k in range(len(points) - 1):
        add(points[k], points[k + 1], horn.bell_radius(lengths[-1] - (lengths[k] + lengths[k + 1]) / 2))
    for pipe, radius in WRAPS[horn.wrap].obstacles(horn):
        add_path(pipe, radius)
    for x, levels, z, tip in (
        (m.SLIDE1_X, m.SLIDE1_Y, m.VALVE_Z[0], m.SLIDE1_Z - m.SLIDE1_REACH),
        (m.SLIDE3_X, m.SLIDE3_Y, m.VALVE_Z[2], m.SLIDE3_Z + m.SLIDE3_REACH),
    ):
        reach = (levels[1] - levels[0]) / 2 * np.sign(tip - z)
        end = tip - reach
        for y in levels:
            add([x * 0.8, y, z], [x, y, end], m.TUBE + 0.0006)
        add_path(u_bend(x, x, levels[1], levels[0], end, reach, SLIDE_BOW_PIECES), m.TUBE)
    x, y, z = m.SADDLE
    add([x - 0.0025, y - m.SADDLE_DEPTH, z], [x + 0.0025, y - m.SADDLE_DEPTH, z], m.SADDLE_WIRE)
    turn = np.linspace(0, 2 * np.pi, RING_PIECES + 1)
    add_path(m.RING + m.RING_RADIUS * np.c_[0 * turn, np.cos(turn), np.sin(turn)], m.RING_WIRE)
    add_path(hook_path()[::4], m.HOOK_RADIUS)
    for y in m.SLIDE2_Y:
        add([0, y, 0], [-0.026, y, 0], m.TUBE + 0.0006)
    add([-0.036, m.SLIDE2_Y[1] - 0.004, 0], [-0.036, m.SLIDE2_Y[0] + 0.004, 0], m.TUBE)
    return result
