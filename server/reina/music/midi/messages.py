"""Channel messages as columns."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from reina.music.arrays import IntArray
from reina.music.midi.track import NOTE_ON, Track

CHANNELS_OF_PORT = 16


@dataclass(frozen=True)
class Messages:
    """The channel messages of all tracks as columns of one length.

    Attributes:
        track: Index of the track.
        tick: Time in ticks.
        command: Upper four bits of the status.
        channel: Counted from 0, 16 to a port.
        first: First data byte.
        second: Second data byte, or 0.
    """

    track: IntArray
    tick: IntArray
    command: IntArray
    channel: IntArray
    first: IntArray
    second: IntArray

    @classmethod
    def of(cls, tracks: Sequence[Track]) -> "Messages":
        """Unpack the messages of `tracks`, one track after the other."""
        lengths = [len(track.packed) for track in tracks]
        packed = np.concatenate([np.array(track.packed, dtype=np.int64) for track in tracks])
        status = packed >> 16 & 0xFF
        named = [port for track in tracks for _, port in track.ports]
        ports = np.concatenate([_ports(track, setup_port=min(named, default=0)) for track in tracks])
        # Numbered by their order: a file whose only port is the third has channels 0 to 15 like any other.
        port = np.unique(ports, return_inverse=True)[1].astype(np.int64)
        return cls(
            track=np.repeat(np.arange(len(tracks)), lengths),
            tick=packed >> 24,
            command=status >> 4,
            channel=port * CHANNELS_OF_PORT + (status & 0xF),
            first=packed >> 8 & 0xFF,
            second=packed & 0xFF,
        )

    def take(self, chosen: IntArray) -> "Messages":
        """Return the messages at the given indices."""
        columns = (self.track, self.tick, self.command, self.channel, self.first, self.second)
        return Messages(*(column[chosen] for column in columns))


def _ports(track: Track, setup_port: int) -> IntArray:
    """Return the port of each channel message of a track.

    Until the first port is named that one holds too: programs often stand before it. Where none is named, it
    is 0; a track without notes sets up the first port that there is.
    """
    if not track.ports:
        has_notes = any(message >> 20 & 0xF == NOTE_ON for message in track.packed)
        return np.full(len(track.packed), 0 if has_notes else setup_port)
    begins = np.array([begin for begin, _ in track.ports])
    ports = np.array([port for _, port in track.ports])
    named = np.searchsorted(begins, np.arange(len(track.packed)), side="right") - 1
    return ports[np.maximum(named, 0)]
