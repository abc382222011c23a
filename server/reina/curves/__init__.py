"""Values over time: keyframes, interpolations, channels, the sampler of a value. Knows no show."""

from reina.curves.eased_keyframe import CubicBezierKeyframe, EasedKeyframe
from reina.curves.extrapolation import Extrapolation
from reina.curves.interpolation import InterpolationError, interpolations
from reina.curves.keyframe import Keyframe
from reina.curves.options import option
from reina.curves.parameter import Parameter
from reina.curves.parameter_registry import ParameterRegistry
from reina.curves.performance_event_emitter import PerformanceEventEmitter
from reina.curves.spaces import OKLAB, ORIENTATION
from reina.curves.spline_keyframe import AutomaticKeyframe, ClampedKeyframe, SplineKeyframe

__all__ = [
    "OKLAB",
    "ORIENTATION",
    "AutomaticKeyframe",
    "ClampedKeyframe",
    "CubicBezierKeyframe",
    "EasedKeyframe",
    "Extrapolation",
    "InterpolationError",
    "Keyframe",
    "Parameter",
    "ParameterRegistry",
    "PerformanceEventEmitter",
    "SplineKeyframe",
    "interpolations",
    "option",
]
