"""What an instrument makes of its player's motion: the seam between curves and poses."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Hashable, Mapping, Sequence

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

    def rows(self, rows: slice) -> BodyMotion:
        """Some of the frames only."""
        stance = None if self.stance is None else self.stance[rows]
        return BodyMotion(
            times_s=self.times_s[rows],
            shown=self.shown[rows],
            curves=self.curves[:, rows],
            amounts={name: row[rows] for name, row in self.amounts.items()},
            signals={name: row[rows] for name, row in self.signals.items()},
            lowered=self.lowered[rows],
            stance=stance if stance is not None and stance.any() else None,
        )


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


@runtime_checkable
class FramewiseBody(InstrumentBody, Protocol):
    """A body that may say that it is asked for many blocks at once, which costs less a block."""

    @property
    def is_framewise(self) -> bool:
        """Whether a frame is the same to the last bit, whatever others it is solved with."""
        ...


@runtime_checkable
class FigureBody(InstrumentBody, Protocol):
    """A body that poses for all players with an equal `figure` at once.

    What costs time in NumPy is the number of calls, not of numbers, so four players that are posed as one of
    four times as many frames take little more than half of the time.
    """

    @property
    def figure(self) -> Hashable:
        """All that a pose depends on beside the motion: rigs, hold, which curves there are."""
        ...

    def pose(self, motions: Sequence[BodyMotion]) -> tuple[Float32Array, FloatArray]:
        """The poses of K players, F frames each; each block's to the last bit as by itself.

        Args:
            motions: One a player; all with a stance of as many rows, or none.

        Returns:
            Rotations ``(K, F, J, 4)`` and root positions ``(K, F, S, 3)``, each player's as `BodyFrames` has
            them.
        """
        ...

    def parameters(self, motion: BodyMotion) -> FloatArray:
        """The values of `Instrument.parameters` of this player, ``(F, P)``."""
        ...
