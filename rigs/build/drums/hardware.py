"""Stands: double-braced tripods, tubes with memory locks, booms with their tilters, rubber feet."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from common.turning import Workpiece
from drums import measures as m
from drums.cymbal_pieces import stand_top
from drums.measures import unit
from drums.stands_plan import (
    CYMBAL_STANDS,
    FOOT,
    HAT_STAND,
    POST_FOOT,
    POST_TOP,
    SNARE_STAND,
    TUBE_HIGH,
    TUBE_LOW,
    TUBE_MIDDLE,
)

if TYPE_CHECKING:
    from drums.materials import KitMaterials
    from drums.measures import Array
    from drums.stands_plan import Stand

UP = np.array([0.0, 1.0, 0.0])


def tube(piece: Workpiece, material: int, start: Array, end: Array, radius: float, sides: int = 16) -> None:
    """A straight tube with closed ends."""
    piece.sweep(material, np.array([start, end], dtype=np.float64), radius, sides, caps=True)


def lock(
    piece: Workpiece, materials: KitMaterials, at: Array, along: Array, radius: float, turn: float
) -> None:
    """A clamp about a tube with its wing bolt, as memory locks are."""
    along = unit(along)
    side = unit(np.cross(along, [np.sin(turn), 0.13, np.cos(turn)]))
    out = radius + 0.0055
    profile = [
        (-0.012, radius),
        (-0.012, out - 0.002),
        (-0.010, out),
        (0.010, out),
        (0.012, out - 0.002),
        (0.012, radius),
    ]
    piece.lathe(materials.chrome, at, along, profile, 14)
    axes = np.column_stack([np.cross(along, side), along, side])
    piece.block(materials.chrome, at + side * (out + 0.004), (0.012, 0.018, 0.014), 0.003, axes)
    bolt = at + side * (out + 0.004)
    across = axes[:, 0]
    tube(piece, materials.chrome, bolt - across * 0.014, bolt + across * 0.020, 0.0032, 8)
    wing = np.array([bolt + across * 0.022 + along * h for h in (-0.013, 0.0, 0.013)])
    piece.sweep(materials.chrome, wing, np.array([0.0052, 0.0030, 0.0052]), 8, caps=True, oval=(1.0, 0.55))


def tripod(piece: Workpiece, materials: KitMaterials, stand: Stand) -> None:
    """Three legs of two bars each, their stays, and the collars that hold them."""
    base = stand.base
    hub, low = base + UP * stand.hub, base + UP * 0.09
    for foot in stand.feet():
        out = unit((foot - base) * [1, 0, 1])
        side = np.cross(UP, out)
        leg = unit(foot - hub)
        for s in (-1, 1):
            top = hub + side * s * 0.0075 + out * 0.017
            end = foot - leg * 0.012 + side * s * 0.0075
            bend = np.array([top, top + (end - top) * 0.5, end])
            piece.sweep(materials.chrome, bend, 0.0042, 8, caps=True, oval=(0.62, 1.0))
            near = low + side * s * 0.0105 + out * 0.017
            far = foot + (hub - foot) * 0.42 + side * s * 0.0105
            piece.sweep(materials.chrome, np.array([near, far]), 0.0032, 6, caps=True, oval=(0.62, 1.0))
        for share in (0.42, 0.985):
            at = hub + (foot - hub) * (1 - share if share < 0.5 else share)
            tube(piece, materials.steel, at - side * 0.0135, at + side * 0.0135, 0.0028, 8)
        rubber_foot(piece, materials, foot, leg)
    for at in (hub, low):
        collar = [(-0.013, TUBE_LOW), (-0.013, 0.0205), (0.013, 0.0205), (0.013, TUBE_LOW)]
        piece.lathe(materials.chrome, at, UP, collar, 20)


def rubber_foot(piece: Workpiece, materials: KitMaterials, foot: Array, leg: Array) -> None:
    """A rubber shoe, flat on the floor."""
    del leg
    profile = [
        (0.0, 0.0),
        (0.0, 0.0145),
        (0.004, 0.0155),
        (0.016, 0.0130),
        (0.024, 0.0105),
        (0.025, 0.0),
    ]
    piece.lathe(materials.rubber, foot - UP * FOOT, UP, profile, 14)


def cymbal_stand(piece: Workpiece, materials: KitMaterials, stand: Stand) -> None:
    """A boom stand; its top is in the cymbal's frame."""
    tripod(piece, materials, stand)
    neck, joint_low = stand.neck, 0.30 + 0.36 * (stand.head - 0.30)
    joint = stand.base + UP * joint_low
    upper = stand.base + UP * (joint_low + 0.6 * (stand.head - joint_low))
    tube(piece, materials.chrome, stand.base + UP * 0.055, joint, TUBE_LOW)
    tube(piece, materials.chrome, joint, upper, TUBE_MIDDLE)
    tube(piece, materials.chrome, upper, neck - UP * 0.01, TUBE_HIGH)
    piece.lathe(
        materials.rubber, stand.base + UP * 0.048, UP, [(0, 0), (0, 0.012), (0.012, 0.0155), (0.012, 0)], 14
    )
    for k, (at, radius) in enumerate(((joint, TUBE_LOW), (upper, TUBE_MIDDLE))):
        lock(piece, materials, at - UP * 0.008, UP, radius, 0.8 + 2 * k)
    boom = stand.boom
    if boom is None:
        return
    start, end = boom
    way = unit(end - start)
    tube(piece, materials.chrome, start, end - way * 0.020, 0.0072, 12)
    piece.lathe(
        materials.rubber, start, -way, [(-0.012, 0.0085), (0.004, 0.0085), (0.006, 0.006), (0.006, 0)], 12
    )
    tilter(piece, materials, neck, way)
    tilter(piece, materials, end - way * 0.016, way, small=True)


def tilter(piece: Workpiece, materials: KitMaterials, at: Array, way: Array, *, small: bool = False) -> None:
    """The toothed joint by which a boom or a cymbal's seat is tilted, and its bolt."""
    side = unit(np.cross(way, UP if abs(way[1]) < 0.95 else [1.0, 0.0, 0.0]))
    size = 0.012 if small else 0.017
    half = 0.010 if small else 0.013
    wheel = [
        (-half, 0.0),
        (-half, size - 0.002),
        (-half + 0.002, size),
        (-0.0012, size),
        (-0.0012, size - 0.0015),
        (0.0012, size - 0.0015),
        (0.0012, size),
        (half - 0.002, size),
        (half, size - 0.002),
        (half, 0.0),
    ]
    piece.lathe(materials.chrome, at, side, wheel, 16)
    grip = at + side * (half + 0.012)
    tube(piece, materials.chrome, at + side * half, grip, 0.0032, 8)
    across = np.cross(side, way)
    wing = np.array([grip + across * h for h in (-0.015, 0.0, 0.015)])
    piece.sweep(materials.chrome, wing, np.array([0.0058, 0.0032, 0.0058]), 8, caps=True, oval=(1.0, 0.55))


def snare_stand(piece: Workpiece, materials: KitMaterials, stand: Stand) -> None:
    """A tripod with a basket of three arms that hold the drum's lower hoop."""
    tripod(piece, materials, stand)
    drum = m.SNARE
    neck = stand.neck
    tube(piece, materials.chrome, stand.base + UP * 0.055, stand.base + UP * 0.27, TUBE_LOW)
    tube(piece, materials.chrome, stand.base + UP * 0.26, neck + UP * 0.02, TUBE_HIGH)
    lock(piece, materials, stand.base + UP * 0.265, UP, TUBE_LOW, 2.2)
    hoop_y = drum.centre[1] - drum.depth - m.HOOP_TOP
    out = drum.hoop_radius + 0.004
    for turn in np.radians([90, 210, 330]):
        way = np.array([np.sin(turn), 0.0, np.cos(turn)])
        at = np.array([drum.centre[0], 0.0, drum.centre[2]])
        path = np.array(
            [
                neck + UP * 0.005,
                neck + way * 0.05 + UP * 0.012,
                at + way * (out - 0.012) + UP * (hoop_y - 0.012),
                at + way * (out + 0.009) + UP * (hoop_y - 0.006),
                at + way * (out + 0.011) + UP * (hoop_y + 0.020),
            ]
        )
        piece.sweep(materials.chrome, path, 0.0052, 10, caps=True)
        piece.sweep(materials.rubber, path[-3:] + UP * 0.001, 0.0072, 10, caps=True)
    basket = [(-0.02, TUBE_HIGH), (-0.02, 0.017), (0.012, 0.019), (0.016, 0.0)]
    piece.lathe(materials.chrome, neck, UP, basket, 18)


def hat_stand(piece: Workpiece, materials: KitMaterials, stand: Stand) -> None:
    """The hi-hat's stand up to the seat of its lower cymbal; the rod moves with the upper one."""
    base = stand.base
    for foot in stand.feet():
        out = unit((foot - base) * [1, 0, 1])
        side = np.cross(UP, out)
        for s in (-1, 1):
            top = base + UP * stand.hub + out * 0.017 + side * s * 0.0075
            piece.sweep(
                materials.chrome,
                np.array([top, foot + side * s * 0.0075]),
                0.0042,
                8,
                caps=True,
                oval=(0.62, 1.0),
            )
            near = base + UP * 0.09 + out * 0.017 + side * s * 0.0105
            far = foot + (base + UP * stand.hub - foot) * 0.42 + side * s * 0.0105
            piece.sweep(materials.chrome, np.array([near, far]), 0.0032, 6, caps=True, oval=(0.62, 1.0))
        rubber_foot(piece, materials, foot, out)
    for y in (0.09, stand.hub):
        collar = [(-0.013, TUBE_LOW), (-0.013, 0.0205), (0.013, 0.0205), (0.013, TUBE_LOW)]
        piece.lathe(materials.chrome, base + UP * y, UP, collar, 20)
    tube(piece, materials.chrome, base + UP * 0.05, base + UP * 0.46, TUBE_LOW)
    seat = m.HAT_EDGE_Y - m.HAT_GAP - m.HI_HAT_TOP.bow_height - m.HI_HAT_TOP.bell_height
    tube(piece, materials.chrome, base + UP * 0.45, base + UP * (seat - 0.035), TUBE_MIDDLE - 0.002)
    lock(piece, materials, base + UP * 0.455, UP, TUBE_LOW, -0.9)
    cup = [
        (-0.040, 0.0),
        (-0.040, 0.011),
        (-0.024, 0.013),
        (-0.018, 0.024),
        (-0.0115, 0.026),
        (-0.0115, 0.004),
    ]
    piece.lathe(materials.chrome, base + UP * seat, UP, cup, 22)
    washer = [(-0.0115, 0.004), (-0.0115, 0.021), (-0.0016, 0.021), (-0.0016, 0.004)]
    piece.lathe(materials.felt, base + UP * seat, UP, washer, 18)


def tom_mount(piece: Workpiece, materials: KitMaterials) -> None:
    """The post on the bass drum, its arms to the two toms, and what carries the splash and the cowbell."""
    top = POST_FOOT + UP * (POST_TOP - POST_FOOT[1])
    piece.block(materials.chrome, POST_FOOT + UP * 0.012, (0.07, 0.02, 0.075), 0.006)
    tube(piece, materials.chrome, POST_FOOT, top, 0.0135)
    lock(piece, materials, POST_FOOT + UP * 0.05, UP, 0.0135, 3.0)
    splash = next(cymbal for cymbal in m.CYMBALS if cymbal.name == "splash")
    end = np.array(splash.pivot) - splash.rotation[:, 1] * 0.022
    tube(piece, materials.chrome, top - UP * 0.02, top + UP * 0.09, 0.0075, 12)
    neck = top + UP * 0.09
    tube(piece, materials.chrome, neck, end, 0.0060, 10)
    tilter(piece, materials, neck, unit(end - neck), small=True)
    tilter(piece, materials, end, splash.rotation[:, 1], small=True)
    lock(piece, materials, top, UP, 0.0135, 1.0)
    for drum, height in ((m.TOM_HIGH, POST_TOP - 0.065), (m.TOM_MID, POST_TOP - 0.115)):
        start = np.array([POST_FOOT[0], height, POST_FOOT[2]])
        out = unit(
            (start - np.array(drum.centre)) - drum.axis * ((start - np.array(drum.centre)) @ drum.axis)
        )
        at = np.array(drum.centre) - drum.axis * 0.5 * drum.depth + out * (drum.radius + 0.024)
        middle = (start + at) / 2
        piece.sweep(materials.chrome, np.array([start, middle, at]), 0.0075, 12, caps=True)
        tilter(piece, materials, start, unit(at - start))
        frame = np.column_stack([np.cross(drum.axis, out), drum.axis, out])
        wood = np.array(drum.centre) - drum.axis * 0.5 * drum.depth + out * drum.radius
        piece.block(materials.chrome, wood + out * 0.002, (0.052, 0.058, 0.004), 0.0015, frame)
        piece.block(materials.chrome, wood + out * 0.016, (0.028, 0.032, 0.028), 0.006, frame)
    back = m.COWBELL_BACK
    hold = back + (m.COWBELL_MOUTH - back) * 0.10 - UP * 0.5 * m.COWBELL_BACK_SIZE[1]
    low = np.array([back[0], POST_TOP - 0.02, POST_FOOT[2]])
    bend = np.array([low, low * [1, 1, 0] + [0, 0, back[2] + 0.02], hold + UP * 0.004])
    piece.sweep(materials.chrome, bend, 0.0045, 10, caps=True)
    piece.block(materials.chrome, hold - UP * 0.006, (0.020, 0.014, 0.022), 0.003)


def stands(detail: float, materials: KitMaterials) -> Workpiece:
    """All stands, in the kit's frame."""
    piece = Workpiece(detail)
    snare_stand(piece, materials, SNARE_STAND)
    hat_stand(piece, materials, HAT_STAND)
    for stand in CYMBAL_STANDS:
        cymbal_stand(piece, materials, stand)
    tom_mount(piece, materials)
    top = stand_top(detail, materials)
    for cymbal in m.CYMBALS:
        if cymbal is not m.HI_HAT_TOP:
            piece.include(top, cymbal.rotation, cymbal.pivot)
    return piece
