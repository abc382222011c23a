"""Four ways from one orientation to another, measured: slerp, and three that look simpler."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.rotations import angle_between, exp, from_euler, from_matrix, slerp, to_matrix

if TYPE_CHECKING:
    from collections.abc import Callable

    from reina.lab.orientation import Orientation
    from reina.rotations.arrays import ArrayLike, FloatArray


@dataclass(frozen=True, eq=False)
class Way:
    """One way, sampled F times.

    Attributes:
        name: ``slerp``, ``matrix``, ``euler`` or ``rotation_vector``.
        matrices: As interpolated, ``(F, 3, 3)``; those of ``matrix`` are no rotations in between.
        quaternions: The rotations, ``(F, 4)``; of ``matrix`` those that are nearest to its matrices.
        speed: Angular speed from sample to sample, radians a unit of the fraction, ``(F - 1,)``.
        tip: Where a point of the turned body goes, ``(F, 3)``.
        determinant: Of the matrices, ``(F,)``; 1 for a rotation.
        orthogonality_error: Frobenius norm of RᵀR - I, ``(F,)``; 0 for a rotation.
    """

    name: str
    matrices: FloatArray
    quaternions: FloatArray
    speed: FloatArray
    tip: FloatArray
    determinant: FloatArray
    orthogonality_error: FloatArray

    @property
    def length_rad(self) -> float:
        """How far the body turns on the way, radians."""
        return float(np.mean(self.speed))


@dataclass(frozen=True, eq=False)
class Comparison:
    """All ways between two orientations, on the same fractions ``(F,)``."""

    start: FloatArray
    end: FloatArray
    angle_rad: float
    """The angle between them: no way is shorter."""
    fractions: FloatArray
    ways: tuple[Way, ...]


def compare_interpolations(
    start: Orientation, end: Orientation, *, euler_order: str, samples: int, tip: ArrayLike
) -> Comparison:
    """Go from one orientation to another in four ways.

    Args:
        start: At fraction 0.
        end: At fraction 1.
        euler_order: Of the Euler angles that are interpolated, one of `reina.rotations.ORDERS`.
        samples: How many orientations, both ends included, at least 2.
        tip: The point whose path is told, in the body's frame, ``(3,)``.
    """
    fractions = np.linspace(0.0, 1.0, samples)
    point = np.asarray(tip, dtype=np.float64)
    ways: dict[str, Callable[[], FloatArray]] = {
        "slerp": lambda: to_matrix(slerp(start.quaternion, end.quaternion, fractions)),
        "matrix": lambda: _blend(to_matrix(start.quaternion), to_matrix(end.quaternion), fractions),
        "euler": lambda: to_matrix(
            from_euler(_blend(start.as_euler(euler_order), end.as_euler(euler_order), fractions), euler_order)
        ),
        "rotation_vector": lambda: to_matrix(exp(_blend(start.as_vector(), end.as_vector(), fractions))),
    }
    return Comparison(
        start=start.quaternion,
        end=end.quaternion,
        angle_rad=float(angle_between(start.quaternion, end.quaternion)),
        fractions=fractions,
        ways=tuple(_measure(name, matrices(), fractions, point) for name, matrices in ways.items()),
    )


def nearest_rotations(matrices: FloatArray) -> FloatArray:
    """The rotations ``(..., 4)`` nearest to matrices ``(..., 3, 3)`` (Kabsch 1976: U diag(1, 1, ±1) Vᵀ)."""
    u, _, v = np.linalg.svd(matrices)
    u[..., :, 2] *= np.linalg.det(u @ v)[..., None]
    return from_matrix(u @ v)


def _measure(name: str, matrices: FloatArray, fractions: FloatArray, tip: FloatArray) -> Way:
    quaternions = nearest_rotations(matrices)
    steps = angle_between(quaternions[1:], quaternions[:-1])
    product = np.swapaxes(matrices, -1, -2) @ matrices - np.eye(3)
    return Way(
        name=name,
        matrices=matrices,
        quaternions=quaternions,
        speed=steps / np.diff(fractions),
        tip=matrices @ tip,
        determinant=np.linalg.det(matrices),
        orthogonality_error=np.sqrt(np.sum(product * product, axis=(-1, -2))),
    )


def _blend(first: FloatArray, second: FloatArray, fractions: FloatArray) -> FloatArray:
    """Component by component."""
    t = fractions.reshape(-1, *((1,) * first.ndim))
    return (1.0 - t) * first + t * second
