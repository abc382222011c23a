"""Figures in BVH files as programs write them: their joints' names, their rest pose, a pose."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from reina.rotations import IDENTITY, from_euler
from reina.skeleton import MotionClip

Angles = Mapping[str, tuple[float, float, float]]

POSES: dict[str, Angles] = {
    "one leg": {
        "hips": (0, 0, 7),
        "spine": (0, 0, -5),
        "chest": (0, 8, -5),
        "leftUpperLeg": (0, 0, -2),
        "rightUpperLeg": (-25, 10, -12),
        "rightLowerLeg": (45, 0, 0),
        "rightFoot": (-12, 0, 0),
    },
    "lunge": {
        "hips": (8, 15, 0),
        "spine": (8, -8, 0),
        "chest": (6, -8, 0),
        "leftUpperLeg": (-62, 8, 6),
        "leftLowerLeg": (54, 0, 0),
        "rightUpperLeg": (22, 0, -6),
        "rightLowerLeg": (34, 0, 0),
        "rightFoot": (-25, 0, 0),
    },
    "crouch": {
        "hips": (12, 0, 0),
        "spine": (12, 0, 0),
        "chest": (10, 0, 0),
        "leftUpperLeg": (-85, 12, 12),
        "leftLowerLeg": (95, 0, 0),
        "leftFoot": (-22, 0, 0),
        "rightUpperLeg": (-85, -12, -12),
        "rightLowerLeg": (95, 0, 0),
        "rightFoot": (-22, 0, 0),
    },
}
"""Degrees about x (forward), y (to the left) and z of each joint, in that order from the outside: y, x, z."""

_BONES: dict[str, tuple[str | None, tuple[float, float, float]]] = {
    "hips": (None, (0, 0, 0)),
    "spine": ("hips", (0, 10, 0)),
    "chest": ("spine", (0, 12, 0)),
    "neck": ("chest", (0, 22, 0)),
    "head": ("neck", (0, 8, 0)),
    "leftUpperArm": ("chest", (18, 16, 0)),
    "leftLowerArm": ("leftUpperArm", (26, 0, 0)),
    "rightUpperArm": ("chest", (-18, 16, 0)),
    "rightLowerArm": ("rightUpperArm", (-26, 0, 0)),
    "leftUpperLeg": ("hips", (9, -2, 0)),
    "leftLowerLeg": ("leftUpperLeg", (0, -42, 0)),
    "leftFoot": ("leftLowerLeg", (0, -40, 0)),
    "leftToes": ("leftFoot", (0, -7, 14)),
    "rightUpperLeg": ("hips", (-9, -2, 0)),
    "rightLowerLeg": ("rightUpperLeg", (0, -42, 0)),
    "rightFoot": ("rightLowerLeg", (0, -40, 0)),
    "rightToes": ("rightFoot", (0, -7, 14)),
}
"""A grown person in centimetres, by VRM's names."""

_TRUNK = ("hips", "spine", "chest", "neck", "head")
_LIMBS = ("UpperArm", "LowerArm", "UpperLeg", "LowerLeg", "Foot", "Toes")
NAMES: dict[str, tuple[str, str, str, str]] = {
    "CMU": ("Hips LowerBack Spine1 Neck Head", "Arm ForeArm UpLeg Leg Foot ToeBase", "Left{}", "Right{}"),
    "Mixamo": (
        "mixamorig:Hips mixamorig:Spine mixamorig:Spine2 mixamorig:Neck mixamorig:Head",
        "Arm ForeArm UpLeg Leg Foot ToeBase",
        "mixamorig:Left{}",
        "mixamorig:Right{}",
    ),
    "Rokoko": ("Hips Spine Spine2 Neck Head", "Arm ForeArm Thigh Shin Foot Toe", "Left{}", "Right{}"),
    "Blender": ("pelvis spine chest neck head", "upper_arm forearm thigh shin foot toe", "{}.L", "{}.R"),
    "3ds Max": (
        "Bip01_Pelvis Bip01_Spine Bip01_Spine1 Bip01_Neck Bip01_Head",
        "UpperArm Forearm Thigh Calf Foot Toe0",
        "Bip01 L {}",
        "Bip01 R {}",
    ),
    "Unreal": (
        "pelvis spine_01 spine_03 neck_01 head",
        "upperarm lowerarm thigh calf foot ball",
        "{}_l",
        "{}_r",
    ),
    "Daz": ("hip abdomen chest neck head", "Shldr ForeArm Thigh Shin Foot Toe", "l{}", "r{}"),
}
"""Trunk, limbs, and how left and right are told apart."""


def figure(
    pose: str | Angles = "lunge",
    names: str = "CMU",
    *,
    scale: float = 1.0,
    facing: float = 0.0,
    place: tuple[float, float, float] = (0.0, 90.0, 0.0),
) -> MotionClip:
    """Two frames at 10 a second: at rest, then in the pose, turned about the vertical by degrees."""
    trunk, limbs, left, right = NAMES[names]
    named: dict[str, str] = dict(zip(_TRUNK, trunk.split(), strict=True))
    for limb, name in zip(_LIMBS, limbs.split(), strict=True):
        named |= {f"left{limb}": left.format(name), f"right{limb}": right.format(name)}
    bones = list(_BONES)
    angles = POSES[pose] if isinstance(pose, str) else pose
    turned: Any = np.tile(IDENTITY, (2, len(bones), 1))
    for joint, bone in enumerate(bones):
        x, y, z = angles.get(bone, (0.0, 0.0, 0.0))
        turned[1, joint] = from_euler(np.radians([y + (facing if bone == "hips" else 0.0), x, z]), "yxz")
    parents = [-1 if _BONES[bone][0] is None else bones.index(str(_BONES[bone][0])) for bone in bones]
    return MotionClip.from_motion(
        tuple(named[bone] for bone in bones),
        np.array(parents, dtype=np.intp),
        scale * np.array([_BONES[bone][1] for bone in bones], dtype=np.float64),
        turned,
        scale * np.array([place, place]),
        0.1,
        order="zyx",
    )
