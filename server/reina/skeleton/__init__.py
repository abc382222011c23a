"""Joints and their rest pose, forward kinematics, rigs and holds, motion clips."""

from reina.skeleton.clip_warning import ClipWarning
from reina.skeleton.errors import BvhError, PoseError, RigError
from reina.skeleton.forward_kinematics import forward_kinematics
from reina.skeleton.hold import GripKey, Hold, load_hold, read_hold
from reina.skeleton.human_pose import HumanPose, human_pose, pose_numbers, pose_of
from reina.skeleton.joint_aliases import humanoid_name
from reina.skeleton.load_rig import load_rig, read_rig
from reina.skeleton.mirror import ACROSS, Mirror, mirrored_hold, other_side
from reina.skeleton.motion_clip import MotionClip
from reina.skeleton.reach import reaches
from reina.skeleton.read_bvh import PositionMeaning, read_bvh
from reina.skeleton.retarget import blended, clip_of_motion, looped, retarget
from reina.skeleton.rig import (
    SOLVERS,
    Button,
    Capsule,
    Chain,
    Cylinder,
    Limits,
    Morph,
    MovingPart,
    Point,
    Rig,
    Twist,
    Zone,
)
from reina.skeleton.skeleton import Skeleton
from reina.skeleton.write_bvh import bvh_head, bvh_rows, write_bvh

__all__ = [
    "ACROSS",
    "SOLVERS",
    "Button",
    "BvhError",
    "Capsule",
    "Chain",
    "ClipWarning",
    "Cylinder",
    "GripKey",
    "Hold",
    "HumanPose",
    "Limits",
    "Mirror",
    "Morph",
    "MotionClip",
    "MovingPart",
    "Point",
    "PoseError",
    "PositionMeaning",
    "Rig",
    "RigError",
    "Skeleton",
    "Twist",
    "Zone",
    "blended",
    "bvh_head",
    "bvh_rows",
    "clip_of_motion",
    "forward_kinematics",
    "human_pose",
    "humanoid_name",
    "load_hold",
    "load_rig",
    "looped",
    "mirrored_hold",
    "other_side",
    "pose_numbers",
    "pose_of",
    "reaches",
    "read_bvh",
    "read_hold",
    "read_rig",
    "retarget",
    "write_bvh",
]
