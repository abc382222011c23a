"""Instruments: which part they play, what is playable of it, how it is fingered, and how their players move.

Usable without a server: ``INSTRUMENTS["trumpet"].play(score, part)``.
"""

from reina.instruments.cast_reasons import UnplayedPart, casting_reasons, unplayed_parts
from reina.instruments.casting import (
    HANDEDNESS,
    MAX_PLAYERS,
    Cast,
    CastError,
    Casting,
    refuse_handedness,
)
from reina.instruments.chart_note import ChartNote
from reina.instruments.choice_findings import choice_findings, spoken_name
from reina.instruments.describe import (
    describe_finding,
    describe_notes,
    describe_score,
    describe_warnings,
    score_findings,
)
from reina.instruments.ensemble import Ensemble
from reina.instruments.find_cast import find_cast
from reina.instruments.instrument import Instrument
from reina.instruments.joined_parts import check_parts
from reina.instruments.line import playable_line
from reina.instruments.note_fingerings import (
    KeysFingering,
    NoteFingering,
    SlideFingering,
    StrikeFingering,
    ValvesFingering,
)
from reina.instruments.note_names import NoteNames, spell_line
from reina.instruments.parameters import cast_parameters, player_parameters, streamed_parameters
from reina.instruments.performer import GESTURES, Performer, PerformerFrames
from reina.instruments.pitch_names import pitch_name
from reina.instruments.played import Fingering, Line, PlayedPart, Strokes
from reina.instruments.ranking import PartRanking, Suitability, rank_parts
from reina.instruments.registry import INSTRUMENTS
from reina.instruments.tune import TunePassage, who_has_tune

__all__ = [
    "GESTURES",
    "HANDEDNESS",
    "INSTRUMENTS",
    "MAX_PLAYERS",
    "Cast",
    "CastError",
    "Casting",
    "ChartNote",
    "Ensemble",
    "Fingering",
    "Instrument",
    "KeysFingering",
    "Line",
    "NoteFingering",
    "NoteNames",
    "PartRanking",
    "Performer",
    "PerformerFrames",
    "PlayedPart",
    "SlideFingering",
    "StrikeFingering",
    "Strokes",
    "Suitability",
    "TunePassage",
    "UnplayedPart",
    "ValvesFingering",
    "cast_parameters",
    "casting_reasons",
    "check_parts",
    "choice_findings",
    "describe_finding",
    "describe_notes",
    "describe_score",
    "describe_warnings",
    "find_cast",
    "pitch_name",
    "playable_line",
    "player_parameters",
    "rank_parts",
    "refuse_handedness",
    "score_findings",
    "spell_line",
    "spoken_name",
    "streamed_parameters",
    "unplayed_parts",
    "who_has_tune",
]
