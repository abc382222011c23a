"""Notation: keys, spelling, and played notes as values in bars.

Usable without a server: ``keys_of(score)``, ``spell(pitches, onset_beats, keys)``,
``write_part(score, onset_s, end_s, pitches)``.
"""

from reina.notation.accidentals import Accidentals
from reina.notation.bars import Bar
from reina.notation.keys import Key, key_at, keys_of
from reina.notation.measures import Entry, Measure
from reina.notation.part import WrittenPart, write_part
from reina.notation.spelling import both_names, letter, named, octave, spell
from reina.notation.tempo_marks import TempoMark

__all__ = [
    "Accidentals",
    "Bar",
    "Entry",
    "Key",
    "Measure",
    "TempoMark",
    "WrittenPart",
    "both_names",
    "key_at",
    "keys_of",
    "letter",
    "named",
    "octave",
    "spell",
    "write_part",
]
