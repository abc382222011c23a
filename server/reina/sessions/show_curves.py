"""A show as curves, and the music's time, for a timeline that is drawn elsewhere."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reina.protocol.timeline import CurveLine, MusicTime, ShowCurve, ShowCurves, TimeKnots
from reina.sessions.music_arrays import bar_lines_beats
from reina.sessions.show_text import NO_TRACK_ETAG
from reina.show import Track
from reina.show.track_plan import TrackPlan
from reina.show.track_samples import resting_plan, sample_track

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reina.curves.arrays import FloatArray
    from reina.sessions.production import Production
    from reina.sessions.show_revision import ShowRevision
    from reina.sessions.show_text import ShowText
    from reina.show.track_samples import Curve

DIGITS = 6
"""Decimals that are told: a curve on a screen needs no more."""


@dataclass(frozen=True)
class CurveSpan:
    """Where curves are sampled: `points` times from `start_s` to `end_s`, both counted in."""

    start_s: float
    end_s: float
    points: int

    def times_s(self) -> FloatArray:
        """(points,) seconds."""
        return np.linspace(self.start_s, self.end_s, self.points)


def curves_of_show(
    production: Production, kept: ShowRevision, parameters: Sequence[str], span: CurveSpan
) -> ShowCurves:
    """Curves of parameters as the show moves them.

    Args:
        production: What the session plays; nothing is planned anew but muted tracks.
        kept: The show that it plays.
        parameters: Paths that the registry knows.
        span: Where.
    """
    tracks = {track.parameter: track for track in kept.show.tracks}
    registry = production.registry
    curves: list[ShowCurve] = []
    for path in parameters:
        plan = production.show_plan.tracks.get(path)
        if plan is None:
            track, parameter = tracks.get(path), registry[path]
            plan = TrackPlan.make(track, parameter) if isinstance(track, Track) else resting_plan(parameter)
        curves.append(_curve(production, plan, span, kept.text.track_etag(path)))
    return ShowCurves(times_s=_rounded(span.times_s()), curves=curves)


def curves_of_track(production: Production, track: Track, span: CurveSpan) -> ShowCurves:
    """The curve of a track that the show need not hold."""
    plan = TrackPlan.make(track, production.registry[track.parameter])
    return ShowCurves(
        times_s=_rounded(span.times_s()), curves=[_curve(production, plan, span, NO_TRACK_ETAG)]
    )


def music_time(production: Production, duration_s: float) -> MusicTime:
    """The music's time, and what keys may snap to.

    Args:
        production: What the session plays.
        duration_s: How long the session is.
    """
    times, triggers = production.show_plan.time_map, production.show_plan.triggers
    lines = bar_lines_beats(production.score)
    changes = production.score.tempo_map.onset_beats
    # One knot beyond all of them and beyond the end; everything runs straight from there on.
    end = float(times.from_seconds(np.array([duration_s]), "beats")[0])
    beyond = max(float(times.bar_lines_beats[-1]), float(changes[-1]), end) + 1.0
    beats = np.unique(np.concatenate([changes, lines, times.bar_lines_beats, [beyond]]))
    seconds = times.to_seconds(beats, "beats")
    return MusicTime(
        duration_s=duration_s,
        knots=TimeKnots(
            seconds=seconds.tolist(), beats=beats.tolist(), bars=times.from_seconds(seconds, "bars").tolist()
        ),
        beats_s=triggers.beats_s(times).tolist(),
        bars_s=times.to_seconds(lines, "beats").tolist(),
        onsets_s=np.unique(production.played.line.onset_s).tolist(),
    )


def curves_identity(production: Production, text: ShowText, parameters: Sequence[str]) -> tuple[str, ...]:
    """What the curves of a show follow from, beside the span: as long as this is the same, so are they."""
    played = production.played
    piece = (production.score.sequence, played.parts, played.transposition)
    etags = (f"{path} {text.track_etag(path)}" for path in parameters)
    return (str(piece), text.show.time, *etags)


def _curve(production: Production, plan: TrackPlan, span: CurveSpan, etag: str) -> ShowCurve:
    show_plan = production.show_plan
    keys, answered = sample_track(plan, span.times_s(), show_plan.time_map, show_plan.triggers)
    times = np.array([keyframe.time for keyframe in plan.track.keyframes], dtype=np.float64)
    return ShowCurve(
        parameter=plan.parameter.path,
        etag=etag,
        keys_s=_rounded(show_plan.time_map.to_seconds(times, plan.track.time)),
        keys=_line(keys),
        with_events=None if answered is None else _line(answered),
    )


def _line(curve: Curve) -> CurveLine:
    return CurveLine(values=[_rounded(column) for column in curve.values.T], jumps=curve.jumps.tolist())


def _rounded(values: FloatArray) -> list[float]:
    return np.round(values, DIGITS).tolist()
