"""How a show fits the piece that it is put on: what of it has no effect there, and why."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from reina.curves.shown import shortened
from reina.music import ScoreWarning
from reina.show import Track, UnknownTrack, unknown_choices
from reina.show.errors import MAX_FAULTS

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from reina.sessions.production import Production
    from reina.show import Show, TimeMap, TimeUnit

MOST_NAMES = 8
"""So many are told in one warning."""
LATE = 1e-6
"""Seconds after the end that are a rounding and no keyframe too late."""


def show_warnings(production: Production, duration_s: float) -> list[ScoreWarning]:
    """What of the show has no effect in this piece.

    Args:
        production: The piece and its show.
        duration_s: How long it can be played.
    """
    show, times = production.show, production.show_plan.time_map
    return [
        *_unknown(production),
        *_late_keyframes(show, times, duration_s),
        *_late_markers(show, times, duration_s),
        *_never_answers(production),
    ]


def _unknown(production: Production) -> Iterator[ScoreWarning]:
    unknown = [track for track in production.show.tracks if isinstance(track, UnknownTrack)]
    for track in unknown[:MAX_FAULTS]:
        parameter, kept = (
            production.registry.get(track.parameter),
            "its track is kept as it came and has no effect",
        )
        if parameter is None:
            message = f"no parameter of this name is known here; {kept}"
            yield ScoreWarning("show-unknown-parameter", shortened(track.parameter), message)
        else:
            names = _some(unknown_choices(track, parameter))
            message = f"it names {names}, which is not here; there are {', '.join(parameter.choices)}; {kept}"
            yield ScoreWarning("show-unknown-choice", track.parameter, message)
    others = len(unknown) - MAX_FAULTS
    if others > 0:
        message = f"{others} more tracks are kept as they came and have no effect"
        yield ScoreWarning("show-unknown-parameter", "tracks", message, others)


def _some(names: Sequence[str]) -> str:
    """Names in a row: the first few, and how many more there are."""
    told = ", ".join(map(shortened, names[:MOST_NAMES]))
    return told if len(names) <= MOST_NAMES else f"{told} and {len(names) - MOST_NAMES} more"


def _late_keyframes(show: Show, time_map: TimeMap, duration_s: float) -> Iterator[ScoreWarning]:
    for track in show.tracks:
        if not isinstance(track, Track):
            continue
        late = _late([keyframe.time for keyframe in track.keyframes], track.time, time_map, duration_s)
        if late:
            count = f"{late} of its {len(track.keyframes)} keyframes"
            verb = "stands" if late == 1 else "stand"
            message = f"{count} {verb} {_beyond(track.time, time_map, duration_s)} and will not be reached"
            yield ScoreWarning("show-keyframes-after-the-end", track.parameter, message, late)


def _late_markers(show: Show, time_map: TimeMap, duration_s: float) -> Iterator[ScoreWarning]:
    late = _late([marker.time for marker in show.markers], show.time, time_map, duration_s)
    if late:
        names = _some([marker.name for marker in show.markers[len(show.markers) - late :]])
        message = f"these stand {_beyond(show.time, time_map, duration_s)}: {names}"
        yield ScoreWarning("show-markers-after-the-end", "markers", message, late)


def _late(times: list[float], unit: TimeUnit, time_map: TimeMap, duration_s: float) -> int:
    times_s = time_map.to_seconds(np.array(times, dtype=np.float64), unit)
    return int((times_s > duration_s + LATE).sum())


def _beyond(unit: TimeUnit, time_map: TimeMap, duration_s: float) -> str:
    end = float(time_map.from_seconds(np.array([duration_s]), unit)[0])
    return f"after the end, which is at {end:.4g} {unit}"


def _never_answers(production: Production) -> Iterator[ScoreWarning]:
    plan = production.show_plan
    kit = tuple(
        dict.fromkeys(piece for performer in production.performers for piece in performer.instrument.pieces)
    )
    for track in production.show.tracks:
        if not isinstance(track, Track) or track.events is None:
            continue
        pieces = track.events.where.pieces or ()
        unknown = [piece for piece in pieces if piece not in kit]
        if kit and unknown:
            message = f"it answers strokes on {_some(unknown)}; the kit has {', '.join(kit)}"
            yield ScoreWarning("show-unknown-piece", track.parameter, message)
            if len(unknown) == len(pieces):
                continue
        times, _ = track.events.events(plan.triggers, plan.time_map, track.time)
        if times.size:
            continue
        message = f"of the {track.events.on} that it answers there are none in this piece"
        part, parts = track.events.where.part, len(production.score.parts)
        if part is not None and part >= parts:
            message += f": it names part {part}, and the parts are 0 to {parts - 1}"
        yield ScoreWarning("show-never-answers", track.parameter, message)
