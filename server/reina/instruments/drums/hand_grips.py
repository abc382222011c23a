"""What hands do with their sticks, as a table: fingers, and where the stick is in the hand."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.instruments.drums.motion.hand_shapes import HAND_SHAPES, PLAY
from reina.kinematics import clamp_to_limits, excess_over_limits
from reina.rotations import rotate, same_hemisphere, slerp
from reina.skeleton import GripKey

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from reina.rotations.arrays import FloatArray, IntArray
    from reina.skeleton import Hold, Rig

BOTH = np.arange(2)

ROWS = 512
"""So many rows of the table each shape has: no step between two of them can be seen."""

KEPT_RAD = 1e-3
"""What is beyond a joint's limits by less than this is kept as it is keyed."""


class HandGrips:
    """The hold's grips of both hands, ready to be looked up.

    A hold without grips leaves the hands as they are in its pose.

    Args:
        rig: The player's rig.
        hold: How the player holds the sticks.
        sticks: The names of the left and the right stick's skeletons.
        tips: Where their tips are, in their own frames, ``(2, 3)``, metres.

    Attributes:
        fingers: The joints that grips turn, the left hand's and then the right's, ``(2N,)``.
        turned: Their local rotations, rest included, ``(R, N, 4)``: by turns of the left and of the
            right hand, as all of the table's rows are.
        places: Where the sticks are in the hands, ``(R, 3)``, metres.
        rotations: How they lie there, ``(R, 4)``.
        points: What is to be at its place, in the hands' frames, ``(R, 3)``, metres.
        faces: Of each of `HAND_SHAPES` the ways along what the hands touch and out of it, ``(S, 2, 2, 3)``.
    """

    def __init__(self, rig: Rig, hold: Hold, sticks: Sequence[str], tips: FloatArray) -> None:
        rest = rig.skeleton.rest_rotations
        attached = [hold.attachments[name] for name in sticks]
        names = sorted({joint for keys in hold.grips.values() for joint in keys[0].pose})
        names.sort(key=lambda name: (not name.startswith("left"), name))
        self.fingers: IntArray = np.array([rig.skeleton.index(name) for name in names], dtype=np.intp)
        closed = GripKey(
            0.0,
            {},
            dict(hold.attachments),
            {
                name: one.position + rotate(one.rotation, tip)
                for name, one, tip in zip(sticks, attached, tips, strict=True)
            },
            {},
        )
        turned: list[FloatArray] = []
        sticks_at: list[FloatArray] = []
        straight_on = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
        self.faces: FloatArray = np.tile(straight_on, (len(HAND_SHAPES), 2, 1, 1))
        for row, name in enumerate(HAND_SHAPES):
            keys = hold.grips.get(name) or hold.grips.get(HAND_SHAPES[PLAY], (closed,))[:1]
            shares = np.array([key.share for key in keys])
            at = np.linspace(0.0, 1.0, ROWS)
            after = np.clip(np.searchsorted(shares, at, side="left"), min(1, len(keys) - 1), len(keys) - 1)
            before = np.maximum(after - 1, 0)
            u = ((at - shares[before]) / np.maximum(shares[after] - shares[before], 1e-9))[:, None, None]
            posed = np.array([[key.pose[joint] for joint in names] for key in keys]).reshape(len(keys), -1, 4)
            between = _within_limits(slerp(posed[before], posed[after], u[..., 0]), rig, self.fingers)
            turned.append(same_hemisphere(between, rest[self.fingers]))
            parts = [
                np.stack([[_of(key, name)[part] for name in sticks] for key in keys]) for part in range(3)
            ]
            rotations = slerp(parts[1][before], parts[1][after], u[..., 0])
            straight = [part[before] + (part[after] - part[before]) * u for part in (parts[0], parts[2])]
            sticks_at.append(np.concatenate([straight[0], rotations, straight[1]], axis=-1))
            for hand, stick in enumerate(sticks):
                if stick in keys[-1].faces:
                    self.faces[row, hand] = keys[-1].faces[stick]
        self.turned: NDArray[np.float32] = (
            np.concatenate(turned).reshape(-1, len(names) // 2, 4).astype(np.float32)
        )
        held = np.concatenate(sticks_at).reshape(-1, 10)
        self.places: FloatArray = held[..., :3]
        self.rotations: FloatArray = held[..., 3:7]
        self.points: FloatArray = held[..., 7:]

    def rows(self, shapes: IntArray, shares: FloatArray) -> IntArray:
        """Which rows of the table both hands are in that are so far along their shapes, ``(F, 2)``."""
        return 2 * (shapes * ROWS + np.rint(shares * (ROWS - 1)).astype(np.intp)) + BOTH


def _within_limits(turned: FloatArray, rig: Rig, joints: IntArray) -> FloatArray:
    """Local rotations ``(F, N, 4)``; the shortest way from one key to another may leave what is possible."""
    result = turned.copy()
    for place, joint in enumerate(joints.tolist()):
        if joint in rig.limits:
            one, rest, limits = turned[:, place], rig.skeleton.rest_rotations[joint], rig.limits[joint]
            beyond = excess_over_limits(one, rest, limits) > KEPT_RAD
            result[beyond, place] = clamp_to_limits(one[beyond], rest, limits)
    return result


def _of(key: GripKey, stick: str) -> tuple[FloatArray, FloatArray, FloatArray]:
    attached = key.attachments[stick]
    return attached.position, attached.rotation, key.points[stick]
