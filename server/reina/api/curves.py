"""What a timeline editor draws, so that it has no value to work out: curves, and the music's time."""

import hashlib
from typing import Annotated, Any

from fastapi import APIRouter, Body, Depends, Query, Request, Response

from reina.api.frames import LATEST_S
from reina.api.http.access import Controlled, Store, Watched
from reina.api.http.answers import LARGE_ANSWER
from reina.api.http.body import BoundedRoute
from reina.api.http.conditions import IfNoneMatch, named, not_modified, validated
from reina.api.http.problems import ProblemError
from reina.api.http.work import in_turn
from reina.api.tracks import known_parameter
from reina.protocol.timeline import CurvePreview, MusicTime, ShowCurves
from reina.sessions.show_curves import (
    CurveSpan,
    curves_identity,
    curves_of_show,
    curves_of_track,
    music_time,
)
from reina.show import ShowError

router = APIRouter(tags=["show"], route_class=BoundedRoute)

MAX_PARAMETERS = 64
MAX_POINTS = 2000
MAX_SAMPLES = 40_000

EXAMPLE: dict[str, Any] = {
    "parameter": "lights/key/intensity",
    "time": "bars",
    "keyframes": [
        {"key": "k1", "time": 0, "value": 1},
        {"key": "k2", "time": 2, "value": 3, "interpolation": "cubic_bezier", "handles": [0.3, 0, 0.1, 1]},
    ],
}


def _span(
    start_s: Annotated[float, Query(ge=0, le=LATEST_S, description="Song time of the first point.")],
    end_s: Annotated[float, Query(ge=0, le=LATEST_S, description="Song time of the last.")],
    points: Annotated[int, Query(ge=1, le=MAX_POINTS, description="How many, evenly spaced.")] = 500,
) -> CurveSpan:
    if end_s < start_s:
        raise ProblemError(
            422,
            "span-invalid",
            "These curves cannot be sampled",
            f"end_s lies at or after start_s, {start_s:g}, not at {end_s:g}",
        )
    return CurveSpan(start_s, end_s, points)


Span = Annotated[CurveSpan, Depends(_span)]


@router.get("/sessions/{session_id}/show/curves", response_model=ShowCurves, dependencies=[LARGE_ANSWER])
async def get_curves(
    request: Request,
    session: Watched,
    span: Span,
    parameter: Annotated[
        list[str],
        Query(min_length=1, max_length=MAX_PARAMETERS, description="A parameter's path; may be repeated."),
    ],
    if_none_match: IfNoneMatch = None,
) -> Response:
    """Curves of parameters over a span of song time, as the show moves them.

    The validator follows from the tracks that are asked for alone: an edit of another track leaves it.
    """
    if len(parameter) * span.points > MAX_SAMPLES:
        raise ProblemError(
            422,
            "too-many-samples",
            "These curves cannot be sampled",
            f"{len(parameter)} parameters of {span.points} points are more than {MAX_SAMPLES} samples; "
            "ask for fewer points or parameters",
        )
    for path in parameter:
        known_parameter(session.production.registry, path)
    production, kept = session.production, session.show_revision
    identity = "\n".join([str(span), *curves_identity(production, kept.text, parameter)])
    etag = f'"{hashlib.sha256(identity.encode()).hexdigest()[:24]}"'
    if if_none_match is not None and named(if_none_match, etag, strongly=False):
        return not_modified(etag)
    text = await in_turn(
        request, session, lambda: curves_of_show(production, kept, parameter, span).model_dump_json()
    )
    return validated(text, etag)


@router.post("/sessions/{session_id}/show/curves", response_model=ShowCurves)
async def preview_curve(
    request: Request,
    session: Controlled,
    store: Store,
    span: Span,
    asked: Annotated[CurvePreview, Body(examples=[{"track": EXAMPLE}])],
) -> Response:
    """The curve of a track as it would be: nothing is kept. For a key or a handle that is being dragged."""
    track = asked.track
    path = track.get("parameter")
    if not isinstance(path, str):
        raise ShowError("a parameter's path is needed here", field="track/parameter")
    parameter = known_parameter(session.production.registry, path)
    size, unit = len(await request.body()), session.show_revision.show.time
    read = await store.reader.preview(track, size, parameter, unit, owner=session.id)
    text = await in_turn(
        request, session, lambda: curves_of_track(session.production, read, span).model_dump_json()
    )
    return Response(text, media_type="application/json")


@router.get("/sessions/{session_id}/time", response_model=MusicTime, dependencies=[LARGE_ANSWER])
async def get_music_time(request: Request, session: Watched) -> Response:
    """How seconds, beats and bars run in this piece, and what keys may snap to."""
    production, duration_s = session.production, session.clock.duration_s
    text = await in_turn(request, session, lambda: music_time(production, duration_s).model_dump_json())
    return Response(text, media_type="application/json")
