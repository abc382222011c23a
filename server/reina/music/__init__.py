"""Scores, their readers, tempo and metre, the music clock and note events.

Usable without a server: ``read_score(path.read_bytes(), filename=path.name)``.

A name's module is imported when the name is asked for: a process that measures a recording reads no score,
and is there a quarter of a second sooner without what reads them.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from reina.music.clock import ClockError, ClockState, MusicClock, Span
    from reina.music.controls import Control, ControlKind
    from reina.music.document.schema import score_schema
    from reina.music.document.writer import score_document
    from reina.music.errors import NotInScoreError, ScoreError, ScoreLimitError
    from reina.music.events import Listener, NoteEvent, NoteEventEmitter
    from reina.music.findings import Finding, findings_of
    from reina.music.key_signature import KeySignature
    from reina.music.limits import DEFAULT_LIMITS, Limits
    from reina.music.metre import BarPosition, MetreMap, TimeSignature
    from reina.music.notes import Note, Notes
    from reina.music.read import read_score
    from reina.music.retime import SongTimes, from_second_zero, retimed
    from reina.music.score import Part, Score
    from reina.music.tempo import Tempo, TempoMap
    from reina.music.transpose import transposed
    from reina.music.warnings import ScoreWarning, WarningLog

__all__ = [
    "DEFAULT_LIMITS",
    "BarPosition",
    "ClockError",
    "ClockState",
    "Control",
    "ControlKind",
    "Finding",
    "KeySignature",
    "Limits",
    "Listener",
    "MetreMap",
    "MusicClock",
    "NotInScoreError",
    "Note",
    "NoteEvent",
    "NoteEventEmitter",
    "Notes",
    "Part",
    "Score",
    "ScoreError",
    "ScoreLimitError",
    "ScoreWarning",
    "SongTimes",
    "Span",
    "Tempo",
    "TempoMap",
    "TimeSignature",
    "WarningLog",
    "findings_of",
    "from_second_zero",
    "read_score",
    "retimed",
    "score_document",
    "score_schema",
    "transposed",
]

_PLACES = {
    "BarPosition": "reina.music.metre",
    "ClockError": "reina.music.clock",
    "ClockState": "reina.music.clock",
    "Control": "reina.music.controls",
    "ControlKind": "reina.music.controls",
    "DEFAULT_LIMITS": "reina.music.limits",
    "Finding": "reina.music.findings",
    "KeySignature": "reina.music.key_signature",
    "Limits": "reina.music.limits",
    "Listener": "reina.music.events",
    "MetreMap": "reina.music.metre",
    "MusicClock": "reina.music.clock",
    "NotInScoreError": "reina.music.errors",
    "Note": "reina.music.notes",
    "NoteEvent": "reina.music.events",
    "NoteEventEmitter": "reina.music.events",
    "Notes": "reina.music.notes",
    "Part": "reina.music.score",
    "Score": "reina.music.score",
    "ScoreError": "reina.music.errors",
    "ScoreLimitError": "reina.music.errors",
    "ScoreWarning": "reina.music.warnings",
    "SongTimes": "reina.music.retime",
    "Span": "reina.music.clock",
    "Tempo": "reina.music.tempo",
    "TempoMap": "reina.music.tempo",
    "TimeSignature": "reina.music.metre",
    "WarningLog": "reina.music.warnings",
    "findings_of": "reina.music.findings",
    "from_second_zero": "reina.music.retime",
    "read_score": "reina.music.read",
    "retimed": "reina.music.retime",
    "score_document": "reina.music.document.writer",
    "score_schema": "reina.music.document.schema",
    "transposed": "reina.music.transpose",
}
"""In which module each name is."""


def __getattr__(name: str) -> object:
    place = _PLACES.get(name)
    if place is None:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value: object = getattr(import_module(place), name)
    globals()[name] = value
    return value
