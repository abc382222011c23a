"""Notation: keys, spelling, and played notes as values in bars.

Usable without a server: ``keys_of(score)``, ``spell(pitches, onset_beats, keys)``.
"""

from reina.notation.keys import Key, key_at, keys_of
from reina.notation.spelling import both_names, named, spell

__all__ = ["Key", "both_names", "key_at", "keys_of", "named", "spell"]
