"""The laboratory's second table: chains of a rig, posed by their angles or by a target."""

from functools import lru_cache
from pathlib import Path

import numpy as np
from fastapi import APIRouter, Request

from reina.api.http.access import ServerSettings
from reina.api.http.body import BoundedRoute
from reina.api.http.problems import ProblemError
from reina.api.lab.work import compute
from reina.api.rigs import DESCRIPTION, rig_description
from reina.api.settings import Settings
from reina.lab import (
    ChainPose,
    PosableChain,
    SolverSettings,
    check_angles,
    map_reach,
    posable_chains,
    pose_chain,
    solve_chain,
)
from reina.protocol.lab import (
    ForwardRequest,
    InverseAnswer,
    InverseRequest,
    LabChain,
    LabChainList,
    LabPose,
    ReachCells,
    ReachRequest,
    SolverChoice,
)
from reina.sessions.stage import FIRST_PLAYER
from reina.skeleton import load_rig

router = APIRouter(route_class=BoundedRoute)


@router.get("/chains")
async def list_chains(request: Request, settings: ServerSettings) -> LabChainList:
    """Fingers and limbs of every rig: joints, hinges with their limits, solvers, and the pose at rest."""

    def work() -> LabChainList:
        chains = [
            _describe(chain)
            for path in sorted(
                settings.rigs_dir.glob(f"*/{DESCRIPTION}"),
                key=lambda path: (path.parent.name != FIRST_PLAYER, path.parent.name),
            )
            for chain in _chains_of(path.parent, path.stat().st_mtime_ns)
        ]
        return LabChainList(chains=chains)

    return await compute(request, work)


@router.post("/forward")
async def pose(request: Request, asked: ForwardRequest, settings: ServerSettings) -> LabPose:
    """Forward kinematics: where the joints and the end of a chain are for the angles of its hinges."""
    chain = _find(settings, asked.rig, asked.chain)
    angles = check_angles(chain, asked.angles_rad, limits=asked.limits)
    return await compute(request, lambda: _told_pose(pose_chain(chain, angles)))


@router.post("/inverse")
async def solve(request: Request, asked: InverseRequest, settings: ServerSettings) -> InverseAnswer:
    """Inverse kinematics: angles that bring the end of a chain to a target, or as near as may be."""
    chain = _find(settings, asked.rig, asked.chain)
    start = None
    if asked.start_rad is not None:
        start = check_angles(chain, asked.start_rad, limits=False, location="start_rad")

    def work() -> InverseAnswer:
        found = solve_chain(chain, np.array(asked.target), _settings(asked.choice), start)
        return InverseAnswer.model_validate(
            {
                "status": found.status.name.lower(),
                "error_m": found.error_m,
                "iterations": found.iterations,
                "rounds": [
                    {"error_m": one.error_m, "positions": one.positions.tolist()} for one in found.rounds
                ],
                "pose": _told_pose(pose_chain(chain, found.angles)),
            }
        )

    return await compute(request, work)


@router.post("/reach")
async def reach(request: Request, asked: ReachRequest, settings: ServerSettings) -> ReachCells:
    """Where a solver comes to on a plane: each cell solved from rest (iterative ones: 32 × 32, 40 rounds)."""
    chain = _find(settings, asked.rig, asked.chain)

    def work() -> ReachCells:
        found = map_reach(chain, _settings(asked.choice), asked.plane, np.array(asked.through))
        rows, columns = found.reached.shape
        return ReachCells.model_validate(
            {
                "corner": found.corner.tolist(),
                "right": found.right.tolist(),
                "up": found.up.tolist(),
                "columns": columns,
                "rows": rows,
                "reached": "".join("01"[int(cell)] for cell in found.reached.ravel()),
                "share": float(found.reached.mean()),
            }
        )

    return await compute(request, work)


def _find(settings: Settings, rig: str, name: str) -> PosableChain:
    path = rig_description(settings.rigs_dir, rig)
    chains = {chain.name: chain for chain in _chains_of(path.parent, path.stat().st_mtime_ns)}
    if name not in chains:
        known = ", ".join(chains) or "none"
        raise ProblemError(
            404,
            "unknown-chain",
            "The rig has no such chain",
            f"{rig} has no chain {name!r} to pose; it has: {known}",
        )
    return chains[name]


@lru_cache(maxsize=16)
def _chains_of(folder: Path, modified_ns: int) -> tuple[PosableChain, ...]:  # noqa: ARG001 - read anew when written anew
    return posable_chains(load_rig(folder))


def _settings(choice: SolverChoice) -> SolverSettings:
    return SolverSettings(**choice.model_dump())


def _describe(chain: PosableChain) -> LabChain:
    rest = check_angles(chain, np.zeros(len(chain.hinges)), limits=False)
    return LabChain.model_validate(
        {
            "rig": chain.rig.name,
            "name": chain.name,
            "kind": chain.kind,
            "carrier": chain.rig.skeleton.names[chain.carrier],
            "joints": list(chain.joint_names),
            "end": chain.end_name,
            "bone_lengths_m": chain.bone_lengths.tolist(),
            "reach_m": chain.limited.reach,
            "solvers": list(chain.solvers),
            "hinges": [
                {
                    "joint": chain.joint_names[hinge.joint],
                    "axis": hinge.axis,
                    "minimum_rad": max(hinge.minimum_rad, -np.pi),
                    "maximum_rad": min(hinge.maximum_rad, np.pi),
                }
                for hinge in chain.hinges
            ],
            "rest": _told_pose(pose_chain(chain, rest)),
            "around": chain.rest_segments.tolist(),
        }
    )


def _told_pose(found: ChainPose) -> LabPose:
    return LabPose.model_validate(
        {
            "positions": found.positions.tolist(),
            "orientations": found.orientations.tolist(),
            "hinges": [
                {
                    "angle_rad": hinge.angle_rad,
                    "beyond_rad": hinge.beyond_rad,
                    "origin": hinge.origin.tolist(),
                    "axis": hinge.axis.tolist(),
                    "fan": hinge.fan.tolist(),
                    "direction": hinge.direction.tolist(),
                    "radius_m": hinge.radius_m,
                }
                for hinge in found.hinges
            ],
            "finger": found.finger
            and {
                "abduction_rad": found.finger.abduction_rad,
                "theta_rad": found.finger.theta_rad,
                "phi_rad": found.finger.phi_rad,
            },
        }
    )
