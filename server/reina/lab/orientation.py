"""An orientation together with the numbers that it was set by."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.lab.errors import LabError
from reina.rotations import exp, from_euler, log, to_euler

if TYPE_CHECKING:
    from reina.rotations.arrays import ArrayLike, FloatArray

_MIN_LENGTH = 1e-6


@dataclass(frozen=True, eq=False)
class Orientation:
    """A rotation, and how it was said.

    Interpolating angles depends on which angles: 270° about an axis is the same orientation as -90° and
    another way to come to it. So what was given is kept as it was given.

    Attributes:
        quaternion: Unit, ``(4,)``.
        euler_order: The order it was given in, or None.
        euler_rad: The Euler angles that it was given by, ``(3,)``, or None.
        vector: The rotation vector that it was given by, ``(3,)``, radians, or None.
    """

    quaternion: FloatArray
    euler_order: str | None = None
    euler_rad: FloatArray | None = None
    vector: FloatArray | None = None

    @classmethod
    def from_euler(cls, angles_rad: ArrayLike, order: str) -> Orientation:
        """By three Euler angles in one of `reina.rotations.ORDERS`."""
        angles = np.asarray(angles_rad, dtype=np.float64)
        return cls(from_euler(angles, order), euler_order=order, euler_rad=angles)

    @classmethod
    def from_axis_angle(cls, axis: ArrayLike, angle_rad: float) -> Orientation:
        """By an axis of any length but zero, and an angle.

        Raises:
            LabError: The axis has no direction.
        """
        vector = np.asarray(axis, dtype=np.float64) / _length(axis, "axis") * angle_rad
        return cls(exp(vector), vector=vector)

    @classmethod
    def from_quaternion(cls, quaternion: ArrayLike) -> Orientation:
        """By a quaternion (x, y, z, w) of any length but zero.

        Raises:
            LabError: All four components are zero.
        """
        return cls(np.asarray(quaternion, dtype=np.float64) / _length(quaternion, "quaternion"))

    def as_euler(self, order: str) -> FloatArray:
        """Euler angles ``(3,)``, radians: those given if the order is the same, else those within range."""
        if self.euler_rad is not None and self.euler_order == order:
            return self.euler_rad
        return to_euler(self.quaternion, order)

    def as_vector(self) -> FloatArray:
        """The rotation vector ``(3,)``: the one given, or the shortest."""
        return log(self.quaternion) if self.vector is None else self.vector


def _length(numbers: ArrayLike, what: str) -> float:
    length = float(np.linalg.norm(np.asarray(numbers, dtype=np.float64)))
    if length < _MIN_LENGTH:
        raise LabError(
            "its length is zero, so it has no direction; give at least one number that is not 0",
            location=what,
        )
    return length
