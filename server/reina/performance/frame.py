"""What a performance evaluates to: a block of frames, and the layout that all of them have."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from reina.curves import Parameter
    from reina.rotations.arrays import BoolArray, FloatArray

BLOCK_FRAMES = 60
"""Frames are evaluated in aligned blocks of so many, so that no byte depends on how a frame was asked for."""

Float32Array = NDArray[np.float32]


@dataclass(frozen=True)
class SkeletonLayout:
    """A skeleton in the frame.

    Attributes:
        name: Its name there.
        rig: Its rig.
        joints: Its joints' names, parents first.
        player: Whose it is: a place in the cast, the first being 0.
    """

    name: str
    rig: str
    joints: tuple[str, ...]
    player: int = 0


@dataclass(frozen=True)
class FrameLayout:
    """What every frame of a performance holds, and in which order.

    Attributes:
        fps: Frames a second of song time; frame k shows k / fps.
        skeletons: Of each performer the player, then the instrument.
        parameters: The show's, then what each performer gives: valves, slide, face.
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
