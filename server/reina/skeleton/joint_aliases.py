"""Which joint of a humanoid a name in a motion file means."""

from __future__ import annotations

import re
from functools import lru_cache

_TRUNK = {
    "hips": "hips pelvis root",
    "spine": "spine abdomen lowerback",
    "chest": "spine1 chest",
    "upperChest": "spine2 spine3 upperchest chest2",
    "neck": "neck neck1 neck01",
    "head": "head",
}
_SIDES = {
    "Shoulder": "shoulder collar clavicle",
    "UpperArm": "arm uparm upperarm uppershoulder",
    "LowerArm": "forearm lowarm lowerarm elbow",
    "Hand": "hand wrist",
    "UpperLeg": "upleg upperleg thigh hip upleg1 femur",
    "LowerLeg": "leg lowleg lowerleg calf shin knee tibia",
    "Foot": "foot ankle",
    "Toes": "toebase toe toes toe0 ball",
}

HUMANOID_NAMES: dict[str, str] = {
    alias: name for name, aliases in _TRUNK.items() for alias in aliases.split()
} | {
    f"{side}{alias}": f"{side}{name}"
    for side in ("left", "right")
    for name, aliases in _SIDES.items()
    for alias in aliases.split()
}
"""Joint names that motion files use, in lower case without prefix and separators, to VRM's humanoid names."""

_WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")
_SIDE = {"l": "left", "left": "left", "r": "right", "right": "right"}


@lru_cache(maxsize=4096)
def humanoid_name(name: str) -> str | None:
    """The VRM name of a joint in a motion file, None where it is none of `HUMANOID_NAMES`.

    ``mixamorig:LeftForeArm``, ``LeftForeArm``, ``left_forearm``, ``lForeArm``, ``forearm.L``, ``Bip01 L
    Forearm`` and ``Character1_LeftForeArm`` are all ``leftLowerArm``.
    """
    words = [word.lower() for word in _WORD.findall(name.rpartition(":")[2])]
    sides = [_SIDE[word] for word in words if word in _SIDE]
    rest = [word for word in words if word not in _SIDE]
    # What stands before the joint's own name is the figure's: Bip01, DEF, Character1.
    for begin in range(len(rest)):
        found = _known("".join(rest[begin:]), sides)
        if found is not None:
            return found
    return None


def _known(plain: str, sides: list[str]) -> str | None:
    if sides:
        return HUMANOID_NAMES.get(sides[0] + plain)
    # lfemur, rtibia: a side without a mark between.
    sided = HUMANOID_NAMES.get(_SIDE[plain[0]] + plain[1:]) if plain[:1] in _SIDE else None
    return HUMANOID_NAMES.get(plain, sided)
