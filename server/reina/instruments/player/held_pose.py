"""A player in the hold: where every joint and the instrument are."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reina.rotations import conjugate, multiply, rotate
from reina.skeleton import forward_kinematics

if TYPE_CHECKING:
    from reina.rotations.arrays import FloatArray, IntArray
    from reina.skeleton import Hold, Rig


class HeldPose:
    """The playing position, worked out.

    Args:
        rig: The player's rig.
        hold: How the player holds the instrument.

    Raises:
        RigError: The hold's pose names a joint that the rig has not.
    """

    def __init__(self, rig: Rig, hold: Hold) -> None:
        skeleton = rig.skeleton
        self.rotations: FloatArray = hold.rotations(rig)
        """Local rotations, rest included, ``(J, 4)``."""
        hips = hold.hips_position
        self.root: FloatArray = skeleton.rest_translations[0] if hips is None else hips
        """The root in the world, metres, ``(3,)``."""
        self.positions, self.world = forward_kinematics(skeleton, self.rotations, self.root)
        self.instrument_rotation = hold.instrument_rotation
        self.instrument_position = hold.instrument_position

    def in_instrument(self, joints: IntArray) -> tuple[FloatArray, FloatArray]:
        """Positions ``(K, 3)`` and rotations ``(K, 4)`` of joints in the instrument's frame."""
        to_instrument = conjugate(self.instrument_rotation)
        positions = rotate(to_instrument, self.positions[joints] - self.instrument_position)
        return positions, multiply(to_instrument, self.world[joints])
