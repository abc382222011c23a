"""How a player holds an instrument: a pose, and the instrument in it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

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
    """

    instrument: str
    player: str
    pose: dict[str, FloatArray]
    hips_position: FloatArray | None
    instrument_position: FloatArray
    instrument_rotation: FloatArray
    attachments: dict[str, Attachment] = field(default_factory=dict[str, Attachment])

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
    carried = document.get("attachments")
    return Hold(
        instrument=document["instrument"].text(),
        player=document["player"].text(),
        pose={name: rotation.quaternion() for name, rotation in document["pose"].members()},
        hips_position=None if hips is None else hips.numbers(3),
        instrument_position=place["position"].numbers(3),
        instrument_rotation=place["rotation"].quaternion(),
        attachments={
            name: Attachment(one["joint"].text(), one["position"].numbers(3), one["rotation"].quaternion())
            for name, one in (() if carried is None else carried.members())
        },
    )
