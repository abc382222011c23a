"""Parameters over time: keyframes, interpolations, tracks, shows. Knows neither music nor skeletons."""

from reina.keyframes.default_show import write_default_show
from reina.keyframes.eased_keyframe import CubicBezierKeyframe, EasedKeyframe
from reina.keyframes.edits import EDITS, with_edits
from reina.keyframes.errors import KeyNotFoundError, ShowError
from reina.keyframes.event_response import EventResponse, NoteFilter
from reina.keyframes.interpolation import InterpolationError, interpolations
from reina.keyframes.keyframe import Keyframe
from reina.keyframes.music_form import MusicForm
from reina.keyframes.options import option
from reina.keyframes.outside import Outside
from reina.keyframes.parameter import Parameter
from reina.keyframes.parameter_registry import ParameterRegistry
from reina.keyframes.performance_event_emitter import PerformanceEventEmitter
from reina.keyframes.show import Marker, Show
from reina.keyframes.show_history import ShowHistory
from reina.keyframes.show_plan import ShowPlan
from reina.keyframes.show_writer import keyframe_document, track_document
from reina.keyframes.spaces import OKLAB, ORIENTATION
from reina.keyframes.spline_keyframe import AutomaticKeyframe, ClampedKeyframe, SplineKeyframe
from reina.keyframes.stage_parameters import STAGE_PARAMETERS, stage_registry
from reina.keyframes.time_map import TimeMap, TimeUnit
from reina.keyframes.track import Track, UnknownTrack
from reina.keyframes.triggers import Triggers

__all__ = [
    "EDITS",
    "OKLAB",
    "ORIENTATION",
    "STAGE_PARAMETERS",
    "AutomaticKeyframe",
    "ClampedKeyframe",
    "CubicBezierKeyframe",
    "EasedKeyframe",
    "EventResponse",
    "InterpolationError",
    "KeyNotFoundError",
    "Keyframe",
    "Marker",
    "MusicForm",
    "NoteFilter",
    "Outside",
    "Parameter",
    "ParameterRegistry",
    "PerformanceEventEmitter",
    "Show",
    "ShowError",
    "ShowHistory",
    "ShowPlan",
    "SplineKeyframe",
    "TimeMap",
    "TimeUnit",
    "Track",
    "Triggers",
    "UnknownTrack",
    "interpolations",
    "keyframe_document",
    "option",
    "stage_registry",
    "track_document",
    "with_edits",
    "write_default_show",
]
