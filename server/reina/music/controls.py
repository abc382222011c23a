"""What a synthesizer needs to know beside the notes."""

from typing import Literal, NamedTuple

ControlKind = Literal["program", "controller", "pitch_bend", "channel_pressure", "key_pressure"]


class Control(NamedTuple):
    """A message to one channel at one time.

    Attributes:
        kind: What kind of message.
        onset_s: When, seconds.
        onset_beats: When, quarter notes.
        channel: MIDI channel counted from 0.
        number: The controller's number (7 is volume), the key of a key pressure; 0 for other kinds.
        value: 0..127; for a pitch bend -8192..8191.
    """

    kind: ControlKind
    onset_s: float
    onset_beats: float
    channel: int
    number: int
    value: int
