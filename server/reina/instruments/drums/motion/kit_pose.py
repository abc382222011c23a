"""The kit's rig: where it is struck, and how what moves of it is turned."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from reina.curves import Parameter
from reina.instruments.drums.motion.kit_answers import HEADS, SWINGS
from reina.instruments.drums.motion.kit_places import UP, KitPlaces, ZonePlace
from reina.instruments.drums.motion.stick_paths import turned
from reina.rotations import about_axis, multiply, rotate
from reina.skeleton import RigError, forward_kinematics

if TYPE_CHECKING:
    from reina.instruments.drums.motion.drummer_motion import DrummerFrames
    from reina.rotations.arrays import FloatArray
    from reina.skeleton import Rig

HI_HAT: Final = "drums/hi_hat/pedal"
"""The parameter that closes the hi-hat."""

PEDALS: Final = ("kick_pedal", "hi_hat_pedal")
"""Joints of the boards, in the order of `FootFrames`."""

BEATER: Final = "kick_beater"

PARAMETERS: Final = (
    Parameter(
        path=HI_HAT,
        type="number",
        default=1.0,
        minimum=0.0,
        maximum=1.0,
        documentation="How far the hi-hat is closed: 0 open, 1 closed.",
    ),
    *(
        Parameter(
            path=f"drums/{head}/head",
            type="number",
            default=0.0,
            minimum=0.0,
            maximum=1.0,
            documentation=f"How far the head of the {head.replace('_', ' ')} gives under a stroke.",
        )
        for head in HEADS
    ),
)
"""What a drum kit streams."""


def cymbal_joint(piece: str) -> str:
    """The joint that a cymbal turns about."""
    return "hi_hat_top" if piece == "hi_hat" else piece


def kit_places(kit: Rig) -> KitPlaces:
    """Where a kit's rig is struck, at rest.

    Raises:
        RigError: It has no zones.
    """
    positions, rotations = forward_kinematics(kit.skeleton, kit.skeleton.rest_rotations)
    return KitPlaces(
        ZonePlace(
            piece,
            name,
            positions[zone.joint] + rotate(rotations[zone.joint], zone.position),
            rotate(rotations[zone.joint], zone.normal),
            zone.radius,
            positions[zone.joint],
            rotate(rotations[zone.joint], UP),
        )
        for (piece, name), zone in kit.zones.items()
    )


def part_travel(kit: Rig, parameter: str) -> FloatArray:
    """How a part goes as its parameter goes from 0 to 1, metres, ``(3,)``; 0 where nothing goes."""
    travels = [part.travel for part in kit.parts if part.parameter == parameter and part.travel is not None]
    return travels[0] if travels else np.zeros(3)


class KitPose:
    """Turns what answers into the rotations of the kit's joints.

    Args:
        kit: Its rig: a joint for each cymbal, the beater and the pedals' boards, all hung on the root.

    Raises:
        RigError: One of these is not there.
    """

    def __init__(self, kit: Rig) -> None:
        skeleton = kit.skeleton
        places = kit_places(kit)
        wanted = [cymbal_joint(piece) for piece in SWINGS] + [BEATER, *PEDALS]
        lost = [name for name in wanted if name not in skeleton]
        if lost:
            raise RigError(f"a drum kit has a joint {lost[0]!r}", location="joints")
        joints = np.array([skeleton.index(name) for name in wanted], dtype=np.intp)
        self._swinging, self._hinged = joints[: len(SWINGS)], joints[len(SWINGS) :]
        self._outward: FloatArray = np.stack([places[piece, "edge"].outward for piece in SWINGS])
        limits = [kit.limits.get(int(joint)) for joint in self._hinged]
        self._farthest: FloatArray = np.array([0.0 if one is None else one.maximum[0] for one in limits])
        self._rest: FloatArray = skeleton.rest_rotations

    def rotations(self, drummed: DrummerFrames) -> FloatArray:
        """Local rotations of the kit's joints, rest included, ``(F, N, 4)``."""
        tilt = drummed.kit.tilt
        frames = len(tilt)
        result = np.empty((frames, *self._rest.shape))
        result[:] = self._rest
        # Nothing turns by as much as half a turn: all stay in the hemisphere of their rest.
        result[:, self._swinging] = multiply(turned(self._outward, tilt), self._rest[self._swinging])
        angles = np.stack([drummed.feet.beater, *drummed.feet.pedal.T], axis=1) * self._farthest
        result[:, self._hinged] = multiply(self._rest[self._hinged], about_axis(0, angles))
        return result

    def parameters(self, drummed: DrummerFrames) -> FloatArray:
        """The values of `PARAMETERS`, ``(F, P)``."""
        return np.concatenate([drummed.kit.hi_hat[:, None], drummed.kit.heads], axis=1)
