"""The fixed part of a horn: bell, leadpipe, casings, braces, hook, and the slides' outer legs."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brass import measures as m
from brass.paths import arc_length, at_lengths, bezier, joined_path, line
from brass.wraps import WRAPS
from common.turning import Workpiece

if TYPE_CHECKING:
    from brass.measures import Horn
    from brass.metals import Metals

KNURLS = 28


def bell_path(horn: Horn) -> np.ndarray:
    """The bell's axis from valve 1 through the bow to its end."""
    bell = horn.bell
    at = bell.bow
    bow = [bezier(at[k], at[k + 1], at[k + 2], at[k + 3], bell.bow_points) for k in range(0, len(at) - 1, 3)]
    return joined_path(
        line([0.004, m.Y_LOW, m.VALVE_Z[0] - 0.009], bell.bow[0], 20),
        *bow,
        line(bell.bow[-1], [bell.x, bell.y, bell.end], 10),
    )


def build_body(detail: float, metals: Metals, horn: Horn) -> Workpiece:
    """All that does not move."""
    body = Workpiece(detail)
    _bell(body, metals, horn)
    WRAPS[horn.wrap].fixed(body, metals, horn)
    for z in m.VALVE_Z:
        _casing(body, metals, z)
    for first, second, y in ((0, 1, -0.030), (0, 1, -0.002), (1, 2, -0.014), (1, 2, 0.020)):
        body.sweep(metals.brass, line([0, y, m.VALVE_Z[first]], [0, y, m.VALVE_Z[second]]), m.TUBE * 0.96)
    _braces(body, metals, horn)
    _hook(body, metals)
    _outer_legs(body, metals)
    return body


def _bell(body: Workpiece, metals: Metals, horn: Horn) -> None:
    path = bell_path(horn)
    total, count = arc_length(path)[-1], body.facets(150, 60)
    share = 1 - (1 - np.linspace(0, 1, count)) ** 1.9  # denser toward the flare
    path = at_lengths(path, share * total)
    radius = np.array([horn.bell_radius(total * (1 - s)) for s in share])
    body.sweep(metals.brass, path, radius, 36)
    inside = int(count * 0.6)
    body.sweep(metals.brass, path[inside:][::-1], (radius[inside:] - 0.0007)[::-1], 36)
    body.ring(metals.brass, path[-1], [0, 0, 1], horn.bell.radius - 0.0002, horn.bell.rim, 72, 10)


def _casing(body: Workpiece, metals: Metals, z: float) -> None:
    bottom = m.CASING_BOTTOM
    body.lathe(
        metals.brass, [0, bottom, z], [0, 1, 0], [(0, m.CASING), (m.CASING_TOP - bottom, m.CASING)], 48
    )
    lower = [
        (0, 0.0),
        (0, 0.0036),
        (0.0012, 0.0040),
        (0.0015, 0.0085),
        (0.0035, 0.0112),
        (0.0045, 0.0118),
        (0.0065, 0.0121),
        (0.0105, 0.0121),
        (0.0115, 0.0117),
    ]
    body.lathe(metals.silver, [0, bottom - 0.0115, z], [0, 1, 0], lower, 48)
    upper = [
        (0, 0.0117),
        (0.001, 0.0121),
        (0.0055, 0.0121),
        (0.0070, 0.0115),
        (0.0085, 0.0106),
        (0.0092, 0.0060),
        (0.0092, 0.0042),
        (0.0085, 0.0042),
    ]
    body.lathe(metals.silver, [0, 0.057, z], [0, 1, 0], upper, 48)
    if body.detail > 0.8:
        for k in range(KNURLS):
            x, dz = 0.0121 * np.cos(2 * np.pi * k / KNURLS), 0.0121 * np.sin(2 * np.pi * k / KNURLS)
            for low, high in ((bottom - 0.0050, bottom - 0.0012), (0.0585, 0.0620)):
                body.sweep(metals.silver, line([x, low, z + dz], [x, high, z + dz]), 0.00042, 5)
    for y in (bottom + 0.012, 0.048):
        body.ring(metals.brass, [0, y, z], [0, 1, 0], m.CASING, 0.0005)


def _braces(body: Workpiece, metals: Metals, horn: Horn) -> None:
    for (start, end), radius in zip(horn.stays, horn.stay_radii, strict=True):
        body.brace(metals.brass, start, end, radius)
    x, y, bell = m.X_LEADPIPE, m.Y_TOP, horn.bell
    for z in (-0.0275, 0.0275):
        body.brace(metals.brass, [x + 0.004, y, z], [-0.006, y - 0.002, z], 0.0028)
        body.brace(metals.brass, [bell.x - 0.005, bell.y, z], [0.006, y - 0.002, z], 0.0028)


def hook_path() -> np.ndarray:
    """The middle of the wire of the little finger's hook on the leadpipe (33, 3)."""
    x, y, z = m.X_LEADPIPE, m.Y_TOP, m.HOOK_Z
    rise = bezier(
        [x, y + 0.005, z + 0.004],
        [x - 0.002, y + 0.020, z + 0.006],
        [x - 0.004, y + 0.030, z - 0.004],
        [x - 0.006, y + 0.031, z - 0.016],
        20,
    )
    turn = bezier(
        [x - 0.006, y + 0.031, z - 0.016],
        [x - 0.008, y + 0.032, z - 0.028],
        [x - 0.010, y + 0.022, z - 0.031],
        [x - 0.010, y + 0.016, z - 0.024],
        14,
    )
    return joined_path(rise, turn)


def _hook(body: Workpiece, metals: Metals) -> None:
    radius = np.r_[np.linspace(0.0030, m.HOOK_RADIUS, 20), np.linspace(m.HOOK_RADIUS, 0.0016, 13)]
    body.sweep(metals.brass, hook_path(), radius, 12, caps=True, oval=(1.5, 0.8))


def _outer_legs(body: Workpiece, metals: Metals) -> None:
    """The legs that the three slides run on."""
    z1, z3, tube = m.VALVE_Z[0], m.VALVE_Z[2], m.TUBE
    for y in m.SLIDE1_Y:
        x = m.SLIDE1_X
        body.sweep(metals.brass, line([0.002, y, z1], [x, y, z1 - 0.020], 6), tube)
        body.sweep(metals.silver, line([x, y, z1 - 0.020], [x, y, m.SLIDE1_Z - 0.002]), tube + 0.0001)
        body.ferrule(metals.silver, [x, y, z1 - 0.017], [x, y, z1 - 0.024], tube + 0.0009)
    for y in m.SLIDE3_Y:
        x = m.SLIDE3_X
        body.sweep(metals.brass, line([0.004, y, z3], [x, y, z3 + 0.026], 6), tube)
        body.sweep(metals.silver, line([x, y, z3 + 0.026], [x, y, m.SLIDE3_Z + 0.03]), tube - 0.0006)
        body.ferrule(metals.silver, [x, y, z3 + 0.022], [x, y, z3 + 0.030], tube + 0.0009)
    for y in m.SLIDE2_Y:
        body.sweep(metals.brass, line([-0.006, y, 0], [-0.020, y, 0], 4), tube * 0.95)
        body.ferrule(metals.silver, [-0.0175, y, 0], [-0.022, y, 0], tube + 0.0008)
