"""Programs, controllers, bends and pressures with their times."""

import numpy as np

from reina.music.controls import Control, ControlKind
from reina.music.midi.division import Division
from reina.music.midi.messages import Messages
from reina.music.midi.track import CHANNEL_PRESSURE, CONTROLLER, KEY_PRESSURE, PITCH_BEND, PROGRAM
from reina.music.tempo import TempoMap

CONTROL_KINDS: dict[int, ControlKind] = {
    KEY_PRESSURE: "key_pressure",
    CONTROLLER: "controller",
    PROGRAM: "program",
    CHANNEL_PRESSURE: "channel_pressure",
    PITCH_BEND: "pitch_bend",
}


def read_controls(messages: Messages, division: Division, tempo_map: TempoMap) -> tuple[Control, ...]:
    """Return the messages that are controls, sorted by time."""
    messages = messages.take(np.flatnonzero(np.isin(messages.command, tuple(CONTROL_KINDS))))
    messages = messages.take(np.argsort(messages.tick, kind="stable"))
    beats = messages.tick / division.ticks_per_beat
    has_number = (messages.command == CONTROLLER) | (messages.command == KEY_PRESSURE)
    bend = (messages.second << 7 | messages.first) - 8192
    value = np.where(
        has_number, messages.second, np.where(messages.command == PITCH_BEND, bend, messages.first)
    )
    columns = zip(
        (CONTROL_KINDS[command] for command in messages.command.tolist()),
        tempo_map.seconds(beats).tolist(),
        beats.tolist(),
        messages.channel.tolist(),
        np.where(has_number, messages.first, 0).tolist(),
        value.tolist(),
        strict=True,
    )
    return tuple(map(Control._make, columns))
