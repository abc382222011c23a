"""Which valves sound which pitch how well in tune: tube lengths and the harmonic series.

A brass instrument's air column sounds the harmonics n·c / 2L of a tube of the length L (c the speed of sound
in it); a valve adds its loop to L. Valves that are in tune alone are too short together: that is why 1-3 and
1-2-3 are sharp. Source: A. H. Benade, Fundamentals of Musical Acoustics, chapter 20.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

CENTS = 1200.0


@dataclass(frozen=True)
class Tube:
    """The sounding length of an instrument.

    Attributes:
        open_length_m: Without valves.
        valve_lengths_m: What each valve adds, valve 1 first.
        fundamental: MIDI number of the open tube's first harmonic.
        slide_travel_m: How far the third valve's slide goes out; it adds twice that.
    """

    open_length_m: float
    valve_lengths_m: tuple[float, ...]
    fundamental: int
    slide_travel_m: float

    def length_m(self, valves: Sequence[int]) -> float:
        """Return the tube's length with `valves` (numbers from 1) down."""
        return self.open_length_m + sum(self.valve_lengths_m[valve - 1] for valve in valves)

    def lowering(self, valves: Sequence[int]) -> float:
        """Return by how many cents `valves` lower a harmonic."""
        return CENTS * math.log2(self.length_m(valves) / self.open_length_m)

    def harmonic(self, pitch: int, valves: Sequence[int]) -> int:
        """Return which harmonic is nearest to a MIDI number with `valves` down, 1 at least."""
        above = (pitch - self.fundamental) * 100.0 + self.lowering(valves)
        nearest = max(1, round(2.0 ** (above / CENTS)))
        # Harmonics are not evenly spaced in cents, so the nearest in cents may be the next one.
        return min((nearest - 1 or 1, nearest, nearest + 1), key=lambda n: abs(CENTS * math.log2(n) - above))

    def cents(self, pitch: int, valves: Sequence[int], slide: float = 0.0) -> float:
        """Return how far the nearest harmonic is above the equally tempered pitch; `slide` is 0 to 1."""
        length = self.length_m(valves) + (2 * self.slide_travel_m * slide if 3 in valves else 0.0)
        target = (pitch - self.fundamental) * 100.0
        harmonic = CENTS * math.log2(self.harmonic(pitch, valves))
        return harmonic - CENTS * math.log2(length / self.open_length_m) - target

    def slide_for(self, pitch: int, valves: Sequence[int]) -> float:
        """Return the extension of the third slide, 0 to 1, that brings a pitch into tune as far as it can."""
        sharp = self.cents(pitch, valves)
        if 3 not in valves or self.slide_travel_m == 0 or sharp <= 0:
            return 0.0
        missing = self.length_m(valves) * (2.0 ** (sharp / CENTS) - 1.0)
        return min(1.0, missing / (2 * self.slide_travel_m))
