"""Where a solver reaches: a plane through the target, cell by cell."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from reina.kinematics import SolveStatus
from reina.lab.inverse import solve_batch
from reina.lab.solver_settings import CLOSED_FORM

if TYPE_CHECKING:
    from reina.lab.posable_chain import PosableChain
    from reina.lab.solver_settings import SolverSettings
    from reina.rotations.arrays import BoolArray, FloatArray

PlaneName = Literal["xy", "yz", "xz"]

PLANES: dict[PlaneName, tuple[int, int]] = {"xy": (0, 1), "yz": (2, 1), "xz": (0, 2)}
"""Each plane's axes, to the right and up."""

_FINGER_CELLS = 112
_LIMB_CELLS = 64
_ITERATIVE_CELLS = 32
_ITERATIVE_ROUNDS = 40
_SWIVELS = 24
_MARGIN = 1.12
_CELL_SHARE = 0.002
"""An iterative solver has reached a cell when it is so near, as a part of the chain's reach."""


@dataclass(frozen=True, eq=False)
class ReachMap:
    """Which of a plane's cells the end of a chain comes to.

    Attributes:
        corner: Centre of the first cell, ``(3,)``, metres in the carrier's frame.
        right: From a cell to the next in its row, ``(3,)``.
        up: From a row to the next, ``(3,)``.
        reached: ``(rows, columns)``.
    """

    corner: FloatArray
    right: FloatArray
    up: FloatArray
    reached: BoolArray


def map_reach(
    chain: PosableChain, settings: SolverSettings, plane: PlaneName, through: FloatArray
) -> ReachMap:
    """Solve for every cell of a square around the chain's base, each from rest.

    Args:
        chain: The chain.
        settings: Which solver, and how; an iterative solver takes at most 40 rounds a cell.
        plane: Which way the square lies, in the carrier's axes.
        through: A point that the plane goes through, ``(3,)``, metres.

    Raises:
        LabError: The solver is not one for this kind of chain.
    """
    closed = settings.solver in CLOSED_FORM
    cells = (_FINGER_CELLS if chain.kind == "finger" else _LIMB_CELLS) if closed else _ITERATIVE_CELLS
    joint_chain = chain.limited
    half = _MARGIN * joint_chain.reach
    ticks = np.linspace(-half, half, cells)
    across, along = PLANES[plane]
    targets = np.broadcast_to(through, (cells, cells, 3)).copy()
    targets[..., across] = joint_chain.links[0, across] + ticks
    targets[..., along] = joint_chain.links[0, along] + ticks[:, None]
    tolerance = settings.tolerance_m if closed else max(settings.tolerance_m, _CELL_SHARE * joint_chain.reach)
    asked = replace(settings, tolerance_m=tolerance, iterations=min(settings.iterations, _ITERATIVE_ROUNDS))
    found = solve_batch(chain, targets.reshape(-1, 3), asked, swivels=_SWIVELS)
    step = float(ticks[1] - ticks[0])
    return ReachMap(
        corner=targets[0, 0],
        right=step * np.eye(3)[across],
        up=step * np.eye(3)[along],
        reached=(found.status == SolveStatus.REACHED).reshape(cells, cells),
    )
