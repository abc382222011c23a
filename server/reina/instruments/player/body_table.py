"""How gestures look on a body: a table from signals to turns of joints, and the matrix that it makes.

Turns are rotation vectors, radians, about the world's axes as the player stands in the rest pose (+x the
player's left, +y up, +z ahead), at signal 1. Positive x bows forward, positive y turns left, positive z
tips to the right.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.rotations import conjugate, rotate
from reina.skeleton import forward_kinematics

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from reina.rotations.arrays import FloatArray
    from reina.skeleton import Rig

Vector = tuple[float, float, float]

SIGNALS: tuple[str, ...] = (
    "breath",
    "sway_side",
    "sway_fore",
    "sway_turn",
    "lean",
    "turn",
    "effort",
    "gaze_left",
    "gaze_up",
    "torso_bow",
    "torso_turn",
    "torso_tip",
    "head_bow",
    "head_turn",
    "head_tip",
    "eyes_left",
    "eyes_up",
)
"""What moves every player's trunk and eyes; the last eight are keyed by a show, in radians."""

TRUNK: tuple[str, ...] = (
    "hips",
    "spine",
    "chest",
    "upperChest",
    "neck",
    "head",
    "leftShoulder",
    "rightShoulder",
)
"""Joints that gestures turn and whose world transforms the arms need, parents first; a rig may lack some."""

EYES: tuple[str, ...] = ("leftEye", "rightEye")

TURNS: dict[str, dict[str, Vector]] = {
    "breath": {
        "spine": (-0.008, 0.0, 0.0),
        "chest": (-0.024, 0.0, 0.0),
        "upperChest": (-0.020, 0.0, 0.0),
        "neck": (0.026, 0.0, 0.0),
        "head": (0.014, 0.0, 0.0),
        "leftShoulder": (0.0, -0.012, 0.050),
        "rightShoulder": (0.0, 0.012, -0.050),
    },
    "sway_side": {
        "hips": (0.0, 0.0, 0.010),
        "spine": (0.0, 0.0, -0.018),
        "chest": (0.0, 0.0, -0.016),
        "upperChest": (0.0, 0.0, -0.008),
        "neck": (0.0, 0.0, 0.010),
        "head": (0.0, 0.0, 0.008),
    },
    "sway_fore": {
        "hips": (0.006, 0.0, 0.0),
        "spine": (0.010, 0.0, 0.0),
        "chest": (0.010, 0.0, 0.0),
        "neck": (-0.010, 0.0, 0.0),
    },
    "sway_turn": {
        "hips": (0.0, 0.010, 0.0),
        "spine": (0.0, 0.012, 0.0),
        "chest": (0.0, 0.014, 0.0),
        "neck": (0.0, -0.010, 0.0),
    },
    "lean": {
        "hips": (0.012, 0.0, 0.0),
        "spine": (0.032, 0.0, 0.0),
        "chest": (0.030, 0.0, 0.0),
        "upperChest": (0.020, 0.0, 0.0),
        "neck": (-0.022, 0.0, 0.0),
        "head": (-0.018, 0.0, 0.0),
        "leftShoulder": (0.0, -0.010, -0.006),
        "rightShoulder": (0.0, 0.010, 0.006),
    },
    "turn": {
        "hips": (0.0, 0.018, 0.0),
        "spine": (0.0, 0.026, 0.0),
        "chest": (0.0, 0.028, 0.008),
        "upperChest": (0.0, 0.020, 0.006),
        "head": (0.0, 0.0, -0.014),
    },
    "effort": {
        "chest": (-0.012, 0.0, 0.0),
        "upperChest": (-0.018, 0.0, 0.0),
        "neck": (-0.018, 0.0, 0.0),
        "head": (-0.022, 0.0, 0.0),
        "leftShoulder": (0.0, 0.0, 0.020),
        "rightShoulder": (0.0, 0.0, -0.020),
    },
    "gaze_left": {"leftEye": (0.0, 0.22, 0.0), "rightEye": (0.0, 0.22, 0.0)},
    "gaze_up": {"leftEye": (-0.10, 0.0, 0.0), "rightEye": (-0.10, 0.0, 0.0)},
    "torso_bow": {"spine": (0.40, 0.0, 0.0), "chest": (0.35, 0.0, 0.0), "upperChest": (0.25, 0.0, 0.0)},
    "torso_turn": {"spine": (0.0, 0.40, 0.0), "chest": (0.0, 0.35, 0.0), "upperChest": (0.0, 0.25, 0.0)},
    "torso_tip": {"spine": (0.0, 0.0, 0.40), "chest": (0.0, 0.0, 0.35), "upperChest": (0.0, 0.0, 0.25)},
    "head_bow": {"neck": (0.45, 0.0, 0.0), "head": (0.55, 0.0, 0.0)},
    "head_turn": {"neck": (0.0, 0.45, 0.0), "head": (0.0, 0.55, 0.0)},
    "head_tip": {"neck": (0.0, 0.0, 0.45), "head": (0.0, 0.0, 0.55)},
    "eyes_left": {"leftEye": (0.0, 1.0, 0.0), "rightEye": (0.0, 1.0, 0.0)},
    "eyes_up": {"leftEye": (-1.0, 0.0, 0.0), "rightEye": (-1.0, 0.0, 0.0)},
}
"""Signal -> joint -> turn."""

SHIFTS: dict[str, Vector] = {
    "breath": (0.0, 0.0015, 0.0),
    "sway_side": (0.013, 0.0, 0.0),
    "sway_fore": (0.0, -0.0005, 0.006),
    "lean": (0.0, -0.0015, 0.004),
    "turn": (0.004, 0.0, 0.0),
}
"""Signal -> shift of the hips, metres."""


def body_matrix(
    rig: Rig,
    joints: Sequence[str],
    signals: Sequence[str] = SIGNALS,
    *,
    joint_turns: Mapping[str, Mapping[str, Vector]] | None = None,
    turns: Sequence[Mapping[str, Vector]] = (),
    shifts: Sequence[Mapping[str, Vector]] = (),
) -> FloatArray:
    """The table as a matrix for a rig.

    Args:
        rig: The player's rig.
        joints: The first columns: three for each of these joints' rotation vectors, in the joint's own rest
            frame.
        signals: The rows: `SIGNALS`, and others that `joint_turns`, `turns` and `shifts` name.
        joint_turns: More of what `TURNS` has, of other signals.
        turns: What else is turned, signal -> rotation vector, three columns each.
        shifts: What else than the hips is shifted, signal -> metres, three columns each, after the hips'.

    Returns:
        ``(len(signals), 3 * (len(joints) + len(turns) + 1 + len(shifts)))``.
    """
    _, rest_world = forward_kinematics(rig.skeleton, rig.skeleton.rest_rotations)
    others = (*turns, SHIFTS, *shifts)
    table = {**TURNS, **(joint_turns or {})}
    matrix = np.zeros((len(signals), len(joints) + len(others), 3))
    for row, signal in enumerate(signals):
        of_signal = table.get(signal, {})
        for column, joint in enumerate(joints):
            if joint in of_signal:
                world_to_joint = conjugate(rest_world[rig.skeleton.index(joint)])
                matrix[row, column] = rotate(world_to_joint, of_signal[joint])
        for column, other in enumerate(others, start=len(joints)):
            matrix[row, column] = other.get(signal, (0.0, 0.0, 0.0))
    return matrix.reshape(len(signals), -1)
