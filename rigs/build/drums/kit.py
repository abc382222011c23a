"""The drum kit and its sticks as rigs: models of three tiers and rig.json."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from common.glb import GlbWriter, linear
from common.occlusion import Cells, Grain
from common.rig_file import write_json
from common.turning import Workpiece
from drums import measures as m
from drums.cymbal_pieces import bronze
from drums.drum_pieces import bottom_head, frame, head, lugs_and_hoops, shell, snare_gear
from drums.hardware import stands
from drums.kit_file import about_x, kit_content, quaternion, stick_content
from drums.materials import KitMaterials
from drums.pedals import beater, board, board_chain, hat_base, hat_moving, kick_frame
from drums.small_pieces import cowbell, floor_legs, spurs, stick
from drums.stool import stool

if TYPE_CHECKING:
    from pathlib import Path

    from drums.measures import Array

NAME = "drumkit"
SIDES = ("left", "right")
DETAIL = {"full": 1.0, "medium": 0.62, "low": 0.36}
GRID_M = 2.0**-14
KIT = Grain(0.005, 0.009, 0.14)


def build_kit(raw: Path, rig_folder: Path) -> None:
    """Write `drumkit.<tier>.glb`, not yet compressed, into `raw`, and rig.json into `rig_folder`."""
    for tier, detail in DETAIL.items():
        write_kit(raw / f"{NAME}.{tier}.glb", detail)
    write_json(rig_folder / "rig.json", kit_content())


def build_stick(raw: Path, rig_folder: Path, side: str) -> None:
    """Write `<side>_stick.<tier>.glb` and its rig.json."""
    for tier, detail in DETAIL.items():
        writer = GlbWriter()
        wood = writer.material("hickory", metallic=0.0, roughness=0.48, colour=linear((0.80, 0.63, 0.42)))
        mesh = writer.mesh("stick", stick(detail, wood).primitives(writer, {}, None))
        model = writer.node("stick", mesh=mesh)
        writer.save(raw / f"{side}_stick.{tier}.glb", [writer.node(f"{side}Stick", children=[model])])
    write_json(rig_folder / "rig.json", stick_content(side))


def standing(detail: float, materials: KitMaterials) -> Workpiece:
    """All that does not move, in the kit's frame."""
    piece = Workpiece(detail)
    for drum in m.DRUMS:
        turn = frame(drum)
        own = [shell(detail, materials, drum), lugs_and_hoops(detail, materials, drum)]
        own.append(bottom_head(detail, materials, drum))
        if drum is m.SNARE:
            own.append(snare_gear(detail, materials, drum))
        if drum is m.TOM_FLOOR:
            legs = Workpiece(detail)
            floor_legs(legs, materials, drum, turn)
            own.append(legs)
        for one in own:
            piece.include(one, turn, drum.centre)
    piece.include(stands(detail, materials), np.eye(3), (0, 0, 0))
    top = m.HI_HAT_TOP
    low = np.array([m.HAT_X, m.HAT_EDGE_Y - m.HAT_GAP - top.bell_height - top.bow_height, m.HAT_Z])
    piece.include(bronze(detail, materials, top, over=True), np.eye(3), low)
    for add in (spurs, cowbell, kick_frame, hat_base, stool):
        add(piece, materials)
    return piece


def write_kit(path: Path, detail: float) -> None:
    """One node a joint and a moving part, under the kit's."""
    writer = GlbWriter()
    materials = KitMaterials.into(writer, detail)
    pieces: dict[str, tuple[Workpiece, Array, Array]] = {
        "standing": (standing(detail, materials), np.eye(3), np.zeros(3))
    }
    for drum in m.DRUMS:
        pieces[f"{drum.name}_head"] = (head(detail, materials, drum), frame(drum), np.array(drum.centre))
    for cymbal in m.CYMBALS:
        piece = bronze(detail, materials, cymbal)
        if cymbal is m.HI_HAT_TOP:
            piece.include(hat_moving(detail, materials), np.eye(3), (0, 0, 0))
        pieces[cymbal.name] = (piece, cymbal.rotation, np.array(cymbal.pivot))
    pieces["kick_beater"] = (beater(detail, materials), about_x(m.BEATER_REST_DEG), m.AXLE)
    for pedal in m.PEDALS:
        piece = board(detail, materials, pedal)
        if pedal is m.KICK_PEDAL:
            board_chain(piece, materials)
        pieces[pedal.name] = (piece, pedal.rotation, pedal.hinge)
    for piece, _, _ in pieces.values():
        piece.settle(GRID_M)
    surfaces = [
        (vertices @ turn.T + at, faces)
        for piece, turn, at in pieces.values()
        for vertices, _, faces in piece.surfaces().values()
    ]
    # The floor closes it in from below.
    floor = np.array([[x, -0.002, z] for x in (-1.4, 0.9) for z in (-0.4, 1.6)])
    cells = Cells(KIT, [*surfaces, (floor, np.array([[0, 1, 2], [1, 3, 2]]))])
    children: list[int] = []
    for name, (piece, turn, at) in pieces.items():
        primitives = piece.primitives(
            writer,
            materials.shades,
            cells,
            at,
            rotation=turn,
            pictured=materials.pictured,
            grained=(materials.bronze,) if detail >= materials.GRAINED_FROM else (),
        )
        mesh = writer.mesh(name, primitives)
        children.append(
            writer.node(name, mesh=mesh, translation=[float(x) for x in at], rotation=quaternion(turn))
        )
    writer.save(path, [writer.node("kit", children=children)])
