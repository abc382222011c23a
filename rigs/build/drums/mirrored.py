"""The kit of a left-handed player: the mirror image of the other, as a rig of its own."""

from __future__ import annotations

import json
import struct
from typing import TYPE_CHECKING, Any

from common.rig_file import write_json
from drums.kit import DETAIL, NAME, write_kit
from drums.kit_file import kit_content

if TYPE_CHECKING:
    from pathlib import Path

LEFT_HANDED = f"{NAME}_left_handed"

Numbers = list[float]


def build_left_handed_kit(raw: Path, rig_folder: Path) -> None:
    """Write its models, not yet compressed, into `raw`, and rig.json into `rig_folder`."""
    for tier, detail in DETAIL.items():
        model = raw / f"{NAME}.{tier}.glb"
        if not model.exists():
            write_kit(model, detail)
        (raw / f"{LEFT_HANDED}.{tier}.glb").write_bytes(mirrored_model(model.read_bytes()))
    write_json(rig_folder / "rig.json", mirrored_content(kit_content()))


def mirrored_model(glb: bytes) -> bytes:
    """A model whose nodes are the mirror images of another's, each with its mesh on a node that mirrors it.

    No vertex changes: in glTF triangles turn round where a node mirrors them. Joints keep a scale of 1.
    """
    (length,) = struct.unpack_from("<I", glb, 12)
    content: dict[str, Any] = json.loads(glb[20 : 20 + length])
    nodes: list[dict[str, Any]] = content["nodes"]
    for node in list(nodes):
        if "translation" in node:
            node["translation"] = place(node["translation"])
        if "rotation" in node:
            node["rotation"] = turn(node["rotation"])
        if "mesh" in node:
            node.setdefault("children", []).append(len(nodes))
            name = f"{node['name']}_mirrored"
            nodes.append({"name": name, "mesh": node.pop("mesh"), "scale": [-1.0, 1.0, 1.0]})
    text = json.dumps(content, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    rest = glb[20 + length :]
    head = struct.pack("<III", 0x46546C67, 2, 20 + len(text) + len(rest))
    return head + struct.pack("<II", len(text), 0x4E4F534A) + text + rest


def mirrored_content(content: dict[str, Any]) -> dict[str, Any]:
    """rig.json of the mirror image: what is a foot's is the other foot's; pieces keep their names."""
    result = dict(content, name=LEFT_HANDED)
    result["joints"] = [_joint(joint) for joint in content["joints"]]
    result["contacts"] = [
        dict(contact, name=other_side(contact["name"]), offset=place(contact["offset"]))
        for contact in content["contacts"]
    ]
    for kind in ("capsules", "cylinders"):
        result[kind] = [
            dict(solid, **{end: place(solid[end]) for end in ("from", "to")}) for solid in content[kind]
        ]
    result["parts"] = [dict(part, travel=place(part["travel"])) for part in content["parts"]]
    result["zones"] = [
        dict(zone, position=place(zone["position"]), normal=place(zone["normal"]))
        for zone in content["zones"]
    ]
    return result


def place(at: Numbers) -> Numbers:
    """A place or a direction on the other side."""
    x, y, z = at
    return [-x, y, z]


def turn(rotation: Numbers) -> Numbers:
    """A quaternion's mirror image."""
    x, y, z, w = rotation
    return [x, -y, -z, w]


def other_side(name: str) -> str:
    """`leftPedal` of `rightPedal`; what begins with no side keeps its name."""
    for side, other in (("left", "right"), ("right", "left")):
        if name.startswith(side):
            return other + name.removeprefix(side)
    return name


def _joint(joint: dict[str, Any]) -> dict[str, Any]:
    result = dict(joint, translation=place(joint["translation"]), rotation=turn(joint["rotation"]))
    if "limits" in joint:
        limits = dict(joint["limits"])
        for axis in "yz":
            low, high = limits[axis]
            limits[axis] = [-high, -low]
        result["limits"] = limits
    return result
