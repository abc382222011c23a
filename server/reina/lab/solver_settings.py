"""Which solver, and with what settings."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from reina.kinematics import VALVE_PHI_RAD

SolverName = Literal[
    "planar_three_bone", "coupled_three_bone", "two_bone", "ccd", "fabrik", "damped_least_squares"
]
ChainKind = Literal["finger", "limb"]

SOLVERS: dict[ChainKind, tuple[SolverName, ...]] = {
    "finger": ("coupled_three_bone", "planar_three_bone", "ccd", "fabrik", "damped_least_squares"),
    "limb": ("two_bone", "ccd", "fabrik", "damped_least_squares"),
}
"""The solvers that a kind of chain can be given to; the first is the one that the rig plays with."""

CLOSED_FORM: frozenset[SolverName] = frozenset({"planar_three_bone", "coupled_three_bone", "two_bone"})


@dataclass(frozen=True)
class SolverSettings:
    """How a chain is solved.

    Attributes:
        solver: One of the chain's `SOLVERS`.
        limits: Whether joints stop at the rig's limits.
        iterations: The bound of an iterative solver's rounds.
        tolerance_m: How near the end must come to count as there.
        phi_rad: Direction of the last bone for ``planar_three_bone``.
        kappa: θ3 / θ2 for ``coupled_three_bone``.
        swivel_rad: For ``two_bone``, by how much elbow or knee is turned about the line from root to target;
            None for the turn that breaks the limits least, and of those the smallest.
    """

    solver: SolverName
    limits: bool = True
    iterations: int = 60
    tolerance_m: float = 1e-4
    phi_rad: float = VALVE_PHI_RAD
    kappa: float = 1.0 / 3.0
    swivel_rad: float | None = None
