"""The whole player at any frame: gestures, body, inverse kinematics, valves and show put together."""

from reina.performance.amounts import PLAYER_PARAMETERS
from reina.performance.export import performance_clip
from reina.performance.frame import BLOCK_FRAMES, FrameBlock, FrameLayout, SkeletonLayout
from reina.performance.performance import Performance
from reina.performance.pose_keys import POSE_PARAMETERS

__all__ = [
    "BLOCK_FRAMES",
    "PLAYER_PARAMETERS",
    "POSE_PARAMETERS",
    "FrameBlock",
    "FrameLayout",
    "Performance",
    "SkeletonLayout",
    "performance_clip",
]
