"""The left hand round the valve casings.

Index and middle finger lie round the third casing with their tips back toward the palm, the ring finger goes
through the third slide's ring, the little finger curls against the slide, the thumb is bent in the first
slide's saddle, and the heel of the palm rests on the casings.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hold.grip import DEG, MM, Grip, beyond
from hold.right_hand import thumb_cost

Array = NDArray[np.float64]

START = np.array(  # place, rotation vector, swivel, shoulder; thumb; abduction, θ1, θ2, θ3 of each finger
    [
        *(0.0411, -0.0770, -0.0306), *(-1.907, -1.786, -1.015), -0.02, 0.20, 0.18,
        *(-0.09, 0.54, -0.61, 0.22, -0.50),
        *(0.32, 0.13, -1.43, -0.24), *(0.04, -0.03, -1.50, -0.77),
        *(-0.09, 0.05, -0.74, -0.53), *(-0.30, -0.19, -1.50, -0.76),
    ]
)  # fmt: skip
RING_BONE = 1  # the ring finger's middle bone passes the ring
PAD_HEIGHTS_M = (0.0180, 0.0020)  # of index and middle finger on the casing
CURL_DEG = (-62.0, -62.0, -55.0, -60.0)
LITTLE_BACK_M = 0.006  # the little finger's pad lies behind its outer joint
HEEL_SAMPLES = 2  # of the palm's spheres along each capsule, those next to the wrist


@dataclass
class LeftHand:
    """Places in the instrument's frame (3,): `ring`, bottom of the `saddle`, `slide` for the little finger.

    The third casing stands at `casing_z` with `casing_radius`.
    """

    grip: Grip
    ring: Array
    saddle: Array
    slide: Array
    casing_z: float
    casing_radius: float

    def angles(self, x: Array) -> list[Array]:
        """Abduction, θ1, θ2, θ3 (4,) of each finger."""
        return list(x[14:30].reshape(4, 4))

    def residuals(self, x: Array) -> Array:
        """All residuals at once, for `least_squares`."""
        rotation, position, arm = self.grip.reach(x)
        angles = self.angles(x)
        terms = self.grip.arm_cost(arm, x)
        chains = [position + f.points(a) @ rotation.T for f, a in zip(self.grip.fingers, angles, strict=True)]
        for k, height in enumerate(PAD_HEIGHTS_M):
            looking = rotation @ self.grip.fingers[k].pad_direction(angles[k])
            terms.append(self._on_casing(chains[k][3], looking, height))
        terms.append(self._through_ring(chains[2]))
        terms.append((chains[3][3] - self.slide) * MM / 4)
        terms.append(self.grip.obstacles.clearance(chains[3][3:]) * MM / 0.3)
        turned_back = (chains[3][3] - chains[3][2])[2]  # or else the finger would lie along the slide
        terms.append(np.array([max(turned_back + LITTLE_BACK_M, 0.0) * MM / 0.5]))
        for a, curl in zip(angles, CURL_DEG, strict=True):
            abduction, theta1, theta2, theta3 = a * DEG
            terms.append(
                np.array([abduction / 9, (theta1 + 22) / 25, (theta2 - curl) / 12, (theta3 + 26) / 9])
            )
            terms += [
                beyond(abduction, -16, 16) / 0.4,
                beyond(theta1, -67, 8) / 2,
                beyond(theta2, -84, -44) / 0.7,
                beyond(theta3, -42, -15) / 0.7,
            ]
        thumb_points, looking = self.grip.thumb.points(x[9:14])
        terms.append((position + rotation @ thumb_points[3] - self.saddle) * MM / [0.5, 0.4, 1.0])
        terms.append((rotation @ looking - [-0.3, -0.85, -0.3]) / 0.6)
        terms.append(thumb_cost(x[9:14]))
        terms.append((x[13:14] * DEG + 30) / 8)
        terms += self._collisions(rotation, position, angles, x[9:14])
        return np.concatenate([np.ravel(t) for t in terms])

    def _on_casing(self, pad: Array, looking: Array, height: float) -> Array:
        """The pad lies on the casing's right side, at a height, and looks at its axis."""
        spoke = np.array([pad[0], 0, pad[2] - self.casing_z])
        radius = float(np.linalg.norm(spoke))
        aside = beyond(pad[0], -1.0, -0.007) * MM
        square = 1 + looking @ spoke / radius
        return np.array(
            [(radius - self.casing_radius) * MM / 0.3, (pad[1] - height) * MM / 3, aside / 0.8, square / 0.3]
        )

    def _through_ring(self, chain: Array) -> Array:
        """The ring finger's middle bone goes through the middle of the ring, more or less square to it."""
        a, b = chain[RING_BONE], chain[RING_BONE + 1]
        t = np.clip((self.ring - a) @ (b - a) / ((b - a) @ (b - a)), 0.2, 1.1)
        miss = (a + t * (b - a) - self.ring) * MM
        direction = (b - a) / np.linalg.norm(b - a)
        return np.r_[miss[1:] / 0.8, miss[0] / 1.5, beyond(direction[0], -1.0, -0.75) / 0.15]

    def _collisions(self, rotation: Array, position: Array, angles: list[Array], thumb: Array) -> list[Array]:
        """Depths inside metal, fingers inside one another, and the palm's gap from the casings."""
        fingers = [f.spheres(a, 6) for f, a in zip(self.grip.fingers, angles, strict=True)]
        palm = self.grip.palm_spheres()
        terms = [
            self.grip.depth(rotation, position, *each) / 0.27
            for each in (*fingers, self.grip.thumb.spheres(thumb, 4))
        ]
        terms.append(self.grip.depth(rotation, position, *palm, allowed_m=0.002) / 0.7)
        for (first, first_radii), (second, second_radii) in itertools.pairwise(fingers):
            gap = np.linalg.norm(first[4:, None] - second[None, 4:], axis=2)  # the knuckles lie in one palm
            depth = first_radii[4:, None] + second_radii[None, 4:] - 0.0012 - gap
            terms.append(np.maximum(depth, 0) * MM / 0.8)
        gaps = self.grip.obstacles.clearance(position + palm[0] @ rotation.T) - palm[1]
        terms.append(np.array([max(float(gaps.min()), 0.0) * MM / 2]))
        heel = gaps.reshape(len(self.grip.palm), -1)[:, :HEEL_SAMPLES]
        terms.append(np.array([max(float(heel.min()), 0.0) * MM / 1.7]))
        return terms
