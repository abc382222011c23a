"""A horn as a rig: models of three tiers and rig.json."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from brass import measures as m
from brass.body_tubes import build_body
from brass.metals import Metals
from brass.moving_parts import first_slide, mouthpiece, second_slide, third_slide, valve
from brass.mute import straight_mute
from brass.obstacles import capsules
from brass.wraps import WRAPS
from common.glb import GlbWriter
from common.occlusion import INSTRUMENT, Cells
from common.rig_file import write_json

if TYPE_CHECKING:
    from pathlib import Path

    from brass.measures import Horn, Point

MUTE = "mute"
DETAIL = {"full": 1.0, "medium": 0.6, "low": 0.32}
BUTTON_EFFECTORS = ("rightIndexTip", "rightMiddleTip", "rightRingTip")


def contacts(horn: Horn) -> dict[str, Point]:
    """Where the player's body meets it, and the middle of its bell."""
    return {
        "mouthpiece": (m.X_LEADPIPE, m.Y_TOP, horn.z_rim),
        "bell": (horn.bell.x, horn.bell.y, horn.bell.end),
        "ring": m.RING,
        "hook": (m.HOOK_TOP[0], m.HOOK_TOP[1] + 0.8 * m.HOOK_RADIUS, m.HOOK_TOP[2]),
        "saddle": (m.SADDLE[0], m.SADDLE[1] - m.SADDLE_DEPTH + m.SADDLE_WIRE, m.SADDLE[2]),
        "thumb_right": (m.X_LEADPIPE - 0.0015, m.Y_TOP - 0.98 * m.TUBE, (m.VALVE_Z[0] + m.VALVE_Z[1]) / 2),
        "grip_left": (m.CASING, -0.010, m.VALVE_Z[1]),
    }


def build_instrument(raw: Path, rig_folder: Path, horn: Horn) -> None:
    """Write `<name>.<tier>.glb`, not yet compressed, into `raw`, and rig.json into `rig_folder`."""
    for tier, detail in DETAIL.items():
        write_model(raw / f"{horn.name}.{tier}.glb", detail, horn)
    write_json(rig_folder / "rig.json", rig_content(horn))


def write_model(path: Path, detail: float, horn: Horn) -> None:
    """One node a moving part under the joint's node; valves have frames of their own."""
    writer = GlbWriter()
    metals = Metals.into(writer)
    pieces = {
        "body": build_body(detail, metals, horn),
        "slide_main": WRAPS[horn.wrap].tuning_slide(detail, metals, horn),
        "slide1": first_slide(detail, metals),
        "slide2": second_slide(detail, metals),
        "slide3": third_slide(detail, metals),
        "mouthpiece": mouthpiece(detail, metals, horn),
        MUTE: straight_mute(detail, metals, horn),
    }
    stem = valve(detail, metals)
    standing = [(piece, (0.0, 0.0, 0.0)) for name, piece in pieces.items() if name != MUTE]
    standing += [(stem, (0.0, m.STEM_Y, z)) for z in m.VALVE_Z]
    cells = Cells(
        INSTRUMENT,
        [(v + np.array(at), faces) for piece, at in standing for v, _, faces in piece.surfaces().values()],
    )
    children = [
        writer.node(
            name,
            # The mute is seldom there: it neither shades nor is shaded.
            mesh=writer.mesh(name, piece.primitives(writer, metals.shades, None if name == MUTE else cells)),
        )
        for name, piece in pieces.items()
    ]
    middle = (0.0, m.STEM_Y, m.VALVE_Z[1])
    stem_mesh = writer.mesh("valve", stem.primitives(writer, metals.shades, cells, middle))
    for number, z in enumerate(m.VALVE_Z, start=1):
        children.append(writer.node(f"valve{number}", mesh=stem_mesh, translation=[0.0, m.STEM_Y, z]))
    writer.save(path, [writer.node(horn.name, children=children)])


def rig_content(horn: Horn) -> dict[str, Any]:
    """What rig.json says of the instrument."""
    travel = [0.0, -m.STROKE, 0.0]
    parts: list[dict[str, Any]] = [
        {"node": f"valve{k}", "parameter": f"{horn.name}/valve/{k}", "travel": travel} for k in (1, 2, 3)
    ]
    parts.append(
        {"node": "slide3", "parameter": f"{horn.name}/slide/3", "travel": [0.0, 0.0, m.SLIDE3_TRAVEL]}
    )
    parts.append({"node": "mute", "parameter": f"{horn.name}/mute", "shown_from": 0.5})
    buttons = [
        {"valve": k, "effector": effector, "position": [0.0, m.STEM_Y + m.BUTTON_TOP, z], "travel": travel}
        for k, (effector, z) in enumerate(zip(BUTTON_EFFECTORS, m.VALVE_Z, strict=True), start=1)
    ]
    return {
        "name": horn.name,
        "licence": "CC0-1.0",
        "models": {tier: f"{tier}.glb" for tier in DETAIL},
        "joints": [
            {
                "name": horn.name,
                "parent": None,
                "translation": [0.0, 0.0, 0.0],
                "rotation": [0.0, 0.0, 0.0, 1.0],
                "node": horn.name,
            }
        ],
        "effectors": [],
        "contacts": [
            {"name": name, "joint": horn.name, "offset": list(offset)}
            for name, offset in contacts(horn).items()
        ],
        "capsules": capsules(horn),
        "morphs": [],
        "chains": [],
        "parts": parts,
        "buttons": buttons,
    }
