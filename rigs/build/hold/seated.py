"""How a drummer sits: upright on the stool, the balls of the feet on two pedals, heels up."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from hold.rig import Pose, Rig, turn
from hold.stance import Stance

if TYPE_CHECKING:
    from collections.abc import Mapping

Array = NDArray[np.float64]

SITTING_M = 0.092
"""From the stool's top to the hip joints."""
FORWARD_M = -0.035
"""How far before the stool's middle the hip joints are."""
TURNS_DEG = {  # about X (forward bend), Y (to the left), Z (raises the left side)
    "hips": (-3.0, 0.0, 0.0),
    "spine": (3.0, 0.0, 0.0),
    "chest": (3.0, 0.0, 0.0),
    "upperChest": (2.0, 0.0, 0.0),
    "neck": (6.0, 0.0, 0.0),
}
HEAD_WORLD_DEG = 12.0
"""How far the head looks down, to the kit."""
HEEL_UP_DEG = 17.0


@dataclass
class Footing:
    """Where a foot is: the ball's place (3,), how far outward the toes point and its pitch, rad."""

    ball: Array
    out_rad: float
    pitch_rad: float


def sit(rig: Rig, stool_top_m: float, feet: Mapping[str, Footing]) -> Stance:
    """Trunk as written above, the head toward the kit, each leg solved so that its ball is on the pedal."""
    pose: Pose = {
        name: rig.rests[name] @ turn("yxz", *np.radians([y, x, z])) for name, (x, y, z) in TURNS_DEG.items()
    }
    rest = rig.world({}, None)
    down = rest["hips"][1][1] - rest["leftUpperLeg"][1][1]
    hips = np.array([0.0, stool_top_m + SITTING_M + down, FORWARD_M])
    neck = rig.world(pose, hips)["neck"][0]
    pose["head"] = neck.T @ turn("x", np.radians(HEAD_WORLD_DEG))
    for side, footing in feet.items():
        pose.update(_leg(rig, pose, hips, side, footing))
    return Stance(pose, hips)


def foot_place(rig: Rig, side: str, footing: Footing) -> tuple[Array, Array]:
    """The foot's world rotation (3, 3) and the ankle's place (3,) where its ball is on the pedal."""
    outward = 1.0 if side == "left" else -1.0
    rest = rig.world({}, None)
    foot, toes = rest[f"{side}Foot"], rest[f"{side}Toes"]
    ahead = toes[1] - foot[1]
    already_out = np.arctan2(outward * ahead[0], ahead[2])
    rotation = (
        turn("yx", outward * footing.out_rad, footing.pitch_rad) @ turn("y", -outward * already_out) @ foot[0]
    )
    ball = foot[0].T @ (np.array([toes[1][0], 0.0, toes[1][2]]) - foot[1])
    return rotation, footing.ball - rotation @ ball


def _leg(rig: Rig, pose: Pose, hips: Array, side: str, footing: Footing) -> Pose:
    rotation, ankle = foot_place(rig, side, footing)
    outward = 1.0 if side == "left" else -1.0

    def legs(x: Array) -> Pose:
        upper = rig.rests[f"{side}UpperLeg"] @ turn("yxz", *x[:3])
        return {f"{side}UpperLeg": upper, f"{side}LowerLeg": rig.rests[f"{side}LowerLeg"] @ turn("x", x[3])}

    def error(x: Array) -> Array:
        world = rig.world({**pose, **legs(x)}, hips)
        knee, place = world[f"{side}LowerLeg"][1], world[f"{side}Foot"][1]
        # The knee lies over the line that the foot points along.
        toward = np.array([outward * np.cos(footing.out_rad), 0.0, -np.sin(footing.out_rad)])
        wrung = np.abs(x[[0, 2]]) - np.radians([38.0, 24.0])
        return np.r_[(place - ankle) * 1000, (knee - ankle) @ toward * 20.0, np.maximum(wrung, 0.0) * 100.0]

    found = least_squares(error, np.array([0.0, -1.4, 0.0, 1.5]), xtol=1e-15, ftol=1e-15, gtol=1e-15)
    result = legs(found.x)
    knee = rig.world({**pose, **result}, hips)[f"{side}LowerLeg"][0]
    result[f"{side}Foot"] = knee.T @ rotation
    return result
