"""An arm of two bones that brings the hand to a pose; the elbow is a pure turn about the hinge Y."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from hold.rig import Rig, turn

Array = NDArray[np.float64]


@dataclass
class ArmPose:
    """Local rotations by joint, the elbow's world position.

    The wrist's twist, flexion and deviation (rad), lacking reach (m).
    """

    local: dict[str, Array]
    elbow: Array
    wrist: Array
    lacking: float


@dataclass
class Arm:
    """One side's arm over a fixed upper chest (world rotation and position)."""

    rig: Rig
    side: str
    chest: tuple[Array, Array]

    def reach(self, hand_position: Array, hand_rotation: Array, swivel: float, shoulder: Array) -> ArmPose:
        """Place the wrist at a world pose.

        `swivel` turns the elbow about the line shoulder–wrist, 0 is straight down.
        """
        rig, side = self.rig, self.side
        joints = [f"{side}{part}" for part in ("Shoulder", "UpperArm", "LowerArm", "Hand")]
        outward = 1.0 if side == "left" else -1.0
        clavicle = rig.rests[joints[0]] @ turn("yz", outward * shoulder[0], outward * shoulder[1])
        frame = self.chest[0] @ clavicle
        root = (
            self.chest[1] + self.chest[0] @ rig.translations[joints[0]] + frame @ rig.translations[joints[1]]
        )
        upper, lower = (float(np.linalg.norm(rig.translations[j])) for j in joints[2:])
        line = hand_position - root
        distance = float(np.linalg.norm(line))
        within = min(distance, (upper + lower) * 0.9995)
        along = line / distance
        down = np.array([0.0, -1.0, 0.0]) - along * -along[1]
        down /= np.linalg.norm(down)
        aside = np.cross(along, down)
        aside *= np.sign(aside[0]) * outward
        bend = (upper**2 + within**2 - lower**2) / (2 * within)
        height = np.sqrt(max(upper**2 - bend**2, 1e-12))
        elbow = root + along * bend + height * (np.cos(swivel) * down + np.sin(swivel) * aside)
        x = (elbow - root) / upper
        forearm = root + along * within - elbow
        z = forearm - x * (x @ forearm)
        z *= outward / np.linalg.norm(z)
        upper_frame = np.column_stack([x, np.cross(z, x), z])
        angle = np.arccos(np.clip(x @ forearm / lower, -1, 1))
        elbow_turn = turn("y", -outward * angle)
        wrist_local = (upper_frame @ elbow_turn).T @ hand_rotation
        wrist = Rotation.from_matrix(rig.rests[joints[3]].T @ wrist_local).as_euler("XZY")
        local = dict(zip(joints, (clavicle, frame.T @ upper_frame, elbow_turn, wrist_local), strict=True))
        return ArmPose(local, elbow, wrist, distance - within)
