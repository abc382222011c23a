"""The show as a whole."""

import asyncio
from typing import Annotated, Any

from fastapi import APIRouter, Query, Request, Response

from reina.api.http.access import Controlled, Store, Watched
from reina.api.http.answers import LARGE_ANSWER
from reina.api.http.body import BoundedRoute
from reina.api.http.conditions import IfMatch, IfNoneMatch, named, not_modified, validated
from reina.api.show_change import ShowChange
from reina.protocol.messages import ShowState
from reina.protocol.resources import ShowWarnings
from reina.show.document import ShowDocument

router = APIRouter(tags=["show"], route_class=BoundedRoute)

Document = dict[str, Any]

EXAMPLE: Document = {
    "version": 1,
    "title": "Sunrise",
    "time": "bars",
    "tracks": [
        {
            "parameter": "lights/key/intensity",
            "keyframes": [
                {"key": "k1", "time": 0, "value": 1.2},
                {"key": "k2", "time": 4, "value": 3.5, "interpolation": "sine_in_out"},
            ],
        },
        {
            "parameter": "blocks/glow",
            "events": {"on": "notes", "decay": 0.5, "amount": 1.5, "blend": "add"},
            "keyframes": [],
        },
    ],
}


@router.get("/sessions/{session_id}/show", response_model=ShowDocument, dependencies=[LARGE_ANSWER])
async def get_show(
    session: Watched,
    if_none_match: IfNoneMatch = None,
    parameter: Annotated[
        list[str] | None, Query(description="Only the tracks of these parameters, as far as there are any.")
    ] = None,
) -> Response:
    """The whole show, as docs/show.schema.json describes it, or its own fields and some of its tracks."""
    text = session.show_revision.text
    if if_none_match is not None and named(if_none_match, text.etag, strongly=False):
        return not_modified(text.etag)
    return validated(await asyncio.to_thread(text.text, parameter), text.etag)


@router.put(
    "/sessions/{session_id}/show",
    response_model=ShowDocument,
    openapi_extra={
        "requestBody": {
            "required": True,
            "content": {
                "application/json": {
                    "schema": {"$ref": "#/components/schemas/ShowDocument"},
                    "example": EXAMPLE,
                }
            },
        }
    },
)
async def put_show(session: Controlled, store: Store, request: Request, if_match: IfMatch = None) -> Response:
    """Another show in its place. Tracks of parameters that nobody knows are kept, without effect."""
    show = await store.reader.show(await request.body(), session.production.registry, owner=session.id)
    kept = await ShowChange(session, store, if_match).edit(lambda _: show)
    return validated(await asyncio.to_thread(kept.text.text), kept.text.etag)


@router.get("/sessions/{session_id}/show/history")
async def get_history(session: Watched) -> ShowState:
    """Which state the show is in, and how many steps it can be walked back and forth."""
    return session.show_revision.state


@router.get("/sessions/{session_id}/show/warnings")
async def get_warnings(session: Watched) -> ShowWarnings:
    """What of the show has no effect in this piece: unknown parameters, keyframes after its end.

    A show from another piece is kept as it came; its times in bars follow this one.
    """
    return ShowWarnings(warnings=await asyncio.to_thread(session.show_warnings))
