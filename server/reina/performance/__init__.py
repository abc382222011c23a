"""Show and performers put together: what is on screen at any frame."""

from reina.performance.frame import BLOCK_FRAMES, FrameBlock, FrameLayout
from reina.performance.performance import TAIL_S, Performance

__all__ = [
    "BLOCK_FRAMES",
    "TAIL_S",
    "FrameBlock",
    "FrameLayout",
    "Performance",
]
