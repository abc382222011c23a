"""A player as a rig: models of three tiers and rig.json."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from body.contacts import capsules, contacts
from body.eyes import eyes
from body.figure import MORPHS, Figure, shape_figure
from body.images import eye_picture, hair_picture, jpeg
from body.limits import chains, joint_limits, twists
from body.skeleton import Skeleton, build_skeleton
from body.skin import bare_skin, lashes, lip_centre, paint_skin, texel_positions
from body.skinning import skin_weights
from common.export import write_skinned
from common.occlusion import shaded
from common.parts import Part, Surface
from common.rig_file import write_json
from dress.cropped_hair import cropped
from dress.hair import bob
from dress.suit import LONGER_M, suit_parts
from dress.tailor import Tailor
from dress.trimmings import trimming_parts
from dress.uniform import blazer, coat, uniform_parts

if TYPE_CHECKING:
    from pathlib import Path

    from body.figure_file import FigureFile

Array = NDArray[np.float64]

HAIR = {"bob": bob, "cropped": cropped}
MORPH_PARAMETERS = {
    "face/blink_left": "eyeBlinkLeft",
    "face/blink_right": "eyeBlinkRight",
    "face/cheek_puff": "cheekPuff",
    "face/mouth_pucker": "mouthPucker",
    "face/mouth_press": "mouthPress",
    "face/jaw_open": "jawOpen",
    "face/brow_up": "browInnerUp",
    "face/smile": "mouthSmile",
}


@dataclass(frozen=True)
class Tier:
    """How finely a tier is built before it is reduced: cloth, hair, skirt grid, eyes, collars."""

    subdivisions: int
    lock_steps: int
    lock_sides: int
    lock_share: float
    skirt_rows: int
    eye_grid: tuple[int, int]
    collar_detail: float


TIERS = {
    "full": Tier(1, 16, 10, 1.0, 26, (24, 40), 1.0),
    "medium": Tier(1, 12, 7, 0.9, 18, (16, 28), 0.7),
    "low": Tier(0, 7, 5, 0.5, 8, (8, 14), 0.36),
}


def build_player(data: Path, raw: Path, rig_folder: Path, file: FigureFile) -> None:
    """Write `<name>.<tier>.glb`, not yet compressed, into `raw`, and rig.json into `rig_folder`."""
    figure = shape_figure(data, file)
    skeleton = build_skeleton(figure)
    weights = skin_weights(figure, skeleton)
    positions, covered = texel_positions(figure)
    mouth = lip_centre(figure, positions, covered)
    skin = bare_skin(figure, skeleton, weights, paint_skin(file, figure, skeleton, positions, covered))
    tailor = Tailor.measure(figure, skeleton, weights)
    hair = Surface(
        "hair", 0.60, image=jpeg(hair_picture(file.hair_tint), 92), both_sides=True, shade=(0.30, 0.26, 0.25)
    )
    iris = eye_picture(file.iris_inner, file.iris_outer)
    formal = file.outfit == "suit"
    buttoned = -1.0 if formal else 1.0
    for name, tier in TIERS.items():
        cloth = coat(tailor, tier.subdivisions, buttoned)
        outer = blazer(
            tailor,
            cloth,
            buttoned,
            longer_m=LONGER_M if formal else 0.0,
            turned_in=tier.subdivisions > 0,
        )
        locks, hair_normals = HAIR[file.hair](tailor, tier.lock_steps, tier.lock_sides, tier.lock_share)
        clothes = (
            suit_parts(tailor, tier.subdivisions, outer, file.colours)
            if formal
            else uniform_parts(tailor, tier.subdivisions, tier.skirt_rows, outer, file.colours)
        )
        parts = [
            skin,
            lashes(figure, weights, file.lash_length),
            eyes(figure, skeleton, iris, *tier.eye_grid),
            *clothes,
            *trimming_parts(
                tailor, cloth, outer, clothes[0].mesh, tier.collar_detail, file.colours, formal=formal
            ),
            Part("Hair", locks, hair, hair_normals),
        ]
        shaded(parts)
        write_skinned(raw / f"{file.name}.{name}.glb", file.name, skeleton, parts)
    write_json(rig_folder / "rig.json", rig_content(file.name, figure, skeleton, weights, mouth))


def rig_content(
    name: str, figure: Figure, skeleton: Skeleton, weights: Array, mouth: Array
) -> dict[str, Any]:
    """What rig.json says of the player."""
    limits = joint_limits(skeleton)
    joints: list[dict[str, Any]] = []
    for joint_name, parent in skeleton.parents.items():
        translation, rotation = skeleton.local(joint_name)
        joint = {
            "name": joint_name,
            "parent": parent,
            "translation": translation.tolist(),
            "rotation": rotation.tolist(),
            "node": joint_name,
        }
        if joint_name in limits:
            joint["limits"] = limits[joint_name]
        joints.append(joint)
    return {
        "name": name,
        "licence": "CC0-1.0",
        "models": {tier: f"{tier}.glb" for tier in TIERS},
        "joints": joints,
        "effectors": [
            {"name": effector, "joint": joint, "offset": skeleton.to_local(joint, point).tolist()}
            for effector, (joint, point) in skeleton.effectors.items()
        ],
        "contacts": contacts(figure, skeleton, mouth),
        "capsules": capsules(figure, skeleton, weights),
        "morphs": [
            {"parameter": path, "target": target}
            for path, target in MORPH_PARAMETERS.items()
            if target in MORPHS
        ],
        "chains": chains(),
        "twists": twists(),
    }
