"""Joint limits, chains and twist helpers of the player's rig.

A limit is of rest⁻¹·q, decomposed as R_a(α)·R_b(β)·R_c(γ) for `order` "abc". Fingers' limits come from the
planar model's angles (degrees: θ1 −70…80 from the palm plane, θ2 −135…0, θ3 −45…0), less the angles at rest.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from body.joint_names import FINGERS, PHALANGES, SIDES

if TYPE_CHECKING:
    from body.skeleton import Skeleton

Array = NDArray[np.float64]
Limits = dict[str, Any]

THETA_DEG = {"Proximal": (-70.0, 80.0), "Intermediate": (-135.0, 0.0), "Distal": (-45.0, 0.0)}
ABDUCTION_DEG = 20.0
COUPLING = 1 / 3  # θ3 = κ θ2

# For a left joint, degrees; on the right X stays and, where the axes are the arm's, Y is mirrored.
BODY_DEG: dict[str, tuple[str, tuple[float, float], tuple[float, float], tuple[float, float]]] = {
    "spine": ("yxz", (-20, 30), (-20, 20), (-15, 15)),
    "chest": ("yxz", (-20, 30), (-20, 20), (-15, 15)),
    "upperChest": ("yxz", (-20, 25), (-20, 20), (-15, 15)),
    "neck": ("yxz", (-25, 30), (-40, 40), (-20, 20)),
    "head": ("yxz", (-25, 30), (-40, 40), (-20, 20)),
    "leftEye": ("yxz", (-25, 25), (-35, 35), (0, 0)),
    "leftShoulder": ("yzx", (-15, 15), (-30, 25), (-10, 35)),
    # At rest the arm is near 48 below the level: z ends 36 past hanging, as an arm before the body does.
    "leftUpperArm": ("yzx", (-100, 100), (-130, 60), (-78, 110)),
    "leftLowerArm": ("yxz", (0, 0), (-110, 38), (0, 0)),
    "leftHand": ("xzy", (-110, 110), (-35, 25), (-75, 70)),
    "leftThumbMetacarpal": ("yzx", (-35, 35), (-40, 40), (-55, 40)),
    "leftThumbProximal": ("yzx", (-10, 10), (-10, 10), (-65, 20)),
    "leftThumbDistal": ("yzx", (0, 0), (0, 0), (-80, 25)),
    "leftUpperLeg": ("yxz", (-120, 30), (-45, 45), (-30, 50)),
    "leftLowerLeg": ("xyz", (0, 140), (0, 0), (0, 0)),
    "leftFoot": ("yxz", (-30, 50), (-25, 25), (-25, 25)),
    "leftToes": ("xyz", (-45, 30), (0, 0), (0, 0)),
}
MIRRORED_Y_AND_Z = ("Shoulder", "UpperLeg", "Foot", "Eye")  # joints whose rest axes are the world's


def joint_limits(skeleton: Skeleton) -> dict[str, Limits]:
    """Limits by joint, radians, for the joints that have them."""
    limits: dict[str, Limits] = {}
    for name, (order, x, y, z) in BODY_DEG.items():
        limits[name] = _radians(order, x, y, z)
        if name.startswith("left"):
            part = name.removeprefix("left")
            mirror_z = part in MIRRORED_Y_AND_Z
            limits[f"right{part}"] = _radians(order, x, (-y[1], -y[0]), (-z[1], -z[0]) if mirror_z else z)
    for side, _ in SIDES:
        for finger in FINGERS:
            for part in PHALANGES:
                low, high = (
                    angle - rest_angle_deg(skeleton, side, finger, part) for angle in THETA_DEG[part]
                )
                spread = (-ABDUCTION_DEG, ABDUCTION_DEG) if part == "Proximal" else (0.0, 0.0)
                limits[f"{side}{finger}{part}"] = _radians("yzx", (0, 0), spread, (low, high))
    return limits


def rest_angle_deg(skeleton: Skeleton, side: str, finger: str, phalanx: str) -> float:
    """A finger bone's planar angle at rest.

    Of the proximal bone from the palm plane, of the others from the bone before.
    """
    joint = f"{side}{finger}{phalanx}"
    if phalanx == "Proximal":
        x_in_hand = skeleton.axes[f"{side}Hand"].T @ skeleton.axes[joint][:, 0]
        return float(np.degrees(np.arcsin(x_in_hand[1])))
    turn = skeleton.axes[skeleton.parents[joint] or ""].T @ skeleton.axes[joint]
    return float(np.degrees(np.arctan2(turn[1, 0], turn[0, 0])))


def _radians(order: str, x: tuple[float, float], y: tuple[float, float], z: tuple[float, float]) -> Limits:
    ranges = {axis: [float(np.radians(v)) for v in pair] for axis, pair in (("x", x), ("y", y), ("z", z))}
    return {"order": order, **ranges}


def chains() -> list[dict[str, Any]]:
    """Which joints a solver may move, with which solver and settings."""
    result: list[dict[str, Any]] = []
    for side, _ in SIDES:
        arm = [f"{side}{part}" for part in ("UpperArm", "LowerArm", "Hand")]
        result.append({"name": f"{side}Arm", "joints": arm, "solver": "two_bone"})
        leg = [f"{side}{part}" for part in ("UpperLeg", "LowerLeg", "Foot")]
        result.append({"name": f"{side}Leg", "joints": leg, "solver": "two_bone"})
        result.extend(
            {
                "name": f"{side}{finger}",
                "joints": [f"{side}{finger}{part}" for part in PHALANGES],
                "effector": f"{side}{finger}Tip",
                "solver": "coupled_three_bone",
                "kappa": COUPLING,
            }
            for finger in FINGERS
        )
    return result


def twists() -> list[dict[str, Any]]:
    """A helper turns about its X by `fraction` of the twist that rest⁻¹·q of its source has about X."""
    result: list[dict[str, Any]] = []
    for side, _ in SIDES:
        result.append({"joint": f"{side}LowerArmTwist1", "source": f"{side}Hand", "fraction": 0.5})
        result.append({"joint": f"{side}UpperArmTwist1", "source": f"{side}UpperArm", "fraction": -0.5})
    return result
