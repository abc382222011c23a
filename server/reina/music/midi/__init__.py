"""Standard MIDI Files, read tolerantly into arrays, and written."""

from reina.music.midi.reader import read_midi
from reina.music.midi.writer import write_midi

__all__ = ["read_midi", "write_midi"]
