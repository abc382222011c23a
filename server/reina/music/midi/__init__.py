"""Standard MIDI Files, read tolerantly into arrays."""

from reina.music.midi.reader import read_midi

__all__ = ["read_midi"]
