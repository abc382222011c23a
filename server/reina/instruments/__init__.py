"""Instruments: which part they play, what is playable of it, and with which fingering.

Usable without a server: ``INSTRUMENTS["trumpet"].play(score, part)``.
"""

from collections.abc import Mapping
from types import MappingProxyType

from reina.instruments.brass.family import FAMILY
from reina.instruments.casting import MAX_PLAYERS, Cast, CastError, Casting
from reina.instruments.chart_note import ChartNote
from reina.instruments.describe import describe_notes, describe_score
from reina.instruments.instrument import Instrument
from reina.instruments.note_names import NoteNames, spell_line
from reina.instruments.pitch_names import pitch_name
from reina.instruments.played import Fingering, Line, PlayedPart
from reina.instruments.ranking import PartRanking
from reina.instruments.trumpet import TRUMPET

INSTRUMENTS: Mapping[str, Instrument] = MappingProxyType(
    {instrument.name: instrument for instrument in (TRUMPET, *FAMILY.values()) if instrument.rig}
)
"""What a player can hold, by name: instruments with a rig."""

BRASS: Mapping[str, Instrument] = MappingProxyType({**INSTRUMENTS, **FAMILY})
"""All valved brass that has a fingering, with a rig or without, by name."""

__all__ = [
    "BRASS",
    "INSTRUMENTS",
    "MAX_PLAYERS",
    "Cast",
    "CastError",
    "Casting",
    "ChartNote",
    "Fingering",
    "Instrument",
    "Line",
    "NoteNames",
    "PartRanking",
    "PlayedPart",
    "describe_notes",
    "describe_score",
    "pitch_name",
    "spell_line",
]
