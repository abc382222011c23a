"""The show: as a whole, and keyframe by keyframe."""

from typing import Annotated, Any

from fastapi import APIRouter, Body, Path, Request

from reina.api.access import Controlled, Store, Watched
from reina.api.problems import ProblemError
from reina.api.upload import FILE_LIMITS, MEGABYTE
from reina.keyframes import Keyframe, Parameter, ParameterRegistry, Show, Track, keyframe_document
from reina.sessions.production import read_show

router = APIRouter(tags=["show"])

_KEYFRAME = {"time": 1.5, "value": 0.8, "interpolation": "quad_in"}
Document = dict[str, Any]
TrackPath = Annotated[
    str, Path(description="The parameter's path, slashes and all.", examples=["lights/key/intensity"])
]
Key = Annotated[str, Path(description="The keyframe's key in its track.", examples=["k3"])]
Fields = Annotated[Document, Body(examples=[_KEYFRAME])]


@router.get("/sessions/{session_id}/show")
async def get_show(session: Watched) -> Document:
    """The whole show."""
    return session.production.show.to_document()


@router.put("/sessions/{session_id}/show")
async def put_show(
    session: Controlled,
    store: Store,
    request: Request,
) -> Document:
    """Another show in its place."""
    body = bytearray()
    async for chunk in request.stream():
        body += chunk
        if len(body) > FILE_LIMITS["show"]:
            limit = FILE_LIMITS["show"] // MEGABYTE
            raise ProblemError(413, "show-too-large", "Content Too Large", f"show is larger than {limit} MB")
    show = read_show(bytes(body), store.stage.registry)
    await store.set_show(session, lambda _: show, path=None)
    return show.to_document()


@router.get("/sessions/{session_id}/show/tracks/{path:path}/keyframes")
async def list_keyframes(session: Watched, path: TrackPath, store: Store) -> Document:
    """A parameter's keyframes; none where the show does not move it."""
    _parameter(store.stage.registry, path)
    keyframes = _keyframes(session.production.show, path)
    return {"keyframes": [keyframe_document(keyframe) for keyframe in keyframes]}


@router.post("/sessions/{session_id}/show/tracks/{path:path}/keyframes", status_code=201)
async def add_keyframe(session: Controlled, path: TrackPath, fields: Fields, store: Store) -> Document:
    """One keyframe more; it is given the next free key unless it names its own."""
    parameter = _parameter(store.stage.registry, path)
    before: set[str] = set()

    def edit(show: Show) -> Show:
        before.update(keyframe.key for keyframe in _keyframes(show, path))
        keyframe = show.new_keyframe(parameter, fields)
        if keyframe.key in before:
            raise ProblemError(
                409,
                "key-taken",
                "There is such a keyframe already",
                f"{path} has a keyframe {keyframe.key}; PATCH changes it",
            )
        return show.with_keyframe(path, keyframe)

    show = await store.set_show(session, edit, path=path)
    added = next(keyframe for keyframe in _keyframes(show, path) if keyframe.key not in before)
    return keyframe_document(added)


@router.get("/sessions/{session_id}/show/tracks/{path:path}/keyframes/{key}")
async def get_keyframe(session: Watched, path: TrackPath, key: Key, store: Store) -> Document:
    """One keyframe."""
    _parameter(store.stage.registry, path)
    return keyframe_document(session.production.show.track(path).keyframe(key))


@router.patch("/sessions/{session_id}/show/tracks/{path:path}/keyframes/{key}")
async def change_keyframe(
    session: Controlled, path: TrackPath, key: Key, fields: Fields, store: Store
) -> Document:
    """Change some fields of a keyframe; null takes one back to its default."""
    parameter = _parameter(store.stage.registry, path)
    if fields.get("key", key) != key:
        raise ProblemError(
            422, "key-fixed", "The show cannot be used", "a keyframe's key stays; add another and remove this"
        )
    show = await store.set_show(session, lambda show: show.with_changed(parameter, key, fields), path=path)
    return keyframe_document(show.track(path).keyframe(key))


@router.delete("/sessions/{session_id}/show/tracks/{path:path}/keyframes/{key}", status_code=204)
async def remove_keyframe(session: Controlled, path: TrackPath, key: Key, store: Store) -> None:
    """One keyframe less; a track that loses its last goes with it."""
    _parameter(store.stage.registry, path)
    await store.set_show(session, lambda show: show.without_keyframe(path, key), path=path)


def _parameter(registry: ParameterRegistry, path: str) -> Parameter:
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
