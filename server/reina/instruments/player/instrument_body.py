"""What an instrument makes of its player's motion: the seam between curves and poses."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Mapping

    from reina.rotations.arrays import FloatArray

Float32Array = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class BodyMotion:
    """What moves a body in F frames.

    Attributes:
        times_s: Song times, ``(F,)``.
        shown: The show's values, ``(F, P)``.
        curves: The values of all planned curves, ``(C, F)``, as `MotionCurves.evaluate` gives them.
        amounts: How much of each gesture the show asks for, by name, ``(F,)`` each.
        signals: What moves the trunk, by the name of `body_table.SIGNALS`, ``(F,)`` each.
        lowered: How far what is held is taken down, 0..1, ``(F,)``.
        stance: What a way of standing adds, as `Stances.evaluate` gives it, or None.
    """

    times_s: FloatArray
    shown: FloatArray
    curves: FloatArray
    amounts: Mapping[str, FloatArray]
    signals: Mapping[str, FloatArray]
    lowered: FloatArray
    stance: FloatArray | None


@dataclass(frozen=True, eq=False)
class BodyFrames:
    """F frames of a player and of what is played, as if in the middle of the stage.

    Attributes:
        rotations: Local, rest included, of the player's joints and then of each of the instrument's
            skeletons, ``(F, J, 4)``.
        root_positions: Of the player and of each of the instrument's skeletons, metres, ``(F, S, 3)``.
        parameters: The values of `Instrument.parameters`, ``(F, P)``.
    """

    rotations: Float32Array
    root_positions: FloatArray
    parameters: FloatArray


class InstrumentBody(Protocol):
    """A player's body on an instrument; a pure function of what moves it."""

    def solve(self, motion: BodyMotion) -> BodyFrames:
        """The poses of F frames."""
        ...
