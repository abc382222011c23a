"""One line of an instrument's fingering chart."""

from dataclasses import dataclass


@dataclass(frozen=True)
class ChartNote:
    """How one note of an instrument is fingered.

    Attributes:
        sounding_pitch: MIDI number as it sounds.
        written_pitch: MIDI number as the player reads it.
        fingerings: The usual one first, then the alternates, the more usual first. Each is the
            valves that are down, ascending.
    """

    sounding_pitch: int
    written_pitch: int
    fingerings: tuple[tuple[int, ...], ...]
