"""Scores, their readers, tempo and metre, the music clock and note events.

Usable without a server: ``read_score(path.read_bytes(), filename=path.name)``.
"""

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
