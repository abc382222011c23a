"""The right hand on the valves.

Every pad on its button over the whole stroke, thumb under the leadpipe, little finger at its hook.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from hold.grip import DEG, MM, Grip, beyond

Array = NDArray[np.float64]

HEIGHTS_M = (0.0, -0.0165, 0.004)  # valve up, valve down, finger resting off the cap
ABDUCTION_DEG = 12.0
THETA1_DEG = (-67.0, 77.0)  # limits less a margin of three degrees
THETA2_DEG = (-132.0, -3.0)
CURL_DEG = (-52.0, -56.0, -50.0)
START = np.array(  # place, rotation vector, swivel, shoulder; thumb
    [*(-0.122, 0.031, -0.004), *(-0.07, -0.04, 0.81), 0.74, -0.18, -0.02, *(0.62, -0.55, -0.32, 0.29, 0.27)]
)


@dataclass
class RightHand:
    """Targets in the instrument's frame: three `buttons` (3, 3), the `thumb` contact and the `hook`."""

    grip: Grip
    buttons: Array
    thumb: Array
    hook: Array
    heights: Array = field(default_factory=lambda: np.array([[0.0, h, 0.0] for h in HEIGHTS_M]))

    def fingers(self, rotation: Array, position: Array) -> tuple[list[Array], list[Array]]:
        """For each finger the angles (N, 4) at its targets (three heights.

        One for the little finger) and lacking reach (N,).
        """
        angles: list[Array] = []
        lacking: list[Array] = []
        for k, finger in enumerate(self.grip.fingers):
            targets = self.buttons[k] + self.heights if k < 3 else self.hook[None]
            a, gap = finger.solve((targets - position) @ rotation)
            angles.append(a)
            lacking.append(gap)
        return angles, lacking

    def residuals(self, x: Array) -> Array:
        """All residuals at once, for `least_squares`."""
        rotation, position, arm = self.grip.reach(x)
        angles, lacking = self.fingers(rotation, position)
        terms = self.grip.arm_cost(arm, x)
        for k in range(3):
            abduction, theta1, theta2, _ = angles[k].T * DEG
            terms += [
                lacking[k] * MM / 0.2,
                (theta2 - CURL_DEG[k])[:1] / 9,
                abduction[:1] / 7,
                (theta1[:1] + 20) / 9,
            ]
            terms += [
                beyond(abduction, -ABDUCTION_DEG, ABDUCTION_DEG) / 1.0,
                beyond(theta1, *THETA1_DEG) / 2,
                beyond(theta2, *THETA2_DEG) / 2,
            ]
            terms += [beyond(theta2, -69, -38) / 1.5]
            points = self.grip.fingers[k].points(angles[k][0]) @ rotation.T
            bone = (points[3] - points[2]) / np.linalg.norm(points[3] - points[2])
            terms.append(np.array([np.arcsin(np.clip(-bone[1], -1, 1)) * DEG - 48]) / 12)
        little = angles[3][0] * DEG
        terms += [
            lacking[3] * MM / 0.2,
            little[:1] / 9,
            (little[1:2] + 30) / 20,
            (little[2:3] + 42) / 14,
            beyond(little[:1], -18, 18) / 1.5,
            beyond(little[1:2], *THETA1_DEG) / 3,
            beyond(little[2:3], -95, -12) / 5,
        ]
        thumb_points, pad_direction = self.grip.thumb.points(x[9:14])
        thumb_points = position + thumb_points @ rotation.T
        terms.append((thumb_points[3] - self.thumb) * MM / [2.0, 0.7, 2.5])
        terms.append(self.grip.obstacles.clearance(thumb_points[3:]) * MM / 0.5)
        terms.append((rotation @ pad_direction - [0.40, 0.90, 0.15]) / 0.5)
        terms.append(thumb_cost(x[9:14]))
        terms += self._collisions(rotation, position, angles, x[9:14])
        return np.concatenate([np.ravel(t) for t in terms])

    def _collisions(self, rotation: Array, position: Array, angles: list[Array], thumb: Array) -> list[Array]:
        """Depths inside metal: palm, thumb, and the fingers' two inner bones with valves up and down."""
        spheres = [self.grip.palm_spheres(), self.grip.thumb.spheres(thumb, 4)]
        for k, finger in enumerate(self.grip.fingers):
            spheres += [finger.spheres(row, 3, bones=2) for row in angles[k][:2]]
        spheres.append(self.grip.fingers[3].spheres(angles[3][0], 4))
        return [self.grip.depth(rotation, position, *each) / 0.7 for each in spheres]


def thumb_cost(angles: Array) -> Array:
    """A thumb's residuals: near rest, inside its limits; angles (5,) rad."""
    a = angles * DEG
    limits = [
        beyond(a[0], -32, 32),
        beyond(a[1], -50, 36),
        beyond(a[2], -32, 32),
        beyond(a[3], -60, 15),
        beyond(a[4], -75, 15),
    ]
    return np.r_[a / [30, 35, 30, 40, 40], np.array(limits)]
