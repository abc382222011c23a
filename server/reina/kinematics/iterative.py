"""Inverse kinematics by iteration, for chains that have no closed form: CCD, FABRIK, damped least squares.

All three take a `JointChain`, B targets and a start, move hinges within their limits until the end is
within a tolerance of the target or a bound of rounds is met, and say for each target how it went. All B are
moved at once; those that have arrived are left alone.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from reina.kinematics.joint_chain import TOLERANCE_M, ChainSolution, JointChain, judge
from reina.rotations import cross, dot, from_axis_angle, rotate

if TYPE_CHECKING:
    from reina.rotations.arrays import ArrayLike, FloatArray

Round = Callable[[JointChain, "FloatArray", "FloatArray"], "FloatArray"]
"""One round: from the chain, targets ``(B, 3)`` and angles ``(B, N, 3)`` to better angles."""

DAMPING = 0.12
"""λ of damped least squares, as a part of the error (and of the reach, where that is less)."""

LARGEST_STEP = 0.25
"""No round of damped least squares asks the end to go further than this part of the chain's reach."""

_ACTIVE_SET_PASSES = 3
_FACING_SWEEPS = 2


def solve_ccd(
    chain: JointChain,
    targets: ArrayLike,
    start: ArrayLike | None = None,
    *,
    tolerance_m: float = TOLERANCE_M,
    iterations: int = 100,
) -> ChainSolution:
    """Cyclic coordinate descent (Wang and Chen 1991): from the end on, each hinge turned to face the target.

    Args:
        chain: N joints.
        targets: Where the end is to be, ``(B, 3)`` or ``(3,)``, metres.
        start: Local rotations to begin from, ``(B, N, 4)`` or ``(N, 4)``; rest where None.
        tolerance_m: How near is near enough.
        iterations: At most so many rounds.
    """
    return _iterate(_ccd_round, chain, targets, start, tolerance_m, iterations)


def solve_fabrik(
    chain: JointChain,
    targets: ArrayLike,
    start: ArrayLike | None = None,
    *,
    tolerance_m: float = TOLERANCE_M,
    iterations: int = 100,
) -> ChainSolution:
    """Forward and backward reaching (Aristidou and Lasenby 2011): points on lines, then joints that follow.

    Limits are kept by turning each joint, from the base, as far towards its point as it may; then the first
    joint faces the whole chain at the target, because a hinge sees only what lies in its plane. Arguments as
    `solve_ccd`.
    """
    return _iterate(_fabrik_round, chain, targets, start, tolerance_m, iterations)


def solve_damped_least_squares(
    chain: JointChain,
    targets: ArrayLike,
    start: ArrayLike | None = None,
    *,
    tolerance_m: float = TOLERANCE_M,
    iterations: int = 100,
) -> ChainSolution:
    """Damped least squares (Wampler 1986; Nakamura and Hanafusa 1986): Δθ = Jᵀ (J Jᵀ + λ² I)⁻¹ e.

    λ fades with the error, so that the last rounds converge as Newton's method does. Hinges at a limit that
    would be pushed over it take no part, and the others do their share. Arguments as `solve_ccd`.
    """
    return _iterate(_least_squares_round, chain, targets, start, tolerance_m, iterations)


def _iterate(
    one_round: Round,
    chain: JointChain,
    targets: ArrayLike,
    start: ArrayLike | None,
    tolerance_m: float,
    iterations: int,
) -> ChainSolution:
    wanted = np.atleast_2d(np.asarray(targets, dtype=np.float64))
    begin = chain.rest if start is None else np.asarray(start, dtype=np.float64)
    angles = chain.angles(np.broadcast_to(begin, (len(wanted), *chain.rest.shape)))
    rounds = np.zeros(len(wanted), dtype=np.intp)
    for _ in range(iterations):
        ends = chain.stance(angles).positions[:, -1]
        far = np.flatnonzero(np.sum((ends - wanted) ** 2, axis=-1) > tolerance_m**2)
        if len(far) == 0:
            break
        angles[far] = one_round(chain, wanted[far], angles[far])
        rounds[far] += 1
    return judge(chain, wanted, angles, rounds, tolerance_m)


def _ccd_round(chain: JointChain, targets: FloatArray, angles: FloatArray) -> FloatArray:
    stance = chain.stance(angles)
    end = stance.positions[:, -1]
    # From the end to the base: what a hinge turns leaves the hinges before it where they are.
    for hinge in reversed(range(len(chain.hinges))):
        origin = stance.positions[:, chain.hinges[hinge][0]]
        end = _face(chain, angles, hinge, stance.axes[:, hinge], origin, end, targets)
    return angles


def _face(
    chain: JointChain,
    angles: FloatArray,
    hinge: int,
    axis: FloatArray,
    origin: FloatArray,
    point: FloatArray,
    target: FloatArray,
) -> FloatArray:
    """Turn one hinge within its limits so that a point faces a target; return where the point goes."""
    joint, place = chain.hinges[hinge]
    arm, aim = point - origin, target - origin
    sine = dot(axis, cross(arm, aim))
    cosine = dot(arm, aim) - dot(axis, arm) * dot(axis, aim)
    wanted = angles[:, joint, place] + np.arctan2(sine, cosine)
    turned = np.minimum(np.maximum(wanted, chain.low[joint, place]), chain.high[joint, place])
    step = turned - angles[:, joint, place]
    angles[:, joint, place] = turned
    return origin + rotate(from_axis_angle(axis, step), arm)


def _fabrik_round(chain: JointChain, targets: FloatArray, angles: FloatArray) -> FloatArray:
    positions = chain.stance(angles).positions
    lengths = np.sqrt(np.sum(chain.links[1:] ** 2, axis=-1))
    points = positions.copy()
    points[:, -1] = targets
    for joint in reversed(range(len(lengths))):  # from the target back
        points[:, joint] = _at_distance(points[:, joint + 1], points[:, joint], lengths[joint])
    points[:, 0] = positions[:, 0]
    for joint in range(len(lengths)):  # from the base on
        points[:, joint + 1] = _at_distance(points[:, joint], points[:, joint + 1], lengths[joint])
    for joint in range(len(lengths)):
        _turn_joint(chain, angles, joint, joint + 1, points[:, joint + 1])
    _turn_joint(chain, angles, 0, len(lengths), targets)
    return angles


def _turn_joint(chain: JointChain, angles: FloatArray, joint: int, point: int, goal: FloatArray) -> None:
    """Turn all hinges of one joint so that a point of the chain faces a goal."""
    hinges = np.flatnonzero(chain.hinge_joints == joint).tolist()
    for _ in range(_FACING_SWEEPS):
        stance = chain.stance(angles)
        place = stance.positions[:, point]
        for hinge in reversed(hinges):
            origin = stance.positions[:, joint]
            place = _face(chain, angles, hinge, stance.axes[:, hinge], origin, place, goal)


def _at_distance(origin: FloatArray, towards: FloatArray, distance: float) -> FloatArray:
    """The points ``(B, 3)`` at a distance from ``origin`` on the lines to ``towards``."""
    line = towards - origin
    length = np.sqrt(np.sum(line * line, axis=-1, keepdims=True))
    return origin + line * (distance / np.maximum(length, 1e-12))


def _least_squares_round(chain: JointChain, targets: FloatArray, angles: FloatArray) -> FloatArray:
    stance = chain.stance(angles)
    error = targets - stance.positions[:, -1]
    length = np.sqrt(dot(error, error))
    reach = chain.reach
    error = error * np.minimum(1.0, LARGEST_STEP * reach / np.maximum(length, 1e-12))[:, None]
    levers = stance.positions[:, -1:] - stance.positions[:, chain.hinge_joints]
    columns = cross(stance.axes, levers)  # (B, M, 3): the Jacobian's transpose
    damping = (DAMPING * np.minimum(reach, length)) ** 2 + (1e-6 * reach) ** 2
    places = np.array([place for _, place in chain.hinges])
    low, high = chain.low[chain.hinge_joints, places], chain.high[chain.hinge_joints, places]
    angle = angles[:, chain.hinge_joints, places]
    step = np.zeros(angle.shape)
    for _ in range(_ACTIVE_SET_PASSES):
        square = np.swapaxes(columns, -1, -2) @ columns + damping[:, None, None] * np.eye(3)
        step = np.einsum("bmi,bi->bm", columns, np.linalg.solve(square, error[..., None])[..., 0])
        blocked = ((step < 0.0) & (angle <= low)) | ((step > 0.0) & (angle >= high))
        if not blocked.any():
            break
        columns = np.where(blocked[..., None], 0.0, columns)
    angles[:, chain.hinge_joints, places] = np.minimum(np.maximum(angle + step, low), high)
    return angles
