"""How the player stands: a relaxed stance with the weight a little on the left leg.

Feet flat, head upright.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from hold.rig import Pose, Rig, turn

Array = NDArray[np.float64]

HIPS_SHIFT_M = np.array([0.012, -0.0075, -0.004])
TURNS_DEG = {  # about X (forward bend), Y (to the left), Z (raises the left side)
    "hips": (0.0, 4.0, 1.2),
    "spine": (-1.0, -1.5, -0.9),
    "chest": (-1.0, -1.5, -0.9),
    "upperChest": (-1.5, -1.0, 0.2),
    "neck": (4.0, 0.0, 0.2),
}
HEAD_WORLD_DEG = (-2.0, 0.0, 0.0)
FEET_M = {"left": (0.105, 0.020), "right": (-0.115, -0.030)}  # each ankle's x and z
TOES_OUT_DEG = {"left": 11.0, "right": 15.0}


@dataclass
class Stance:
    """Whole local rotations of trunk and legs, and the hips' world position (3,)."""

    pose: Pose
    hips: Array


def stand(rig: Rig) -> Stance:
    """Trunk as written above, the head levelled, each leg solved so that its foot is flat on the floor."""
    pose: Pose = {
        name: rig.rests[name] @ turn("yxz", *np.radians([y, x, z])) for name, (x, y, z) in TURNS_DEG.items()
    }
    hips = rig.translations["hips"] + HIPS_SHIFT_M
    neck = rig.world(pose, hips)["neck"][0]
    pose["head"] = neck.T @ turn("x", np.radians(HEAD_WORLD_DEG[0]))
    for side in ("left", "right"):
        pose.update(_leg(rig, pose, hips, side))
    return Stance(pose, hips)


def _leg(rig: Rig, pose: Pose, hips: Array, side: str) -> Pose:
    outward = 1.0 if side == "left" else -1.0
    rest = rig.world({}, None)
    ankle = np.array(
        [FEET_M[side][0], rest[f"{side}Foot"][1][1], rest[f"{side}Foot"][1][2] + FEET_M[side][1]]
    )
    rest_toe = rest[f"{side}Toes"][1] - rest[f"{side}Foot"][1]
    already_out = np.arctan2(outward * rest_toe[0], rest_toe[2])
    flat = turn("y", outward * (np.radians(TOES_OUT_DEG[side]) - already_out))

    def legs(x: Array) -> Pose:
        return {f"{side}UpperLeg": turn("yxz", *x[:3]), f"{side}LowerLeg": turn("x", x[3])}

    def error(x: Array) -> Array:
        place = rig.world({**pose, **legs(x)}, hips)[f"{side}Foot"][1]
        knee_forward = x[0] - outward * np.radians(TOES_OUT_DEG[side] * 0.6)
        return np.r_[(place - ankle) * 1000, 0.01 * knee_forward]

    found = least_squares(error, np.array([0.0, -0.1, 0.0, 0.15]), xtol=1e-15, ftol=1e-15, gtol=1e-15)
    result = legs(found.x)
    knee = rig.world({**pose, **result}, hips)[f"{side}LowerLeg"][0]
    result[f"{side}Foot"] = knee.T @ flat
    return result
