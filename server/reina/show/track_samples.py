"""A track as curves to be drawn: its values at many times, and where they jump."""

from dataclasses import dataclass, replace

import numpy as np

from reina.curves.arrays import FloatArray, IntArray
from reina.curves.parameter import Parameter
from reina.curves.parameter_registry import ParameterRegistry
from reina.show.show_plan import ShowPlan
from reina.show.time_map import TimeMap
from reina.show.track import Track
from reina.show.track_plan import TrackPlan
from reina.show.triggers import Triggers


@dataclass(frozen=True, eq=False)
class Curve:
    """Values of one parameter at F times.

    Attributes:
        values: ``(F, L)`` as a frame has them.
        jumps: Indices of the times between which and the time before the value jumps.
    """

    values: FloatArray
    jumps: IntArray


def sample_track(
    plan: TrackPlan, times_s: FloatArray, time_map: TimeMap, triggers: Triggers
) -> tuple[Curve, Curve | None]:
    """A track over evenly spaced times, muted or not.

    Args:
        plan: The track, made ready.
        times_s: ``(F,)`` seconds, increasing evenly.
        time_map: How the music's time runs.
        triggers: What happens in the music.

    Returns:
        What its keyframes alone say, and what comes of it with its answer to events, or None where it has
        none.
    """
    keys_alone = replace(plan, track=replace(plan.track, events=None))
    curve = _sample(keys_alone, times_s, time_map, triggers)
    answers = plan.track.events is not None
    return curve, _sample(plan, times_s, time_map, triggers) if answers else None


def resting_plan(parameter: Parameter) -> TrackPlan:
    """The plan of a parameter that no track moves: its default throughout."""
    return TrackPlan.make(Track(parameter.path, ()), parameter)


def _sample(plan: TrackPlan, times_s: FloatArray, time_map: TimeMap, triggers: Triggers) -> Curve:
    # Jumps are looked for in all that interpolates, whether a page blends it or not.
    parameter = replace(plan.parameter, blend=plan.parameter.interpolates)
    step_s = float(times_s[1] - times_s[0]) if times_s.size > 1 else 0.0
    show_plan = ShowPlan(
        (replace(plan, parameter=parameter),),
        ParameterRegistry((parameter,)),
        time_map,
        triggers=triggers,
        fps=1.0 / step_s if step_s > 0.0 else 1.0,
    )
    values, cuts = show_plan.evaluate(times_s)
    if not parameter.interpolates:
        cuts = np.any(np.diff(values, axis=0, prepend=values[:1]) != 0.0, axis=1)
    return Curve(values, np.flatnonzero(cuts[1:]) + 1)
