"""The left hand round the valve casings: index and middle finger round the third casing, ring finger in the third slide's
ring, little finger at the slide, thumb in the first slide's saddle, palm against the casings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hold.collision import along_bones
from hold.grip import DEG, MM, Grip, beyond, hand_turn
from hold.right_hand import thumb_cost

Array = NDArray[np.float64]

START = np.array(
    [0.045, -0.045, -0.035, *hand_turn([-0.15, 0.40, 0.90], [1.0, 0.1, 0.0]), 0.6, 0.0, 0.05, *np.zeros(5), *np.tile([0.0, -0.5, -0.9], 4)]
)
KAPPA = 0.6  # how far the outer joint follows while gripping
RING_BONE = 1  # the ring finger's middle bone passes the ring


@dataclass
class LeftHand:
    """Targets in the instrument's frame: `pads` (3, 3) of index, middle and little; `ring` and `saddle` places (3,)."""

    grip: Grip
    pads: Array
    ring: Array
    saddle: Array
    casing_x: float

    def angles(self, x: Array) -> list[Array]:
        rows = x[14:26].reshape(4, 3)
        return [np.array([a, t1, t2, KAPPA * t2]) for a, t1, t2 in rows]

    def residuals(self, x: Array) -> Array:
        rotation, position, arm = self.grip.reach(x)
        angles = self.angles(x)
        terms = self.grip.arm_cost(arm, x)
        chains = [position + f.points(a) @ rotation.T for f, a in zip(self.grip.fingers, angles, strict=True)]
        for chain, target, scale in zip((chains[0], chains[1], chains[3]), self.pads, (1.5, 1.5, 2.5), strict=True):
            terms.append((chain[3] - target) * MM / scale)
        terms.append(self._through_ring(chains[2]))
        for a in angles:
            abduction, theta1, theta2, _ = a * DEG
            terms.append(np.array([abduction / 12, (theta1 + 35) / 40, (theta2 + 55) / 35]))
            terms += [beyond(abduction, -17, 17) / 1.5, beyond(theta1, -67, 40) / 2, beyond(theta2, -74, -5) / 2]
        thumb_points, pad_direction = self.grip.thumb.points(x[9:14])
        thumb_points = position + thumb_points @ rotation.T
        terms.append((thumb_points[3] - self.saddle) * MM / 1.5)
        terms.append((rotation @ pad_direction - [-0.3, -0.9, 0.0]) / 0.6)
        terms.append(thumb_cost(x[9:14]))
        terms += self._collisions(rotation, position, chains, thumb_points)
        return np.concatenate([np.ravel(t) for t in terms])

    def _through_ring(self, chain: Array) -> Array:
        """The ring finger's middle bone goes through the middle of the ring, more or less square to it."""
        a, b = chain[RING_BONE], chain[RING_BONE + 1]
        t = np.clip((self.ring - a) @ (b - a) / ((b - a) @ (b - a)), 0.25, 0.9)
        miss = (a + t * (b - a) - self.ring) * MM
        direction = (b - a) / np.linalg.norm(b - a)
        return np.r_[miss[1:] / 1.0, miss[0] / 1.5, beyond(direction[0], -1.0, -0.75) / 0.15]

    def _collisions(self, rotation: Array, position: Array, chains: list[Array], thumb_points: Array) -> list[Array]:
        centres, radii = self.grip.palm_spheres()
        palm = position + centres @ rotation.T
        spheres = [(palm, radii, 0.0015)]
        for finger, chain in zip(self.grip.fingers, chains, strict=True):
            spheres.append((*along_bones(chain, finger.radii, 4), 0.0008))
        spheres.append((*along_bones(thumb_points, self.grip.thumb.radii, 4), 0.0008))
        terms = []
        for places, sizes, allowed in spheres:
            depth = sizes - allowed - self.grip.obstacles.clearance(places)
            terms.append(np.maximum(depth, 0) * MM / 0.8)
        gap = (self.grip.obstacles.clearance(palm) - radii).min()  # the palm rests against the casings
        terms.append(np.array([max(gap, 0.0) * MM / 4]))
        return terms
