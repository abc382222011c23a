"""Show and performers put together: what is on screen at any frame."""

from reina.performance.cast_parameters import any_player_pattern, schema_parameters, show_parameters
from reina.performance.frame import FrameBlock, FrameLayout
from reina.performance.performance import TAIL_S, Performance
from reina.rotations import BLOCK_FRAMES

__all__ = [
    "BLOCK_FRAMES",
    "TAIL_S",
    "FrameBlock",
    "FrameLayout",
    "Performance",
    "any_player_pattern",
    "schema_parameters",
    "show_parameters",
]
