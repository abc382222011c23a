"""Where the fingers that press buttons have to be, in their hand's frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.kinematics import FingerChains
from reina.rotations import conjugate, product, rotate
from reina.skeleton import RigError

if TYPE_CHECKING:
    from reina.rotations.arrays import FloatArray
    from reina.skeleton import Rig

FINGER_LIFT_M = 0.0028
"""How far an idle finger's pad is off its cap at lift 1."""


class PressingFingers:
    """The fingers of one hand on an instrument's buttons.

    The hand keeps its place in the instrument's frame, so each target is linear in valve, lift and the
    hand's shift: no world transform is needed.

    Args:
        rig: The player's rig.
        instrument_rig: Its buttons say which effector presses what, where, how deep.
        hand: Index of the hand's joint.
        hand_position: The hand in the instrument's frame, ``(3,)``, metres.
        hand_rotation: Its rotation there, ``(4,)``.

    Raises:
        RigError: A button's effector has no finger, or one of another hand.
    """

    def __init__(
        self, rig: Rig, instrument_rig: Rig, hand: int, hand_position: FloatArray, hand_rotation: FloatArray
    ) -> None:
        buttons = instrument_rig.buttons
        chains = [rig.chain_of_effector(button.effector) for button in buttons]
        for button, chain in zip(buttons, chains, strict=True):
            if int(rig.skeleton.parents[chain.joints[0]]) != hand:
                raise RigError(
                    f"{button.effector!r} is not on the hand that presses the buttons", location="buttons"
                )
        self.chains = FingerChains(rig, [chain.name for chain in chains])
        # All that a target is made of, in the finger's own axes.
        to_hand = conjugate(hand_rotation)
        to_rest = self.chains.turn_to_rest
        position = np.array([button.position for button in buttons])
        travel = np.array([button.travel for button in buttons])
        up = -travel / np.sqrt(np.sum(travel * travel, axis=-1, keepdims=True))
        self._base: FloatArray = to_rest(rotate(to_hand, position - hand_position) - self.chains.origins)
        units = rotate(to_hand, np.eye(3))[:, None].repeat(len(buttons), axis=1)
        # How far each target goes with its own valve, its own lift, and each axis of the shift.
        own = np.eye(len(buttons))[..., None]
        ways = [
            own * to_rest(rotate(to_hand, travel)),
            own * to_rest(rotate(to_hand, up * FINGER_LIFT_M)),
            -to_rest(units),
        ]
        self._ways: FloatArray = np.concatenate(ways).reshape(2 * len(buttons) + 3, -1)

    def solve(self, valves: FloatArray, lifts: FloatArray, shifts: FloatArray) -> FloatArray:
        """The fingers' local rotations ``(F, K, 3, 4)``, in the order of the rig's buttons.

        Args:
            valves: How far down each finger's valve is, ``(F, K)``.
            lifts: How far each finger is off its cap, ``(F, K)``.
            shifts: How far the hand is from its place, in the instrument's frame, metres, ``(F, 3)``.
        """
        moved = product(np.concatenate([valves, lifts, shifts], axis=1), self._ways)
        return self.chains.rotations_at_rest(self._base + moved.reshape(-1, *self._base.shape))
