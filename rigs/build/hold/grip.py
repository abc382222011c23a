"""What both hands' searches share: a hand on an arm, with measures that the objectives weigh."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from hold.arm import Arm, ArmPose
from hold.collision import Obstacles, along_bones
from hold.finger import Finger
from hold.thumb import Thumb

if TYPE_CHECKING:
    from hold.rig import Pose, Rig
    from hold.stance import Stance

Array = NDArray[np.float64]

FINGERS = ("Index", "Middle", "Ring", "Little")
MM = 1000.0
DEG = 180.0 / np.pi
ELBOW_FROM_SHOULDER_M = {"right": np.array([-0.130, -0.200, 0.125]), "left": np.array([0.105, -0.205, 0.140])}
VALVES_FROM_LIPS_M = 0.2738
"""For valves this far in front of the lips; where they are nearer, the elbow hangs as much further back."""
ELBOW_WITH_VALVES = {"right": np.array([-0.25, -0.25, -1.0]), "left": np.array([0.25, -0.25, -1.0])}


def beyond(value: Array | float, low: float, high: float) -> Array:
    """How far a value lies outside low … high, signed."""
    return np.minimum(np.asarray(value) - low, 0) + np.maximum(np.asarray(value) - high, 0)


@dataclass
class Grip:
    """One hand to be placed on an instrument whose world pose is (rotation, position)."""

    rig: Rig
    side: str
    stance: Stance
    instrument: tuple[Array, Array]
    obstacles: Obstacles
    valves_from_lips: float
    """How far the second valve is in front of the lips, metres."""

    def __post_init__(self) -> None:
        nearer = VALVES_FROM_LIPS_M - self.valves_from_lips
        self.elbow = ELBOW_FROM_SHOULDER_M[self.side] + nearer * ELBOW_WITH_VALVES[self.side]
        world = self.rig.world(self.stance.pose, self.stance.hips)
        self.arm = Arm(self.rig, self.side, world["upperChest"])
        self.shoulder = world[f"{self.side}UpperArm"][1]
        self.fingers = [Finger.of(self.rig, f"{self.side}{name}") for name in FINGERS]
        self.thumb = Thumb.of(self.rig, self.side)
        self.forearm = [c for c in self.rig.content["capsules"] if c["joint"] == f"{self.side}LowerArm"]
        self.palm = [c for c in self.rig.content["capsules"] if c["joint"] == f"{self.side}Hand"]

    def reach(self, x: Array) -> tuple[Array, Array, ArmPose]:
        """Hand rotation and position in the instrument's frame, and the arm.

        `x` is position m, rotation vector, swivel, shoulder (2).
        """
        turn, place = self.instrument
        rotation = Rotation.from_rotvec(x[3:6]).as_matrix()
        arm = self.arm.reach(place + turn @ x[:3], turn @ rotation, x[6], x[7:9])
        return rotation, x[:3], arm

    def arm_cost(self, arm: ArmPose, x: Array) -> list[Array]:
        """Residuals of posture: shoulder relaxed, elbow out and down, wrist straight, all in reach."""
        twist, flexion, deviation = arm.wrist * DEG
        return [
            np.array([arm.lacking * MM]),
            (arm.elbow - self.shoulder - self.elbow) / [0.03, 0.05, 0.05],
            x[7:9] * DEG / 3,
            np.array([twist / 60, flexion / 6, deviation / 6]),
            beyond(twist, -85, 85)[None] / 4,
            beyond(flexion, -30, 12.5)[None] / 0.6,
            beyond(deviation, -11, 11)[None] / 0.4,
        ]

    def forearm_depth(self, x: Array) -> float:
        """How deep the forearm lies inside the instrument, metres; negative where it is clear of it."""
        turn, place = self.instrument
        arm = self.reach(x)[2]
        wrist = place + turn @ x[:3]
        radius = max(float(c["radius"]) for c in self.forearm)
        points, radii = along_bones(np.array([arm.elbow, wrist]), np.array([radius]), 12)
        return float((radii - self.obstacles.clearance((points - place) @ turn)).max())

    def palm_spheres(self) -> tuple[Array, Array]:
        """Spheres that stand for the palm, in the hand's frame."""
        parts = [along_bones(np.array([c["from"], c["to"]]), np.array([c["radius"]]), 5) for c in self.palm]
        return np.vstack([p for p, _ in parts]), np.concatenate([r for _, r in parts])

    def depth(
        self, rotation: Array, position: Array, centres: Array, radii: Array, allowed_m: float = 0.0005
    ) -> Array:
        """How deep (P,), mm, spheres of the hand lie inside the instrument, less what flesh gives."""
        inside = radii - allowed_m - self.obstacles.clearance(position + centres @ rotation.T)
        deep: Array = np.maximum(inside, 0) * MM
        return deep

    def pose(self, arm: ArmPose, fingers: list[Array], thumb: Array) -> Pose:
        """Local rotations of the whole arm with its hand."""
        result = {**arm.local, **self.thumb.local_rotations(thumb)}
        for finger, angles in zip(self.fingers, fingers, strict=True):
            result.update(finger.local_rotations(angles))
        return result
