"""The left hand round the valve casings.

Index and middle finger lie round the third casing, the ring finger in the third slide's ring, the little
finger along the slide, the thumb in the first slide's saddle, the palm against the casings.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hold.grip import DEG, MM, Grip, beyond
from hold.right_hand import thumb_cost

Array = NDArray[np.float64]

START = np.array(  # place, rotation vector, swivel, shoulder; thumb; abduction, θ1, θ2 of each finger
    [
        *(0.064, -0.058, -0.027), *(-1.605, -1.863, -1.365), 0.5, 0.1, 0.1,
        *(-0.57, 0.39, -0.56, 0.16, 0.26),
        *(0.25, 0.0, -1.33), *(0.0, -0.13, -1.45), *(-0.25, 0.10, -0.64), *(0.20, 0.10, -0.70),
    ]
)  # fmt: skip
KAPPA = 0.5  # how far the outer joint follows while gripping
RING_BONE = 1  # the ring finger's middle bone passes the ring
PAD_HEIGHTS_M = (0.0185, 0.0030)  # of index and middle finger on the casing


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
        return [np.array([a, t1, t2, KAPPA * t2]) for a, t1, t2 in x[14:26].reshape(4, 3)]

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
        terms.append((chains[3][3] - self.slide) * MM / 7)
        terms.append(self.grip.obstacles.clearance(chains[3][3:]) * MM / 0.7)
        for a in angles:
            abduction, theta1, theta2, _ = a * DEG
            terms.append(np.array([abduction / 11, (theta1 + 30) / 40, (theta2 + 50) / 40]))
            terms += [
                beyond(abduction, -17, 17) / 1.5,
                beyond(theta1, -67, 12) / 2,
                beyond(theta2, -84, -6) / 2,
            ]
        thumb_points, looking = self.grip.thumb.points(x[9:14])
        terms.append((position + rotation @ thumb_points[3] - self.saddle) * MM / [2.0, 0.8, 1.5])
        terms.append((rotation @ looking - [-0.3, -0.8, -0.3]) / 0.8)
        terms.append(thumb_cost(x[9:14]))
        terms += self._collisions(rotation, position, angles, x[9:14])
        return np.concatenate([np.ravel(t) for t in terms])

    def _on_casing(self, pad: Array, looking: Array, height: float) -> Array:
        """The pad lies on the casing's right side, at a height, and looks at its axis."""
        spoke = np.array([pad[0], 0, pad[2] - self.casing_z])
        radius = float(np.linalg.norm(spoke))
        aside = beyond(pad[0], -1.0, -0.005) * MM
        square = 1 + looking @ spoke / radius
        return np.array(
            [(radius - self.casing_radius) * MM / 0.4, (pad[1] - height) * MM / 3, aside / 2, square / 0.35]
        )

    def _through_ring(self, chain: Array) -> Array:
        """The ring finger's middle bone goes through the middle of the ring, more or less square to it."""
        a, b = chain[RING_BONE], chain[RING_BONE + 1]
        t = np.clip((self.ring - a) @ (b - a) / ((b - a) @ (b - a)), 0.25, 1.2)
        miss = (a + t * (b - a) - self.ring) * MM
        direction = (b - a) / np.linalg.norm(b - a)
        return np.r_[miss[1:] / 1.0, miss[0] / 1.5, beyond(direction[0], -1.0, -0.7) / 0.15]

    def _collisions(self, rotation: Array, position: Array, angles: list[Array], thumb: Array) -> list[Array]:
        """Depths inside metal, fingers inside one another, and the palm's gap from the casings."""
        fingers = [f.spheres(a, 5) for f, a in zip(self.grip.fingers, angles, strict=True)]
        palm = self.grip.palm_spheres()
        terms = [
            self.grip.depth(rotation, position, *each) / 0.7
            for each in (*fingers, self.grip.thumb.spheres(thumb, 4))
        ]
        terms.append(self.grip.depth(rotation, position, *palm, allowed_m=0.002) / 0.7)
        for (first, first_radii), (second, second_radii) in itertools.pairwise(fingers):
            gap = np.linalg.norm(first[5:, None] - second[None, 5:], axis=2)  # inner bones lie in one palm
            depth = first_radii[5:, None] + second_radii[None, 5:] - 0.0015 - gap
            terms.append(np.maximum(depth, 0) * MM / 1.0)
        resting = (self.grip.obstacles.clearance(position + palm[0] @ rotation.T) - palm[1]).min()
        terms.append(np.array([max(resting, 0.0) * MM / 3]))
        return terms
