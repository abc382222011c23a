"""How a track answers events: a swell at each of them, or another value from each of them on."""

from dataclasses import dataclass
from typing import Any, Literal, get_args

import numpy as np

from reina.curves.arrays import BoolArray, FloatArray
from reina.show.time_map import TimeMap, TimeUnit
from reina.show.triggers import Occasion, Triggers

Blend = Literal["replace", "add", "multiply", "max"]
BLENDS: tuple[Blend, ...] = get_args(Blend)


@dataclass(frozen=True)
class NoteFilter:
    """Which notes count; what is None lets all of them through.

    Attributes:
        part: Index of the part; notes of a part that is joined to it count too.
        pitch: Lowest and highest MIDI number, both counted in.
        velocity: Least and greatest velocity, 0..1.
        valves: Numbers of valves, from 1; those notes count that press exactly these, none for open notes.
    """

    part: int | None = None
    pitch: tuple[float, float] | None = None
    velocity: tuple[float, float] | None = None
    valves: tuple[int, ...] | None = None

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
            passed &= np.all(triggers.valves == wanted, axis=1) & (max(self.valves, default=0) <= count)
        return passed


@dataclass(frozen=True)
class EventResponse:
    """What a track does at events, on top of its keyframes. Times are in the track's unit.

    Attributes:
        on: What it answers.
        where: Which notes count.
        every: Only each such event, from the first: 2 takes every other one.
        attack: From the event until the swell is whole, straight.
        hold: How long it stays whole.
        decay: From then until it is gone, fast at first: (1 - x)².
        amount: The swell's value at its height. None where `cycle` is given.
        by_velocity: Whether a note's velocity scales its swell.
        blend: How the swell e, 0..1, is put on the keyframes' value v: ``replace`` goes from v to the
            amount, ``add`` is v + e · amount, ``multiply`` is v · (1 + e · (amount - 1)), ``max`` the greater
            of v and e · amount.
        cycle: Values that take turns: the first from the first event on, the second from the second on. Empty
            where `amount` is given.
    """

    on: Occasion
    where: NoteFilter = NoteFilter()
    every: int = 1
    attack: float = 0.0
    hold: float = 0.0
    decay: float = 0.0
    amount: Any = None
    by_velocity: bool = False
    blend: Blend = "replace"
    cycle: tuple[Any, ...] = ()

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
