"""MusicXML, partwise or timewise, into a score: as it is played, repeats and all."""

from reina.music.musicxml.reader import read_musicxml

__all__ = ["read_musicxml"]
