"""The true three-bone finger: from the tip alone, the last two joints being tied by θ3 = κ θ2.

One degree of freedom more than the tip asks for is what the paper's φ takes away. Anatomy takes it away
too: the tendons bend the last joint with the one before it. Table 1's own limits say κ = 45/135 = 1/3;
Rijpkema and Girard (1991) use 2/3. Where θ3 meets its limit before θ2 does, the last two bones go on as one
rigid link.

The squared distance of the tip falls as θ2 goes from 0 to -135°, so there is one solution or none. It is
convex in u = cos(θ2/3), as a quartic, for κ = 1/3, and in v = θ2² for every κ; on a convex function
Newton's method cannot overshoot twice, so a fixed number of steps from a chord's root reaches full
precision for a whole block at once.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.kinematics.planar_finger import TABLE_1_RAD
from reina.kinematics.status import SolveStatus, StatusArray

if TYPE_CHECKING:
    from reina.rotations.arrays import ArrayLike, FloatArray

_THIRD_TOLERANCE = 1e-8
_QUARTIC_STEPS = 5
_NEWTON_STEPS = 9
_REACH_SLACK = 1e-12


class CoupledFinger:
    """A finger, or a row of K fingers, solved from the tip alone.

    Args:
        lengths: Bone lengths, ``(..., 3)``, metres; leading axes are fingers and broadcast against the
            targets.
        kappa: θ3 / θ2, one number, positive.
        limits_rad: Least and greatest angle of each joint, ``(..., 3, 2)``. θ2 is used within -135°..0.

    Raises:
        ValueError: κ or a length is not positive, or θ2 has no room below 0.
    """

    def __init__(
        self, lengths: ArrayLike, kappa: float = 1.0 / 3.0, limits_rad: ArrayLike = TABLE_1_RAD
    ) -> None:
        bones = np.asarray(lengths, dtype=np.float64)
        limits = np.asarray(limits_rad, dtype=np.float64)
        if kappa <= 0.0 or np.any(bones <= 0.0):
            raise ValueError("a coupled finger needs bones longer than 0 and κ above 0")
        self.kappa = kappa
        self.l1, self.l2, self.l3 = bones[..., 0], bones[..., 1], bones[..., 2]
        self.limits = limits
        self._theta2_low: FloatArray = np.maximum(limits[..., 1, 0], TABLE_1_RAD[1, 0])
        self._theta2_high: FloatArray = np.minimum(limits[..., 1, 1], 0.0)
        self._theta3_low: FloatArray = limits[..., 2, 0]
        if np.any(self._theta2_low >= self._theta2_high):
            raise ValueError("the second joint of a coupled finger must be able to bend below 0")
        self._constant: FloatArray = self.l1**2 + self.l2**2 + self.l3**2
        self._nearest: FloatArray = self._squared_distance(self._theta2_low)
        self._farthest: FloatArray = self._squared_distance(self._theta2_high)
        stopped = bool(np.any(self._theta2_low * kappa < self._theta3_low - 1e-9))
        self._quartic = abs(kappa - 1.0 / 3.0) < _THIRD_TOLERANCE and not stopped
        l1, l2, l3 = self.l1, self.l2, self.l3
        # D(u) = c4 u⁴ + c3 u³ + c2 u² + c1 u + c0, from cos θ2 = 4u³ - 3u, cos(θ2+θ3) = 8u⁴ - 8u² + 1.
        self._c4: FloatArray = 16.0 * l1 * l3
        self._c3: FloatArray = 8.0 * l1 * l2
        self._c1: FloatArray = 2.0 * l2 * l3 - 6.0 * l1 * l2
        self._c0: FloatArray = 2.0 * l1 * l3 + self._constant
        self._u_low: FloatArray = np.cos(self._theta2_low / 3.0)
        self._u_high: FloatArray = np.cos(self._theta2_high / 3.0)
        self._d3: FloatArray = 4.0 * self._c4
        self._d2: FloatArray = 3.0 * self._c3
        self._d1: FloatArray = 2.0 * self._c4

    def solve(self, targets: ArrayLike) -> tuple[FloatArray, StatusArray]:
        """Angles that bring the tip to ``targets`` ``(..., 2)``, metres in the first joint's frame.

        Returns:
            Angles ``(..., 3)``, radians, always within the limits, and a `SolveStatus` each, ``(...)``. Out
            of reach, the finger points at the target, as straight (or, for one too near, as bent) as its
            limits allow.
        """
        angles, theta1, wanted, squared = self._bent(targets)
        beyond = np.abs(wanted - squared) > _REACH_SLACK * self._constant
        stopped = np.abs(angles[..., 0] - theta1) > 1e-12
        status = np.where(stopped, np.uint8(SolveStatus.AT_LIMIT), np.uint8(SolveStatus.REACHED))
        return angles, np.where(beyond, np.uint8(SolveStatus.OUT_OF_REACH), status)

    def angles(self, targets: ArrayLike) -> FloatArray:
        """The angles that `solve` gives, for who has no use for the status."""
        return self._bent(targets)[0]

    def _bent(self, targets: ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Angles; θ1 before its limits; the target's squared distance, and that which the tip comes to."""
        target = np.asarray(targets, dtype=np.float64)
        x, y = target[..., 0], target[..., 1]
        wanted = x * x + y * y
        squared = np.minimum(np.maximum(wanted, self._nearest), self._farthest)
        theta2 = self._bend_quartic(squared) if self._quartic else self._bend(squared)
        theta3 = np.maximum(self.kappa * theta2, self._theta3_low)
        both = theta2 + theta3
        angles = np.empty((*theta2.shape, 3))
        theta1 = np.arctan2(y, x) - np.arctan2(
            self.l2 * np.sin(theta2) + self.l3 * np.sin(both),
            self.l1 + self.l2 * np.cos(theta2) + self.l3 * np.cos(both),
        )
        theta1 -= 2.0 * np.pi * np.round(theta1 / (2.0 * np.pi))
        angles[..., 0] = np.minimum(np.maximum(theta1, self.limits[..., 0, 0]), self.limits[..., 0, 1])
        angles[..., 1] = theta2
        angles[..., 2] = theta3
        return angles, theta1, wanted, squared

    def _squared_distance(self, theta2: FloatArray) -> FloatArray:
        theta3 = np.maximum(self.kappa * theta2, self._theta3_low)
        return self._constant + 2.0 * (
            self.l1 * self.l2 * np.cos(theta2)
            + self.l2 * self.l3 * np.cos(theta3)
            + self.l1 * self.l3 * np.cos(theta2 + theta3)
        )

    def _bend_quartic(self, squared: FloatArray) -> FloatArray:
        """θ2 by Newton's method on the quartic in u = cos(θ2/3)."""
        span = (squared - self._nearest) / (self._farthest - self._nearest)
        u = self._u_low + span * (self._u_high - self._u_low)
        c0 = self._c0 - squared
        # Coefficients as large as the block: a row of few fingers, stretched over it, would make NumPy's
        # inner loops as short as the row, which takes three times as long in each of the sums below.
        row = (self._c4, self._c3, self._c1, self._d3, self._d2, self._d1)
        whole = np.empty((len(row), *u.shape))
        for index, coefficient in enumerate(row):
            whole[index] = coefficient
        c4, c3, c1, d3, d2, d1 = whole
        for step in range(_QUARTIC_STEPS):
            value = (((c4 * u + c3) * u - c4) * u + c1) * u + c0
            u = u - value / (((d3 * u + d2) * u - d1) * u + c1)
            if step == 0:
                u = np.minimum(u, self._u_high)
        return -3.0 * np.arccos(np.minimum(np.maximum(u, self._u_low), self._u_high))

    def _bend(self, squared: FloatArray) -> FloatArray:
        """θ2 by Newton's method on the distance as a function of v = θ2²."""
        low, high = self._theta2_high**2, self._theta2_low**2
        span = (squared - self._nearest) / (self._farthest - self._nearest)
        v = high + span * (low - high)
        l12, l23, l13 = self.l1 * self.l2, self.l2 * self.l3, self.l1 * self.l3
        for _ in range(_NEWTON_STEPS):
            theta2 = -np.sqrt(v)
            coupled = self.kappa * theta2 > self._theta3_low
            theta3 = np.where(coupled, self.kappa * theta2, self._theta3_low)
            value = self._squared_distance(theta2) - squared
            rate = np.where(coupled, self.kappa, 0.0)
            # d/dv = (d/dθ2) / (2 θ2); sin θ / θ by sinc has no hole at 0.
            both = theta2 + theta3
            ratio3 = np.where(coupled, self.kappa * _sinc(theta3), 0.0)
            ratio_both = np.where(
                coupled, (1.0 + self.kappa) * _sinc(both), np.sin(both) / np.minimum(theta2, -1e-300)
            )
            slope = -(l12 * _sinc(theta2) + rate * l23 * ratio3 + (1.0 + rate) * l13 * ratio_both)
            v = np.minimum(np.maximum(v - value / slope, low), high)
        return -np.sqrt(v)


def _sinc(angles: FloatArray) -> FloatArray:
    return np.sinc(angles / np.pi)
