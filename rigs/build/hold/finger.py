"""A finger as a planar arm of three bones with coupled outer joints, θ3 = κ θ2, the pad alone given.

With κ = 1/3 and u = cos(θ2/3) the squared distance from knuckle to pad is a quartic in u that has one root in
[√½, 1] for every target within reach.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hold.collision import along_bones
from hold.rig import Rig, turn

Array = NDArray[np.float64]

KAPPA = 1 / 3
PAD_DEPTH = 0.95  # the bone lies this many radii under the pad
PARTS = ("Proximal", "Intermediate", "Distal")
MIN_THETA2 = np.radians(-135.0)


@dataclass
class Finger:
    """`knuckle` (3,) and `rest` (3, 3) in the hand's frame; bone `lengths` (3,) m.

    Planar `rest_angles` (3,) rad.
    """

    name: str
    knuckle: Array
    rest: Array
    lengths: Array
    rest_angles: Array
    radii: Array

    @classmethod
    def of(cls, rig: Rig, name: str) -> Finger:
        """From the rig; `name` is e.g. "rightIndex"."""
        joints = [f"{name}{part}" for part in PARTS]
        pad = rig.effector(f"{name}Tip")[1]
        bones = [rig.translations[joints[1]], rig.translations[joints[2]], pad]
        rest = rig.rests[joints[0]]
        turns = [np.arctan2(rig.rests[j][1, 0], rig.rests[j][0, 0]) for j in joints[1:]]
        radii = [next(c["radius"] for c in rig.content["capsules"] if c["joint"] == j) for j in joints]
        first = float(np.arcsin(rest[1, 0]))
        lengths = np.array([float(np.linalg.norm(b)) for b in bones])
        return cls(
            name, rig.translations[joints[0]], rest, lengths, np.array([first, *turns]), np.array(radii)
        )

    def solve(self, targets: Array) -> tuple[Array, Array]:
        """For pad targets (N, 3) in the hand's frame.

        Angles (N, 4) abduction, θ1, θ2, θ3, and what reach lacks (N,) m.
        """
        local = (targets - self.knuckle) @ self.rest
        abduction = np.arctan2(-local[:, 2], local[:, 0])
        x, y = np.hypot(local[:, 0], local[:, 2]), local[:, 1]
        distance = np.hypot(x, y)
        nearest, farthest = self._reach(np.array([MIN_THETA2]))[0], self.lengths.sum()
        reachable = np.clip(distance, nearest + 1e-6, farthest - 1e-6)
        low, high = np.full(len(x), MIN_THETA2), np.zeros(len(x))
        for _ in range(44):  # the reach grows with θ2, so halving finds the one root
            middle = (low + high) / 2
            short = self._reach(middle) < reachable
            low, high = np.where(short, middle, low), np.where(short, high, middle)
        theta2 = (low + high) / 2
        l1, l2, l3 = self.lengths
        outer = theta2 * (1 + KAPPA)
        bend = np.arctan2(
            l2 * np.sin(theta2) + l3 * np.sin(outer), l1 + l2 * np.cos(theta2) + l3 * np.cos(outer)
        )
        theta1 = np.arctan2(y, x) - bend + self.rest_angles[0]
        return np.column_stack([abduction, theta1, theta2, KAPPA * theta2]), distance - reachable

    def _reach(self, theta2: Array) -> Array:
        l1, l2, l3 = self.lengths
        outer = theta2 * (1 + KAPPA)
        reach: Array = np.hypot(
            l1 + l2 * np.cos(theta2) + l3 * np.cos(outer), l2 * np.sin(theta2) + l3 * np.sin(outer)
        )
        return reach

    def points(self, angles: Array) -> Array:
        """Knuckle, middle joint, outer joint and pad (4, 3) in the hand's frame, for angles (4,)."""
        abduction, theta1, theta2, theta3 = angles
        direction = np.cumsum([theta1 - self.rest_angles[0], theta2, theta3])
        x = np.r_[0, np.cumsum(self.lengths * np.cos(direction))]
        y = np.r_[0, np.cumsum(self.lengths * np.sin(direction))]
        plane = np.column_stack([x * np.cos(abduction), y, -x * np.sin(abduction)])
        return self.knuckle + plane @ self.rest.T

    def spheres(self, angles: Array, samples: int, bones: int = 3) -> tuple[Array, Array]:
        """Spheres (P, 3), (P,) that stand for the finger's first `bones` bones, in the hand's frame.

        The last touches the pad.
        """
        points = self.points(angles)
        direction = angles[1] - self.rest_angles[0] + angles[2] + angles[3]
        dorsal = np.array(
            [-np.sin(direction) * np.cos(angles[0]), np.cos(direction), np.sin(direction) * np.sin(angles[0])]
        )
        points[3] = points[3] + PAD_DEPTH * self.radii[2] * (self.rest @ dorsal)
        return along_bones(points[: bones + 1], self.radii[:bones], samples)

    def pad_direction(self, angles: Array) -> Array:
        """Where the pad looks (3,), in the hand's frame.

        Square to the line from outer joint to pad, on the palm's side.
        """
        direction = angles[1] - self.rest_angles[0] + angles[2] + angles[3]
        palmar = np.array(
            [
                np.sin(direction) * np.cos(angles[0]),
                -np.cos(direction),
                -np.sin(direction) * np.sin(angles[0]),
            ]
        )
        looking: Array = self.rest @ palmar
        return looking

    def local_rotations(self, angles: Array) -> dict[str, Array]:
        """The three joints' whole local rotations for angles (4,)."""
        abduction, theta1, theta2, theta3 = angles
        first = self.rest @ turn("yz", abduction, theta1 - self.rest_angles[0])
        values = (first, turn("z", theta2), turn("z", theta3))
        return {f"{self.name}{part}": value for part, value in zip(PARTS, values, strict=True)}
