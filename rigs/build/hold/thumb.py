"""A thumb: a saddle joint of three angles, then two hinges."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hold.collision import along_bones
from hold.finger import PAD_DEPTH
from hold.rig import Rig, turn

Array = NDArray[np.float64]

PARTS = ("Metacarpal", "Proximal", "Distal")


@dataclass
class Thumb:
    """Local `offsets` (3, 3) and `rests` (3, 3, 3) of its joints, first in the hand's frame.

    `pad` (3,) in the last's.
    """

    name: str
    offsets: Array
    rests: Array
    pad: Array
    radii: Array

    @classmethod
    def of(cls, rig: Rig, side: str) -> Thumb:
        """From the rig, for one side."""
        joints = [f"{side}Thumb{part}" for part in PARTS]
        radii = [next(c["radius"] for c in rig.content["capsules"] if c["joint"] == j) for j in joints]
        return cls(
            f"{side}Thumb",
            np.array([rig.translations[j] for j in joints]),
            np.array([rig.rests[j] for j in joints]),
            rig.effector(f"{side}ThumbTip")[1],
            np.array(radii),
        )

    def _turns(self, angles: Array) -> list[Array]:
        return [
            self.rests[0] @ turn("yzx", *angles[:3]),
            self.rests[1] @ turn("z", angles[3]),
            self.rests[2] @ turn("z", angles[4]),
        ]

    def points(self, angles: Array) -> tuple[Array, Array]:
        """Three joints and the pad (4.

        3), and the pad's outward direction (3,), in the hand's frame, for angles (5,).
        """
        places: list[Array] = []
        frame, place = np.eye(3), np.zeros(3)
        for offset, local in zip(self.offsets, self._turns(angles), strict=True):
            place = place + frame @ offset
            frame = frame @ local
            places.append(place)
        return np.array([*places, place + frame @ self.pad]), -frame[:, 1]

    def spheres(self, angles: Array, samples: int) -> tuple[Array, Array]:
        """Spheres (P, 3), (P,) that stand for the thumb, in the hand's frame; the last touches the pad."""
        points, looking = self.points(angles)
        points[3] = points[3] - PAD_DEPTH * self.radii[2] * looking
        return along_bones(points, self.radii, samples)

    def local_rotations(self, angles: Array) -> dict[str, Array]:
        """The three joints' whole local rotations for angles (5,)."""
        return {f"{self.name}{part}": value for part, value in zip(PARTS, self._turns(angles), strict=True)}
