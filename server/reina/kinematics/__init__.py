"""Inverse kinematics in closed form and by iteration, and motion planned on the time axis."""

from reina.kinematics.coupled_finger import CoupledFinger
from reina.kinematics.finger_chains import FingerChains
from reina.kinematics.finger_plane import (
    finger_rotations,
    project_on_finger_plane,
    project_on_hand_planes,
    target_in_hand,
)
from reina.kinematics.iterative import solve_ccd, solve_damped_least_squares, solve_fabrik
from reina.kinematics.joint_chain import ChainSolution, JointChain
from reina.kinematics.joint_limits import clamp_to_limits, excess_over_limits, limit_angles
from reina.kinematics.motion_curves import Curve, MotionCurves, minimum_jerk
from reina.kinematics.planar_finger import (
    TABLE_1_RAD,
    VALVE_PHI_RAD,
    finger_tip,
    planar_solutions,
    solve_planar,
)
from reina.kinematics.status import SolveStatus
from reina.kinematics.twists import TwistHelpers
from reina.kinematics.two_bone import LimbPose, TwoBoneLimbs, hinge_directions_from_poles

__all__ = [
    "TABLE_1_RAD",
    "VALVE_PHI_RAD",
    "ChainSolution",
    "CoupledFinger",
    "Curve",
    "FingerChains",
    "JointChain",
    "LimbPose",
    "MotionCurves",
    "SolveStatus",
    "TwistHelpers",
    "TwoBoneLimbs",
    "clamp_to_limits",
    "excess_over_limits",
    "finger_rotations",
    "finger_tip",
    "hinge_directions_from_poles",
    "limit_angles",
    "minimum_jerk",
    "planar_solutions",
    "project_on_finger_plane",
    "project_on_hand_planes",
    "solve_ccd",
    "solve_damped_least_squares",
    "solve_fabrik",
    "solve_planar",
    "target_in_hand",
]
