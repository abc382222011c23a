"""How deep sampled spheres of a hand lie inside capsules of an instrument."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Obstacles:
    """Capsules (N) in the instrument's frame."""

    def __init__(self, capsules: list[dict[str, Any]]) -> None:
        self.start = np.array([c["from"] for c in capsules])
        self.bone = np.array([c["to"] for c in capsules]) - self.start
        self.radius = np.array([c["radius"] for c in capsules])
        self.square = np.maximum((self.bone**2).sum(axis=1), 1e-12)

    def clearance(self, points: Array) -> Array:
        """Distance (P,) from each point (P, 3) to the nearest surface, negative inside."""
        offset = points[:, None] - self.start
        t = np.clip((offset * self.bone).sum(axis=2) / self.square, 0, 1)
        gap = np.linalg.norm(offset - t[..., None] * self.bone, axis=2) - self.radius
        nearest: Array = gap.min(axis=1)
        return nearest


def along_bones(points: Array, radii: Array, samples: int = 4) -> tuple[Array, Array]:
    """Sphere centres (P, 3) and radii (P,) along a chain of joints (N, 3) with one radius a bone (N-1,)."""
    t = (np.arange(samples) + 0.5)[:, None] / samples
    centres = [a + (b - a) * t for a, b in itertools.pairwise(points)]
    return np.vstack(centres), np.repeat(radii, samples)
