"""The whole player at any frame: gestures, body, inverse kinematics, valves and show put together."""

from reina.performance.frame import BLOCK_FRAMES, FrameBlock, FrameLayout, SkeletonLayout
from reina.performance.performance import TAIL_S, Performance
from reina.performance.performer import (
    Performer,
    any_player_pattern,
    player_parameters,
    player_prefix,
)
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
    "any_player_pattern",
    "player_parameters",
    "player_prefix",
]
