"""One track of a show, and its keyframes."""

from collections.abc import Callable
from typing import Annotated, Any
from urllib.parse import quote

from fastapi import APIRouter, Body, Path, Request, Response

from reina.api.http.access import Controlled, Store, Watched
from reina.api.http.body import BoundedRoute
from reina.api.http.conditions import IfMatch, validated
from reina.api.http.paths import TRACK
from reina.api.http.problems import ProblemError
from reina.api.show_change import ShowChange
from reina.curves import Keyframe, Parameter, ParameterRegistry
from reina.protocol.links import session_links
from reina.protocol.resources import KeyframeList
from reina.sessions.session import Session
from reina.show import KeyNotFoundError, Show, Track, keyframe_document
from reina.show.document import ShowKeyframe, ShowTrack
from reina.show.edits import (
    AddKeyframe,
    ChangeKeyframe,
    Edit,
    NewKeyframe,
    RemoveKeyframe,
    RemoveTrack,
    with_edit,
    with_track,
)
from reina.show.model import read_later
from reina.system.json_text import Written, json_text

router = APIRouter(tags=["show"], route_class=BoundedRoute)

Document = dict[str, Any]
TrackPath = Annotated[
    str, Path(description="The parameter's path, slashes and all.", examples=["lights/key/intensity"])
]
Key = Annotated[str, Path(description="The keyframe's key in its track.", examples=["k3"])]
KeyframeFields = Annotated[
    Document,
    read_later(NewKeyframe),
    Body(examples=[{"key": "k3", "time": 1.5, "value": 0.8, "interpolation": "quad_in"}]),
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

TRACK_SCHEMA: Document = {
    "allOf": [{"$ref": "#/components/schemas/ShowTrack"}],
    "description": "It may leave out its parameter.",
}

KEYFRAMES = f"{TRACK}/keyframes"


@router.get(KEYFRAMES, response_model=KeyframeList)
def list_keyframes(session: Watched, path: TrackPath) -> Response:
    """A parameter's keyframes; none where the show does not move it."""
    known_parameter(session.production.registry, path)
    text = session.show_revision.text
    written = text.tracks.get(path)
    keyframes = [] if written is None else [Written(keyframe) for keyframe in written.keyframes]
    return validated(json_text({"keyframes": keyframes}), text.track_etag(path))


@router.post(KEYFRAMES, status_code=201, response_model=ShowKeyframe, response_model_exclude_unset=True)
async def add_keyframe(
    session: Controlled,
    path: TrackPath,
    fields: KeyframeFields,
    store: Store,
    response: Response,
    if_match: IfMatch = None,
) -> Document:
    """One keyframe more; it is given the next free key unless it names its own."""
    known_parameter(session.production.registry, path)
    added: list[Keyframe[Any]] = []
    make = _edit(session, AddKeyframe(edit="add_keyframe", parameter=path, keyframe=fields))

    def edit(show: Show) -> Show:
        there = {keyframe.key for keyframe in _keyframes(show, path)}
        key = fields.get("key")
        if isinstance(key, str) and key in there:
            raise ProblemError(
                409,
                "key-taken",
                "There is such a keyframe already",
                f"{path} has a keyframe {key}; PATCH changes it",
            )
        edited = make(show)
        # Where another server was first, the edit is made once more.
        added[:] = [keyframe for keyframe in _keyframes(edited, path) if keyframe.key not in there]
        return edited

    kept = await ShowChange(session, store, if_match, path).edit(edit)
    key = quote(added[0].key)
    response.headers["ETag"] = kept.text.track_etag(path)
    response.headers["Location"] = f"{session_links(session.id).show}/tracks/{quote(path)}/keyframes/{key}"
    return keyframe_document(added[0])


@router.get(f"{KEYFRAMES}/{{key}}", response_model=ShowKeyframe)
async def get_keyframe(session: Watched, path: TrackPath, key: Key) -> Response:
    """One keyframe, under its track's validator."""
    known_parameter(session.production.registry, path)
    kept = session.show_revision
    document = keyframe_document(kept.show.track(path).keyframe(key))
    return validated(json_text(document), kept.text.track_etag(path))


@router.patch(f"{KEYFRAMES}/{{key}}", response_model=ShowKeyframe, response_model_exclude_unset=True)
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
    known_parameter(session.production.registry, path)
    if fields.get("key", key) != key:
        raise ProblemError(
            422, "key-fixed", "The show cannot be used", "a keyframe's key stays; add another and remove this"
        )
    edit = ChangeKeyframe(edit="change_keyframe", parameter=path, key=key, changes=fields)
    kept = await ShowChange(session, store, if_match, path).edit(_edit(session, edit))
    response.headers["ETag"] = kept.text.track_etag(path)
    return keyframe_document(kept.show.track(path).keyframe(key))


@router.delete(f"{KEYFRAMES}/{{key}}", status_code=204)
async def remove_keyframe(
    session: Controlled, path: TrackPath, key: Key, store: Store, response: Response, if_match: IfMatch = None
) -> None:
    """One keyframe less; a track that loses its last and answers no events goes with it."""
    known_parameter(session.production.registry, path)
    edit = RemoveKeyframe(edit="remove_keyframe", parameter=path, key=key)
    kept = await ShowChange(session, store, if_match, path).edit(_edit(session, edit))
    response.headers["ETag"] = kept.text.track_etag(path)


@router.get(TRACK, response_model=ShowTrack)
async def get_track(session: Watched, path: TrackPath) -> Response:
    """A whole track: its keyframes, their unit, what comes before and after them, what it answers."""
    known_parameter(session.production.registry, path)
    written = session.show_revision.text.tracks.get(path)
    if written is None:
        raise KeyNotFoundError("the show has no such track", track=path)
    return validated(written.text, written.etag)


@router.put(
    TRACK,
    response_model=ShowTrack,
    openapi_extra={
        "requestBody": {
            "required": True,
            "content": {"application/json": {"schema": TRACK_SCHEMA, "example": TRACK_EXAMPLE}},
        }
    },
)
async def put_track(
    session: Controlled, path: TrackPath, store: Store, request: Request, if_match: IfMatch = None
) -> Response:
    """Another track of the parameter in the place of its present one, if there is any."""
    parameter = known_parameter(session.production.registry, path)
    track = await store.reader.track(
        await request.body(), parameter, session.show_revision.show.time, owner=session.id
    )
    registry = session.production.registry
    kept = await ShowChange(session, store, if_match, path).edit(
        lambda show: with_track(show, track, registry)
    )
    written = kept.text.tracks[path]
    return validated(written.text, written.etag)


@router.delete(TRACK, status_code=204)
async def remove_track(
    session: Controlled, path: TrackPath, store: Store, response: Response, if_match: IfMatch = None
) -> None:
    """The show no longer moves the parameter, which goes back to its default. Unknown tracks go too."""
    edit = RemoveTrack(edit="remove_track", parameter=path)
    kept = await ShowChange(session, store, if_match, path).edit(_edit(session, edit))
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


def _edit(session: Session, edit: Edit) -> Callable[[Show], Show]:
    """One edit of a session's show."""
    production = session.production
    return lambda show: with_edit(show, edit, production.registry, production.show_plan.time_map)


def _keyframes(show: Show, path: str) -> tuple[Keyframe[Any], ...]:
    return next(
        (track.keyframes for track in show.tracks if track.parameter == path and isinstance(track, Track)), ()
    )
