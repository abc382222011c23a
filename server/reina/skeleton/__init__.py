"""Joints and their rest pose, forward kinematics, rigs and holds."""

from reina.skeleton.errors import BvhError, RigError
from reina.skeleton.forward_kinematics import forward_kinematics
from reina.skeleton.hold import Hold, load_hold, read_hold
from reina.skeleton.load_rig import load_rig, read_rig
from reina.skeleton.rig import SOLVERS, Button, Capsule, Chain, Limits, Morph, MovingPart, Point, Rig, Twist
from reina.skeleton.skeleton import Skeleton

__all__ = [
    "SOLVERS",
    "Button",
    "BvhError",
    "Capsule",
    "Chain",
    "Hold",
    "Limits",
    "Morph",
    "MovingPart",
    "Point",
    "Rig",
    "RigError",
    "Skeleton",
    "Twist",
    "forward_kinematics",
    "load_hold",
    "load_rig",
    "read_hold",
    "read_rig",
]
