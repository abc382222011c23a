"""How a player holds an instrument: a pose, and the instrument in it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from reina.skeleton.document import Node, read_document

if TYPE_CHECKING:
    from pathlib import Path

    from reina.rotations.arrays import FloatArray
    from reina.skeleton.rig import Rig


@dataclass(frozen=True, eq=False)
class Attachment:
    """Something that a joint carries along.

    Attributes:
        joint: The joint's name.
        position: Where its root is in the joint's frame, metres, ``(3,)``.
        rotation: How it is turned there, ``(4,)``.
    """

    joint: str
    position: FloatArray
    rotation: FloatArray


@dataclass(frozen=True, eq=False)
class GripKey:
    """One pose of something that hands do with what they carry.

    Attributes:
        share: How far along it is, 0 to 1.
        pose: Local rotations by joint name, rest included, ``(4,)`` each.
        attachments: Where what is carried is meanwhile, by the name of its skeleton.
        points: What is to be at its place meanwhile, in the frame of the joint that carries, metres,
            ``(3,)``, by the name of the skeleton.
        faces: Where hands are placed by themselves: which ways they go along what they touch, and out of it,
            in the same frame, unit vectors ``(2, 3)``.
    """

    share: float
    pose: dict[str, FloatArray]
    attachments: dict[str, Attachment]
    points: dict[str, FloatArray]
    faces: dict[str, FloatArray]


@dataclass(frozen=True, eq=False)
class Hold:
    """A playing position.

    Attributes:
        instrument: The instrument rig's name.
        player: The player rig's name.
        pose: Local rotations by joint name, rest included, ``(4,)`` each; joints not in it are at rest.
        hips_position: The root in the world, metres, ``(3,)``; None where it is at rest.
        instrument_position: The instrument's root in the world, metres, ``(3,)``.
        instrument_rotation: Its rotation in the world, ``(4,)``.
        attachments: What else is carried, by the name of its skeleton.
        grips: What hands do with it, by name: keys by their share, the first at 0, the last at 1.
    """

    instrument: str
    player: str
    pose: dict[str, FloatArray]
    hips_position: FloatArray | None
    instrument_position: FloatArray
    instrument_rotation: FloatArray
    attachments: dict[str, Attachment] = field(default_factory=dict[str, Attachment])
    grips: dict[str, tuple[GripKey, ...]] = field(default_factory=dict[str, "tuple[GripKey, ...]"])

    def rotations(self, rig: Rig) -> FloatArray:
        """Local rotations of all of the player's joints in this position, ``(J, 4)``.

        Raises:
            RigError: The pose names a joint that the rig has not.
        """
        rotations = rig.skeleton.rest_rotations.copy()
        for name, rotation in self.pose.items():
            rotations[rig.skeleton.index(name)] = rotation
        return rotations


def load_hold(folder: Path, instrument: str) -> Hold:
    """How the player in ``folder`` holds an instrument: ``holds/<instrument>.json``.

    Raises:
        RigError: There is no such hold, or its document lacks something.
    """
    return read_hold(read_document(folder / "holds" / f"{instrument}.json"))


def read_hold(document: Node) -> Hold:
    """The hold that a document describes; raises as `load_hold` does."""
    place = document["instrument_pose"]
    hips = document.get("hips")
    grips = document.get("grips")
    return Hold(
        instrument=document["instrument"].text(),
        player=document["player"].text(),
        pose={name: rotation.quaternion() for name, rotation in document["pose"].members()},
        hips_position=None if hips is None else hips.numbers(3),
        instrument_position=place["position"].numbers(3),
        instrument_rotation=place["rotation"].quaternion(),
        attachments=_attachments(document),
        grips={} if grips is None else {name: _grip_keys(grips, name) for name, _ in grips.members()},
    )


def _attachments(document: Node) -> dict[str, Attachment]:
    carried = document.get("attachments")
    return {
        name: Attachment(one["joint"].text(), one["position"].numbers(3), one["rotation"].quaternion())
        for name, one in (() if carried is None else carried.members())
    }


def _grip_keys(grips: Node, name: str) -> tuple[GripKey, ...]:
    """Keys of one grip; a joint that a key leaves out is as in the key before."""
    keys: list[GripKey] = []
    pose: dict[str, FloatArray] = {}
    for entry in grips.items(name):
        pose = pose | {joint: rotation.quaternion() for joint, rotation in entry["pose"].members()}
        faces = entry.get("faces")
        share = entry["share"].number()
        if share <= keys[-1].share if keys else share != 0.0:
            raise entry["share"].fail("the shares of a grip's keys begin at 0 and grow to 1")
        keys.append(
            GripKey(
                share=share,
                pose=pose,
                attachments=_attachments(entry),
                points={stick: point.numbers(3) for stick, point in entry["points"].members()},
                faces={
                    stick: np.stack([face["along"].numbers(3), face["out"].numbers(3)])
                    for stick, face in (() if faces is None else faces.members())
                },
            )
        )
    if len(keys) < 2 or keys[-1].share != 1.0:
        raise grips[name].fail("the shares of a grip's keys begin at 0 and grow to 1")
    return tuple(keys)
