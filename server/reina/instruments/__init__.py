"""Instruments: which part they play, what is playable of it, and with which fingering.

Usable without a server: ``INSTRUMENTS["trumpet"].play(score, part)``.
"""

from collections.abc import Mapping
from types import MappingProxyType

from reina.instruments.describe import describe_notes, describe_score
from reina.instruments.instrument import Instrument
from reina.instruments.pitch_names import pitch_name
from reina.instruments.played import Fingering, Line, PlayedPart
from reina.instruments.ranking import PartRanking
from reina.instruments.trumpet import TRUMPET

INSTRUMENTS: Mapping[str, Instrument] = MappingProxyType({"trumpet": TRUMPET})
"""What a player can hold, by name."""

__all__ = [
    "INSTRUMENTS",
    "Fingering",
    "Instrument",
    "Line",
    "PartRanking",
    "PlayedPart",
    "describe_notes",
    "describe_score",
    "pitch_name",
]
