"""What happens in the music, as arrays: the events that a track may answer."""

import math
from dataclasses import dataclass, field
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from reina.curves.arrays import BoolArray, FloatArray
from reina.show.time_map import TimeMap

Numbers = NDArray[np.signedinteger[Any]]
"""Small ones: of the narrowest type that holds them."""
Occasion = Literal["notes", "beats", "bars"]
OCCASIONS: tuple[Occasion, ...] = get_args(Occasion)
Limb = Literal["left_hand", "right_hand", "left_foot", "right_foot"]
LIMBS: tuple[Limb, ...] = get_args(Limb)


def _no_floats() -> FloatArray:
    return np.zeros(0)


def _no_numbers() -> Numbers:
    return np.zeros(0, dtype=np.int8)


@dataclass(frozen=True, eq=False)
class Triggers:
    """The notes of a score as columns, in the order of their onsets, and how long the score is.

    Attributes:
        onset_s: ``(N,)``.
        part: ``(N,)`` index of the part.
        pitch: ``(N,)`` MIDI number as sounded.
        velocity: ``(N,)`` 0..1.
        valves: ``(N, V)`` which valves are down; V is 0 where nobody knows.
        fingered: ``(N,)`` which notes are played on valves at all; by default all.
        pieces: The pieces that are struck, by name.
        piece: ``(N,)`` index of what each note strikes among `pieces`, -1 where none is; by default so.
        limb: ``(N,)`` index of what strikes it among `LIMBS`, or -1.
        end_s: Where beats and bars end.
        joined_to: ``(N,)`` index of the part that each note's part is joined to; its own part otherwise.
    """

    onset_s: FloatArray = field(default_factory=_no_floats)
    part: Numbers = field(default_factory=_no_numbers)
    pitch: Numbers = field(default_factory=_no_numbers)
    velocity: FloatArray = field(default_factory=_no_floats)
    valves: BoolArray = field(default_factory=lambda: np.zeros((0, 0), dtype=np.bool_))
    fingered: BoolArray = field(default_factory=lambda: np.zeros(0, dtype=np.bool_))
    pieces: tuple[str, ...] = ()
    piece: Numbers = field(default_factory=_no_numbers)
    limb: Numbers = field(default_factory=_no_numbers)
    end_s: float = 0.0
    joined_to: Numbers = field(default_factory=_no_numbers)

    def __post_init__(self) -> None:
        counts = {column.shape[0] for column in (self.onset_s, self.part, self.pitch, self.velocity)}
        if self.valves.size == 0:
            object.__setattr__(self, "valves", np.zeros((self.onset_s.size, 0), dtype=np.bool_))
        if self.fingered.size == 0:
            object.__setattr__(self, "fingered", np.ones(self.onset_s.size, dtype=np.bool_))
        if self.joined_to.size == 0:
            object.__setattr__(self, "joined_to", self.part)
        for name in ("piece", "limb"):
            if getattr(self, name).size == 0:
                object.__setattr__(self, name, np.full(self.onset_s.size, -1, dtype=np.int8))
        others = {
            column.shape[0] for column in (self.valves, self.fingered, self.joined_to, self.piece, self.limb)
        }
        if counts | others != {self.onset_s.size}:
            raise ValueError("the columns of triggers are of one length, one entry a note")
        if np.any(np.diff(self.onset_s) < 0.0):
            raise ValueError("triggers stand in the order of their onsets")

    def beats_s(self, time_map: TimeMap) -> FloatArray:
        """Every beat before the end, seconds."""
        last = float(time_map.beats(np.array([self.end_s]))[0])
        return time_map.to_seconds(_whole_numbers(last), "beats")

    def bars_s(self, time_map: TimeMap) -> FloatArray:
        """Every bar line before the end, seconds."""
        last = float(time_map.from_seconds(np.array([self.end_s]), "bars")[0])
        return time_map.to_seconds(_whole_numbers(last), "bars")


def _whole_numbers(end: float) -> FloatArray:
    """0, 1, 2 and so on, before an end."""
    return np.arange(max(0, math.ceil(end - 1e-9)), dtype=np.float64)
