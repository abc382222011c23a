"""One question to every solver: which angles bring the end of a chain to a target?"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from reina.kinematics import (
    FingerChains,
    SolveStatus,
    TwoBoneLimbs,
    excess_over_limits,
    solve_ccd,
    solve_damped_least_squares,
    solve_fabrik,
)
from reina.lab.errors import LabError
from reina.lab.solver_settings import CLOSED_FORM
from reina.lab.traced_chain import TracedChain
from reina.rotations import from_axis_angle, rotate

if TYPE_CHECKING:
    from collections.abc import Callable

    from reina.kinematics import ChainSolution
    from reina.kinematics.status import StatusArray
    from reina.lab.posable_chain import PosableChain
    from reina.lab.solver_settings import SolverName, SolverSettings
    from reina.rotations.arrays import FloatArray

SWIVELS = 72
"""How many turns of an elbow are tried where none is asked for."""
_MIN_OFFSET_M = 1e-6


class BatchSolution(NamedTuple):
    """What a solver found for B targets."""

    angles: FloatArray
    """In each joint's Euler order, ``(B, N, 3)``, radians."""
    status: StatusArray
    """``(B,)``."""
    error_m: FloatArray
    """Distance of the end from its target, by forward kinematics of the angles, ``(B,)``."""


@dataclass(frozen=True, eq=False)
class IterativeRound:
    """Where an iterative solver's chain was after a round."""

    positions: FloatArray
    """Of the joints, then of the end, ``(N + 1, 3)``, metres."""
    error_m: float


@dataclass(frozen=True, eq=False)
class Solved:
    """The answer to one target.

    Attributes:
        angles: In each joint's Euler order, ``(N, 3)``, radians.
        status: How it went.
        error_m: Distance of the end from the target.
        rounds: Of an iterative solver, the start first; empty for closed forms.
    """

    angles: FloatArray
    status: SolveStatus
    error_m: float
    rounds: tuple[IterativeRound, ...]

    @property
    def iterations(self) -> int:
        """How many rounds it took."""
        return max(len(self.rounds) - 1, 0)


ITERATIVE: dict[SolverName, Callable[..., ChainSolution]] = {
    "ccd": solve_ccd,
    "fabrik": solve_fabrik,
    "damped_least_squares": solve_damped_least_squares,
}


def solve_chain(
    chain: PosableChain, target: FloatArray, settings: SolverSettings, start: FloatArray | None = None
) -> Solved:
    """Bring the end of a chain to one target.

    Args:
        chain: The chain.
        target: In the frame of the joint that carries the chain, ``(3,)``, metres.
        settings: Which solver, and how.
        start: Angles ``(N, 3)`` for iterative solvers to begin from; rest where None.

    Raises:
        LabError: The solver is not one for this kind of chain.
    """
    check_solver(chain, settings)
    if settings.solver in CLOSED_FORM:
        found = solve_batch(chain, target[None], settings)
        return Solved(found.angles[0], SolveStatus(int(found.status[0])), float(found.error_m[0]), ())
    joint_chain = TracedChain.of(chain.joint_chain(limits=settings.limits))
    solution = ITERATIVE[settings.solver](
        joint_chain,
        target,
        None if start is None else joint_chain.rotations(start[None])[0],
        tolerance_m=settings.tolerance_m,
        iterations=settings.iterations,
    )
    trace = joint_chain.trace[: int(solution.iterations[0]) + 1]
    positions = joint_chain.stance(np.stack(trace)).positions
    rounds = tuple(IterativeRound(one, float(np.linalg.norm(one[-1] - target))) for one in positions)
    return Solved(trace[-1], SolveStatus(int(solution.status[0])), rounds[-1].error_m, rounds)


def solve_batch(
    chain: PosableChain, targets: FloatArray, settings: SolverSettings, *, swivels: int = SWIVELS
) -> BatchSolution:
    """Bring the end of a chain to B targets ``(B, 3)``, each from rest.

    Raises:
        LabError: The solver is not one for this kind of chain.
    """
    check_solver(chain, settings)
    joint_chain = chain.joint_chain(limits=settings.limits)
    if settings.solver in ITERATIVE:
        solution = ITERATIVE[settings.solver](
            joint_chain, targets, tolerance_m=settings.tolerance_m, iterations=settings.iterations
        )
        return BatchSolution(joint_chain.angles(solution.rotations), solution.status, solution.error)
    if settings.solver == "two_bone":
        rotations, status = _solve_limb(chain, targets, settings, swivels)
    else:
        rotations, status = _solve_finger(chain, targets, settings)
    # Angles are brought within the limits here, whatever the closed form made of them.
    angles = joint_chain.angles(rotations)
    ends = joint_chain.stance(angles).positions[:, -1]
    error = np.sqrt(np.sum((ends - targets) ** 2, axis=-1))
    beside = (status == SolveStatus.REACHED) & (error > settings.tolerance_m)
    status = np.where(beside, np.uint8(SolveStatus.AT_LIMIT), status)
    return BatchSolution(angles, status, error)


def check_solver(chain: PosableChain, settings: SolverSettings) -> None:
    """Refuse a solver that is not for this kind of chain.

    Raises:
        LabError: It is not; the message lists those that are.
    """
    if settings.solver not in chain.solvers:
        raise LabError(
            f"{settings.solver} does not solve a {chain.kind}; {chain.name} takes {', '.join(chain.solvers)}",
            location="solver",
        )


def _solve_finger(
    chain: PosableChain, targets: FloatArray, settings: SolverSettings
) -> tuple[FloatArray, StatusArray]:
    rig = chain.rig if settings.limits else chain.unlimited_rig
    coupled = settings.solver == "coupled_three_bone"
    asked = replace(
        chain.chain,
        solver=settings.solver,
        kappa=settings.kappa if coupled else None,
        phi_rad=None if coupled else settings.phi_rad,
    )
    finger = FingerChains(replace(rig, chains={chain.name: asked}), [chain.name])
    rotations, status = finger.solve(targets[:, None])
    return rotations[:, 0], status[:, 0]


def _solve_limb(
    chain: PosableChain, targets: FloatArray, settings: SolverSettings, swivels: int
) -> tuple[FloatArray, StatusArray]:
    limb = TwoBoneLimbs(chain.rig if settings.limits else chain.unlimited_rig, [chain.name])
    rest, root = chain.limited.rest, chain.limited.links[0]
    offset = targets - root
    near = np.sqrt(np.sum(offset * offset, axis=-1, keepdims=True)) < _MIN_OFFSET_M
    offset = np.where(near, rotate(rest[0], np.array([_MIN_OFFSET_M, 0.0, 0.0])), offset)
    direction = offset / np.sqrt(np.sum(offset * offset, axis=-1, keepdims=True))
    hinge = _across(direction, rotate(rest[0], limb.hinge[0]))
    turns = _turns(settings.swivel_rad, swivels)
    hints = rotate(from_axis_angle(direction[:, None], turns), hinge[:, None])
    wanted = np.broadcast_to((root + offset)[:, None], hints.shape)
    found = limb.solve(root, wanted[:, :, None], hints[:, :, None])
    upper, lower = found.upper[:, :, 0], found.lower_local[:, :, 0]
    excess = excess_over_limits(upper, rest[0], chain.limited.limits[0])
    best = np.argmin(np.round(excess, 6), axis=1)
    rows = np.arange(len(targets))
    rotations = np.stack([upper[rows, best], lower[rows, best]], axis=1)
    return rotations, found.status[rows, best, 0]


def _turns(swivel_rad: float | None, count: int) -> FloatArray:
    """The swivels to try, the smallest first: of equals the first is taken."""
    if swivel_rad is not None:
        return np.array([swivel_rad])
    turns = np.linspace(-np.pi, np.pi, count, endpoint=False)
    return turns[np.argsort(np.abs(turns), kind="stable")]


def _across(direction: FloatArray, hint: FloatArray) -> FloatArray:
    """The hint made perpendicular to directions ``(B, 3)``; another axis where it lies along one."""
    candidates = np.stack([hint, *np.eye(3)])
    across = candidates - direction[:, None] * np.einsum("bi,ci->bc", direction, candidates)[..., None]
    length = np.sqrt(np.sum(across * across, axis=-1))
    chosen = np.where(length[:, 0] > 0.05, 0, 1 + np.argmax(length[:, 1:], axis=1))
    return across[np.arange(len(direction)), chosen]
