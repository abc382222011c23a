"""Ticks into beats and seconds."""

from dataclasses import dataclass
from fractions import Fraction

from reina.music.warnings import WarningLog

GUESSED_TICKS_PER_BEAT = 480
GUESSED_TICKS_PER_FRAME = 40

FRAMES_PER_SECOND = {
    24: Fraction(24),
    25: Fraction(25),
    29: Fraction(30000, 1001),
    30: Fraction(30),
}
"""SMPTE rates as the division names them; 29 is 30 drop-frame, which runs at 29.97."""


@dataclass(frozen=True)
class Division:
    """How long a tick is.

    Attributes:
        ticks_per_beat: Of a division in beats; the tempo says how long a beat is.
        seconds_per_tick: Of a division in SMPTE frames, where the tempo says nothing; None for beats.
    """

    ticks_per_beat: float
    seconds_per_tick: float | None = None


def read_division(division: int, log: WarningLog) -> Division:
    """Read the 16 bits of the header's division.

    In a file in SMPTE frames a beat is taken as half a second.
    """
    if not division & 0x8000:
        if division == 0:
            log.add("division_zero", "byte 12", f"0 ticks in a beat; {GUESSED_TICKS_PER_BEAT} were taken")
        return Division(float(division or GUESSED_TICKS_PER_BEAT))
    frames, ticks = 256 - (division >> 8), division & 0xFF
    rate = FRAMES_PER_SECOND.get(frames, Fraction(frames))
    if frames not in FRAMES_PER_SECOND:
        log.add("smpte_rate", "byte 12", f"{frames} SMPTE frames a second are not standard; taken as written")
    if ticks == 0:
        log.add("division_zero", "byte 13", f"0 ticks in a frame; {GUESSED_TICKS_PER_FRAME} were taken")
        ticks = GUESSED_TICKS_PER_FRAME
    seconds_per_tick = 1 / (rate * ticks)
    return Division(float(Fraction(1, 2) / seconds_per_tick), float(seconds_per_tick))
