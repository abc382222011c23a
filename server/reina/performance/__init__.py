"""The whole player at any frame: gestures, body, inverse kinematics, valves and show put together."""

from reina.performance.cast_parameters import show_parameters
from reina.performance.frame import BLOCK_FRAMES, FrameBlock, FrameLayout, SkeletonLayout
from reina.performance.glances import plan_glances
from reina.performance.performance import TAIL_S, Performance
from reina.performance.performer import Performer, player_parameters, player_prefix, streamed_parameters
from reina.performance.seats import SEATS, SEATS_FOR, Seat

__all__ = [
    "BLOCK_FRAMES",
    "SEATS",
    "SEATS_FOR",
    "TAIL_S",
    "FrameBlock",
    "FrameLayout",
    "Performance",
    "Performer",
    "Seat",
    "SkeletonLayout",
    "plan_glances",
    "player_parameters",
    "player_prefix",
    "show_parameters",
    "streamed_parameters",
]
