"""The player's joints by their VRM 1.0 names, and the source bones they come from."""

from __future__ import annotations

SIDES = (("left", "l"), ("right", "r"))
FINGERS = ("Index", "Middle", "Ring", "Little")
PHALANGES = ("Proximal", "Intermediate", "Distal")
THUMB = ("ThumbMetacarpal", "ThumbProximal", "ThumbDistal")
SOURCE_FINGERS = {"Index": "index", "Middle": "middle", "Ring": "ring", "Little": "pinky"}

# name: (parent, source bone at whose head the joint lies)
TRUNK = {
    "hips": (None, "pelvis"),
    "spine": ("hips", "spine_01"),
    "chest": ("spine", "spine_02"),
    "upperChest": ("chest", "spine_03"),
    "neck": ("upperChest", "neck_01"),
    "head": ("neck", "head"),
}
LIMBS = {
    "Shoulder": ("upperChest", "clavicle"),
    "UpperArm": ("Shoulder", "upperarm"),
    "LowerArm": ("UpperArm", "lowerarm"),
    "Hand": ("LowerArm", "hand"),
    "UpperLeg": ("hips", "thigh"),
    "LowerLeg": ("UpperLeg", "calf"),
    "Foot": ("LowerLeg", "foot"),
    "Toes": ("Foot", "ball"),
}


def source_bones() -> dict[str, tuple[str | None, str]]:
    """For each joint that has a source bone, parents first: its parent and that bone."""
    joints: dict[str, tuple[str | None, str]] = dict(TRUNK)
    for side, letter in SIDES:
        for name, (parent, bone) in LIMBS.items():
            full = parent if parent in TRUNK else f"{side}{parent}"
            joints[f"{side}{name}"] = (full, f"{bone}_{letter}")
        for k, part in enumerate(THUMB):
            joints[f"{side}{part}"] = (
                f"{side}{THUMB[k - 1]}" if k else f"{side}Hand",
                f"thumb_0{k + 1}_{letter}",
            )
        for finger in FINGERS:
            for k, part in enumerate(PHALANGES):
                parent = f"{side}{finger}{PHALANGES[k - 1]}" if k else f"{side}Hand"
                joints[f"{side}{finger}{part}"] = (parent, f"{SOURCE_FINGERS[finger]}_0{k + 1}_{letter}")
    return joints
