"""What a performance evaluates to: a block of frames, and the layout that all of them have."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from reina.rotations import BLOCK_FRAMES

if TYPE_CHECKING:
    from reina.curves import Parameter
    from reina.instruments.player import SkeletonLayout
    from reina.instruments.player.instrument_body import Float32Array
    from reina.rotations.arrays import BoolArray, FloatArray


@dataclass(frozen=True)
class FrameLayout:
    """What every frame of a performance holds, and in which order.

    Attributes:
        fps: Frames a second of song time; frame k shows k / fps.
        skeletons: Of each performer the player's, then the instrument's.
        parameters: The show's, then what each performer gives: what moves of the instrument, and the face.
    """

    fps: int
    skeletons: tuple[SkeletonLayout, ...]
    parameters: tuple[Parameter, ...]


@dataclass(frozen=True, eq=False)
class FrameBlock:
    """F frames.

    Attributes:
        first_frame: Index of the first, a multiple of F.
        fps: Frames a second.
        song_time_s: ``(F,)``, index / fps.
        rotations: Local, rest included, of all skeletons in the layout's order, ``(F, J, 4)``; dot(q, rest)
            >= 0.
        root_positions: Of each skeleton's root, metres, ``(F, S, 3)``.
        parameters: In the layout's order, ``(F, P)``.
        cuts: Whether not to blend from the frame before, ``(F,)``.
    """

    first_frame: int
    fps: int
    song_time_s: FloatArray
    rotations: Float32Array
    root_positions: Float32Array
    parameters: Float32Array
    cuts: BoolArray

    def blocks(self) -> list[FrameBlock]:
        """The same frames by sixty."""
        return [
            FrameBlock(
                self.first_frame + first,
                self.fps,
                self.song_time_s[first : first + BLOCK_FRAMES],
                self.rotations[first : first + BLOCK_FRAMES],
                self.root_positions[first : first + BLOCK_FRAMES],
                self.parameters[first : first + BLOCK_FRAMES],
                self.cuts[first : first + BLOCK_FRAMES],
            )
            for first in range(0, len(self.song_time_s), BLOCK_FRAMES)
        ]
