"""The show: its document, tracks and edits, its answers to the music. Knows neither music nor skeletons."""

from reina.show.document import Marker
from reina.show.edits import EDITS, with_edits
from reina.show.errors import KeyNotFoundError, ShowError
from reina.show.event_response import EventResponse, NoteFilter
from reina.show.show import Show
from reina.show.show_history import ShowHistory
from reina.show.show_plan import ShowPlan
from reina.show.show_writer import keyframe_document, track_document
from reina.show.time_map import TimeMap, TimeUnit
from reina.show.track import Track, UnknownTrack
from reina.show.triggers import LIMBS, Triggers
from reina.show.unknown_choices import unknown_choices

__all__ = [
    "EDITS",
    "LIMBS",
    "EventResponse",
    "KeyNotFoundError",
    "Marker",
    "NoteFilter",
    "Show",
    "ShowError",
    "ShowHistory",
    "ShowPlan",
    "TimeMap",
    "TimeUnit",
    "Track",
    "Triggers",
    "UnknownTrack",
    "keyframe_document",
    "track_document",
    "unknown_choices",
    "with_edits",
]
