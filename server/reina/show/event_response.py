"""How a track answers events: a swell at each of them, or another value from each of them on."""

import re
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import (
    AfterValidator,
    ConfigDict,
    Field,
    Strict,
    ValidationInfo,
    field_validator,
    model_validator,
)

from reina.curves.arrays import BoolArray, FloatArray
from reina.curves.value_types import LARGEST, Pair
from reina.show.model import Count, Index, ShowModel
from reina.show.time_map import TimeMap, TimeUnit
from reina.show.triggers import LIMBS, Limb, Occasion, Triggers

Blend = Literal["replace", "add", "multiply", "max"]
PIECE_NAME = "^[a-z][a-z0-9_]{0,39}$"
SOME = Field(json_schema_extra={"minItems": 1})
Length = Annotated[float, Field(ge=0.0, le=LARGEST)]


def _in_order(valves: tuple[int, ...]) -> tuple[int, ...]:
    return tuple(sorted(valves))


def _name(piece: str) -> str:
    if re.fullmatch(PIECE_NAME, piece) is None:
        raise ValueError("a piece's name is of small letters, digits and _, 40 at most, as snare or tom_high")
    return piece


PieceName = Annotated[str, AfterValidator(_name), Field(json_schema_extra={"pattern": PIECE_NAME})]


def _some(names: tuple[str, ...]) -> tuple[str, ...]:
    """A length that the type asks for would be missed, too, where a name is at fault."""
    if not names:
        raise ValueError("a list of one value at least is needed here; leave it out to let all through")
    return names


class NoteFilter(ShowModel):
    """Which notes count; what is not given lets all of them through."""

    part: Index | None = None
    """Index of the part; notes of a part that is joined to it count too."""
    pitch: Pair | None = None
    """Lowest and highest MIDI number, both counted in."""
    velocity: Pair | None = None
    """Least and greatest velocity, 0..1."""
    valves: Annotated[tuple[Count, ...], Strict(strict=False), AfterValidator(_in_order)] | None = None
    """Numbers of valves, from 1; those notes count that press exactly these, none for open notes."""
    pieces: Annotated[tuple[PieceName, ...], Strict(strict=False), AfterValidator(_some), SOME] | None = None
    """Pieces of a drum kit, as ``snare``; those notes count that strike one of these."""
    limbs: Annotated[tuple[Limb, ...], Strict(strict=False), AfterValidator(_some), SOME] | None = None
    """A drummer's hands and feet; those notes count that are struck with one of these."""

    def passes(self, triggers: Triggers) -> BoolArray:
        """Which of the notes count, ``(N,)``."""
        passed = np.ones(triggers.onset_s.size, dtype=np.bool_)
        if self.part is not None:
            passed &= (triggers.part == self.part) | (triggers.joined_to == self.part)
        if self.pitch is not None:
            passed &= (triggers.pitch >= self.pitch[0]) & (triggers.pitch <= self.pitch[1])
        if self.velocity is not None:
            passed &= (triggers.velocity >= self.velocity[0]) & (triggers.velocity <= self.velocity[1])
        if self.valves is not None:
            count = triggers.valves.shape[1]
            wanted = np.array([valve in self.valves for valve in range(1, count + 1)], dtype=np.bool_)
            passed &= triggers.fingered & np.all(triggers.valves == wanted, axis=1)
            passed &= max(self.valves, default=0) <= count
        if self.pieces is not None:
            wanted = [index for index, piece in enumerate(triggers.pieces) if piece in self.pieces]
            passed &= np.isin(triggers.piece, wanted)
        if self.limbs is not None:
            passed &= np.isin(triggers.limb, [LIMBS.index(limb) for limb in self.limbs])
        return passed


class EventResponse(ShowModel):
    """What a track does at events, on top of its keyframes: a swell (`amount`) or values in turn (`cycle`).

    Times are in the track's unit.
    """

    model_config = ConfigDict(
        json_schema_extra={"oneOf": [{"required": ["amount"]}, {"required": ["cycle"]}]}
    )

    on: Occasion
    """What it answers."""
    where: NoteFilter = NoteFilter()
    """Which notes count."""
    every: Count = 1
    """Only each such event, from the first: 2 takes every other one."""
    attack: Length = 0.0
    """From the event until the swell is whole, straight."""
    hold: Length = 0.0
    """How long it stays whole."""
    decay: Length = 0.0
    """From then until it is gone, fast at first: (1 - x)²."""
    amount: Any = None
    """The swell's value at its height."""
    by_velocity: bool = False
    """Whether a note's velocity scales its swell."""
    blend: Blend = "replace"
    """How the swell e, 0..1, is put on the keyframes' value v: `replace` goes from v to the amount, `add` is
    v + e · amount, `multiply` is v · (1 + e · (amount - 1)), `max` the greater of v and e · amount."""
    cycle: Annotated[tuple[Any, ...], Strict(strict=False), Field(min_length=1)] = ()
    """Values that take turns: the first from the first event on, the second from the second on."""

    @field_validator("where", "by_velocity")
    @classmethod
    def _notes_alone(cls, value: Any, info: ValidationInfo) -> Any:
        on = info.data.get("on", "notes")
        if on != "notes":
            raise ValueError(f"only notes are told apart; {on} have neither where nor by_velocity")
        return value

    @model_validator(mode="after")
    def _either(self) -> Self:
        if (self.amount is None) == (not self.cycle):
            raise ValueError("it has either an amount, for a swell, or a cycle of values")
        if self.amount is not None and not self.attack + self.hold + self.decay > 0.0:
            raise ValueError("a swell lasts longer than 0; give it a hold or a decay")
        return self

    def events(self, triggers: Triggers, time_map: TimeMap, unit: TimeUnit) -> tuple[FloatArray, FloatArray]:
        """When the events are, in the track's unit, and how strong; two ``(E,)``, no two at one time."""
        if self.on == "notes":
            passed = self.where.passes(triggers)
            times_s = triggers.onset_s[passed]
            strengths = triggers.velocity[passed] if self.by_velocity else np.ones(times_s.size)
        else:
            times_s = triggers.beats_s(time_map) if self.on == "beats" else triggers.bars_s(time_map)
            strengths = np.ones(times_s.size)
        if times_s.size == 0:
            return np.zeros(0), np.zeros(0)
        first = np.flatnonzero(np.concatenate([[True], np.diff(times_s) > 1e-9]))
        strongest = np.maximum.reduceat(strengths, first)
        times = time_map.from_seconds(times_s[first], unit)
        return times[:: self.every], strongest[:: self.every]
