"""One track of a show, and its keyframes."""

import json
from typing import Annotated, Any
from urllib.parse import quote

from fastapi import APIRouter, Body, Path, Request, Response

from reina.api.http.access import Controlled, Store, Watched
from reina.api.http.body import BoundedRoute
from reina.api.http.conditions import IfMatch, validated
from reina.api.http.problems import ProblemError
from reina.api.show_change import ShowChange
from reina.curves import Keyframe, Parameter, ParameterRegistry
from reina.protocol.links import session_links
from reina.show import KeyNotFoundError, Show, Track, keyframe_document
from reina.show.show_writer import keyframe_text

router = APIRouter(tags=["show"], route_class=BoundedRoute)

Document = dict[str, Any]
TrackPath = Annotated[
    str, Path(description="The parameter's path, slashes and all.", examples=["lights/key/intensity"])
]
Key = Annotated[str, Path(description="The keyframe's key in its track.", examples=["k3"])]
NewKeyframe = Annotated[
    Document, Body(examples=[{"key": "k3", "time": 1.5, "value": 0.8, "interpolation": "quad_in"}])
]
Changes = Annotated[Document, Body(examples=[{"time": 2.25, "value": 1.1}])]
TRACK_EXAMPLE: Document = {
    "time": "beats",
    "after": "loop",
    "keyframes": [
        {"key": "k1", "time": 0, "value": 1.0},
        {"key": "k2", "time": 4, "value": 2.0, "interpolation": "linear"},
    ],
}

KEYFRAMES = "/sessions/{session_id}/show/tracks/{path:path}/keyframes"
TRACK = "/sessions/{session_id}/show/tracks/{path:path}"


@router.get(KEYFRAMES, response_model=Document)
def list_keyframes(session: Watched, path: TrackPath) -> Response:
    """A parameter's keyframes; none where the show does not move it."""
    known_parameter(session.production.registry, path)
    kept = session.show_revision
    keyframes = ", ".join([keyframe_text(keyframe) for keyframe in _keyframes(kept.show, path)])
    return validated(f'{{"keyframes": [{keyframes}]}}', kept.text.track_etag(path))


@router.post(KEYFRAMES, status_code=201)
async def add_keyframe(
    session: Controlled,
    path: TrackPath,
    fields: NewKeyframe,
    store: Store,
    response: Response,
    if_match: IfMatch = None,
) -> Document:
    """One keyframe more; it is given the next free key unless it names its own."""
    parameter = known_parameter(session.production.registry, path)
    added: list[Keyframe[Any]] = []

    def edit(show: Show) -> Show:
        keyframe = show.new_keyframe(parameter, fields)
        if any(other.key == keyframe.key for other in _keyframes(show, path)):
            raise ProblemError(
                409,
                "key-taken",
                "There is such a keyframe already",
                f"{path} has a keyframe {keyframe.key}; PATCH changes it",
            )
        added.append(keyframe)
        return show.with_keyframe(path, keyframe)

    kept = await ShowChange(session, store, if_match, path).edit(edit)
    key = quote(added[0].key)
    response.headers["ETag"] = kept.text.track_etag(path)
    response.headers["Location"] = f"{session_links(session.id).show}/tracks/{quote(path)}/keyframes/{key}"
    return keyframe_document(added[0])


@router.get(f"{KEYFRAMES}/{{key}}", response_model=Document)
async def get_keyframe(session: Watched, path: TrackPath, key: Key) -> Response:
    """One keyframe, under its track's validator."""
    known_parameter(session.production.registry, path)
    kept = session.show_revision
    document = keyframe_document(kept.show.track(path).keyframe(key))
    return validated(json.dumps(document), kept.text.track_etag(path))


@router.patch(f"{KEYFRAMES}/{{key}}")
async def change_keyframe(
    session: Controlled,
    path: TrackPath,
    key: Key,
    fields: Changes,
    store: Store,
    response: Response,
    if_match: IfMatch = None,
) -> Document:
    """Change some fields of a keyframe; null takes one back to its default."""
    parameter = known_parameter(session.production.registry, path)
    if fields.get("key", key) != key:
        raise ProblemError(
            422, "key-fixed", "The show cannot be used", "a keyframe's key stays; add another and remove this"
        )
    kept = await ShowChange(session, store, if_match, path).edit(
        lambda show: show.with_changed(parameter, key, fields)
    )
    response.headers["ETag"] = kept.text.track_etag(path)
    return keyframe_document(kept.show.track(path).keyframe(key))


@router.delete(f"{KEYFRAMES}/{{key}}", status_code=204)
async def remove_keyframe(
    session: Controlled, path: TrackPath, key: Key, store: Store, response: Response, if_match: IfMatch = None
) -> None:
    """One keyframe less; a track that loses its last and answers no events goes with it."""
    known_parameter(session.production.registry, path)
    kept = await ShowChange(session, store, if_match, path).edit(
        lambda show: show.without_keyframe(path, key)
    )
    response.headers["ETag"] = kept.text.track_etag(path)


@router.get(TRACK, response_model=Document)
async def get_track(session: Watched, path: TrackPath) -> Response:
    """A whole track: its keyframes, their unit, what comes before and after them, what it answers."""
    known_parameter(session.production.registry, path)
    written = session.show_revision.text.tracks.get(path)
    if written is None:
        raise KeyNotFoundError("the show has no such track", track=path)
    return validated(written.text, written.etag)


@router.put(
    TRACK,
    response_model=Document,
    openapi_extra={
        "requestBody": {
            "required": True,
            "content": {"application/json": {"schema": {"type": "object"}, "example": TRACK_EXAMPLE}},
        }
    },
)
async def put_track(
    session: Controlled, path: TrackPath, store: Store, request: Request, if_match: IfMatch = None
) -> Response:
    """Another track of the parameter in the place of its present one, if there is any."""
    parameter = known_parameter(session.production.registry, path)
    track = await store.reader.track(await request.body(), parameter, session.show_revision.show.time)
    kept = await ShowChange(session, store, if_match, path).edit(lambda show: show.with_new_track(track))
    written = kept.text.tracks[path]
    return validated(written.text, written.etag)


@router.delete(TRACK, status_code=204)
async def remove_track(
    session: Controlled, path: TrackPath, store: Store, response: Response, if_match: IfMatch = None
) -> None:
    """The show no longer moves the parameter, which goes back to its default. Unknown tracks go too."""
    kept = await ShowChange(session, store, if_match, path).edit(lambda show: show.without_track(path))
    response.headers["ETag"] = kept.text.track_etag(path)


def known_parameter(registry: ParameterRegistry, path: str) -> Parameter:
    """The parameter of a path.

    Raises:
        ProblemError: 404 when there is none.
    """
    parameter = registry.get(path)
    if parameter is None:
        raise ProblemError(
            404,
            "unknown-parameter",
            "There is no such parameter",
            f"no parameter has the path {path!r}; GET /api/v1/parameters lists all",
        )
    return parameter


def _keyframes(show: Show, path: str) -> tuple[Keyframe[Any], ...]:
    return next(
        (track.keyframes for track in show.tracks if track.parameter == path and isinstance(track, Track)), ()
    )
