"""Standard MIDI Files, read tolerantly into arrays, and written (`midi.writer`)."""

from reina.music.midi.reader import read_midi

__all__ = ["read_midi"]
