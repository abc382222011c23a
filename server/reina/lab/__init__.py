"""What the laboratory shows: interpolations compared, chains posed and solved, clips laid out as points.

Nothing here is new mathematics; rotations, kinematics and skeleton are put side by side so that they can be
looked at.
"""

from reina.lab.chain_pose import ChainPose, FingerReading, HingeReading, check_angles, pose_chain
from reina.lab.clip_points import ClipPoints, clip_points
from reina.lab.errors import LabError
from reina.lab.interpolations import Comparison, Way, compare_interpolations
from reina.lab.inverse import IterativeRound, Solved, solve_chain
from reina.lab.orientation import Orientation
from reina.lab.posable_chain import Hinge, PosableChain, posable_chains
from reina.lab.reach_map import ReachMap, map_reach
from reina.lab.solver_settings import SOLVERS, SolverSettings

__all__ = [
    "SOLVERS",
    "ChainPose",
    "ClipPoints",
    "Comparison",
    "FingerReading",
    "Hinge",
    "HingeReading",
    "IterativeRound",
    "LabError",
    "Orientation",
    "PosableChain",
    "ReachMap",
    "Solved",
    "SolverSettings",
    "Way",
    "check_angles",
    "clip_points",
    "compare_interpolations",
    "map_reach",
    "posable_chains",
    "pose_chain",
    "solve_chain",
]
