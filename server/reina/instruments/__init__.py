"""Instruments: which part they play, what is playable of it, and with which fingering.

Usable without a server: ``INSTRUMENTS["trumpet"].play(score, part)``.
"""

from collections.abc import Mapping
from types import MappingProxyType

from reina.instruments.brass.family import FAMILY
from reina.instruments.cast_reasons import UnplayedPart, casting_reasons, unplayed_parts
from reina.instruments.casting import HANDEDNESS, MAX_PLAYERS, Cast, CastError, Casting
from reina.instruments.describe import describe_notes, describe_score
from reina.instruments.find_cast import find_cast
from reina.instruments.instrument import Instrument
from reina.instruments.pitch_names import pitch_name
from reina.instruments.played import Fingering, Line, PlayedPart
from reina.instruments.ranking import PartRanking
from reina.instruments.trumpet import TRUMPET
from reina.instruments.tune import TunePassage, who_has_tune

INSTRUMENTS: Mapping[str, Instrument] = MappingProxyType(
    {instrument.name: instrument for instrument in (TRUMPET, *FAMILY.values()) if instrument.rig}
)
"""What a player can hold, by name: instruments with a rig."""

BRASS: Mapping[str, Instrument] = MappingProxyType({**INSTRUMENTS, **FAMILY})
"""All valved brass that has a fingering, with a rig or without, by name."""

__all__ = [
    "BRASS",
    "HANDEDNESS",
    "INSTRUMENTS",
    "MAX_PLAYERS",
    "Cast",
    "CastError",
    "Casting",
    "Fingering",
    "Instrument",
    "Line",
    "PartRanking",
    "PlayedPart",
    "TunePassage",
    "UnplayedPart",
    "casting_reasons",
    "describe_notes",
    "describe_score",
    "find_cast",
    "pitch_name",
    "unplayed_parts",
    "who_has_tune",
]
