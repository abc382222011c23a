"""Writes a passage as a standard MIDI file whose ticks are samples."""

import struct
from collections.abc import Iterable

DIVISION = 24000
TEMPO_US = 500_000
"""Microseconds a beat: 24,000 ticks in half a second are 48,000 ticks a second, one a sample."""


def write_midi(events: Iterable[tuple[int, bytes]], *, end_tick: int) -> bytes:
    """Return a MIDI file of format 0.

    Args:
        events: Tick (a sample at 48 kHz) and whole message of each event, in order.
        end_tick: Where the track ends; not before the last event.
    """
    track = bytearray(b"\x00\xff\x51\x03" + TEMPO_US.to_bytes(3, "big"))
    before = 0
    for tick, message in events:
        track += _variable_length(tick - before) + message
        before = tick
    track += _variable_length(end_tick - before) + b"\xff\x2f\x00"
    return (
        struct.pack(">4sIHHH", b"MThd", 6, 0, 1, DIVISION) + struct.pack(">4sI", b"MTrk", len(track)) + track
    )


def _variable_length(number: int) -> bytes:
    if number < 0x80:
        return bytes((number,))
    digits = [number & 0x7F]
    while number := number >> 7:
        digits.append(number & 0x7F | 0x80)
    return bytes(reversed(digits))
