"""Several edits of a show at once, and the way back."""

import asyncio
from typing import Any, Literal

from fastapi import APIRouter, Request, Response

from reina.api.http.access import Controlled, Store
from reina.api.http.body import BoundedRoute
from reina.api.http.conditions import IfMatch, Prefer, wants_minimal
from reina.api.http.problems import ProblemError
from reina.api.show_change import ShowChange
from reina.protocol.resources import ShowEdited
from reina.sessions.show_revision import ShowRevision
from reina.show import KeyNotFoundError, Show, ShowHistory
from reina.show.edits import with_read_edits

router = APIRouter(tags=["show"], route_class=BoundedRoute)

EXAMPLE: list[dict[str, Any]] = [
    {
        "edit": "put_track",
        "track": {
            "parameter": "camera/fov",
            "time": "bars",
            "keyframes": [{"key": "k1", "time": 0, "value": 0.5}, {"key": "k2", "time": 2, "value": 0.4}],
        },
    },
    {
        "edit": "add_keyframe",
        "parameter": "camera/fov",
        "keyframe": {"key": "k3", "time": 3, "value": 0.6, "interpolation": "quad_in_out"},
    },
    {"edit": "change_keyframe", "parameter": "camera/fov", "key": "k2", "changes": {"time": 2.5}},
    {"edit": "remove_keyframe", "parameter": "camera/fov", "key": "k1"},
    {
        "edit": "move_keyframes",
        "keyframes": {"camera/fov": ["k2", "k3"]},
        "time": "bars",
        "by": 1,
        "stretch": {"about": 0, "factor": 2},
        "value_by": -0.05,
    },
    {"edit": "change_track", "parameter": "camera/fov", "changes": {"after": "loop", "muted": True}},
    {"edit": "copy_track", "parameter": "camera/fov", "to": "camera/roll"},
    {"edit": "remove_track", "parameter": "camera/roll"},
    {
        "edit": "apply_look",
        "look": {"values": {"lights/key/intensity": 0.4, "lights/haze": 1}, "rest": ["lights"]},
        "at": 8,
        "time": "bars",
    },
    {"edit": "change_show", "changes": {"markers": [{"time": 8, "name": "Refrain"}]}},
]


@router.post(
    "/sessions/{session_id}/show/edits",
    response_model=ShowEdited,
    openapi_extra={
        "requestBody": {
            "required": True,
            "content": {
                "application/json": {
                    "schema": {"type": "array", "items": {"$ref": "#/components/schemas/Edit"}},
                    "example": EXAMPLE,
                }
            },
        }
    },
)
async def edit_show(
    session: Controlled, store: Store, request: Request, if_match: IfMatch = None, prefer: Prefer = None
) -> Response:
    """Several edits in their order as one step: all of them are made, or none.

    Only their outcome has to be a show, so that keyframes may change places.
    """
    edits = await store.reader.edits(await request.body(), owner=session.id)

    def edit(show: Show) -> Show:
        try:
            production = session.production
            return with_read_edits(show, edits, production.registry, production.show_plan.time_map)
        except KeyNotFoundError as error:
            raise ProblemError(
                409, "unknown-keyframe", "There is no such track or keyframe", str(error)
            ) from error

    change = ShowChange(session, store, if_match)
    return await _told(change, await change.edit(edit), prefer)


@router.post("/sessions/{session_id}/show/undo", response_model=ShowEdited)
async def undo(
    session: Controlled, store: Store, if_match: IfMatch = None, prefer: Prefer = None
) -> Response:
    """Take the last edit back, whoever made it."""
    return await _step(ShowChange(session, store, if_match), "undone", prefer)


@router.post("/sessions/{session_id}/show/redo", response_model=ShowEdited)
async def redo(
    session: Controlled, store: Store, if_match: IfMatch = None, prefer: Prefer = None
) -> Response:
    """Do again what was taken back last; an edit in between has ended that."""
    return await _step(ShowChange(session, store, if_match), "redone", prefer)


_NO_STEP = {
    "undone": ProblemError(
        409,
        "nothing-to-undo",
        "There is nothing to take back",
        "the show is as it was when the server loaded the session, or the history goes no further",
    ),
    "redone": ProblemError(
        409,
        "nothing-to-redo",
        "There is nothing to do again",
        "nothing was taken back since the last edit",
    ),
}


async def _step(change: ShowChange, way: Literal["undone", "redone"], prefer: str | None) -> Response:
    def step(history: ShowHistory) -> ShowHistory:
        if not (history.past if way == "undone" else history.future):
            raise _NO_STEP[way]
        return history.undone() if way == "undone" else history.redone()

    return await _told(change, await change.step(step), prefer)


async def _told(change: ShowChange, after: ShowRevision, prefer: str | None) -> Response:
    briefly = wants_minimal(prefer)
    text = await asyncio.to_thread(change.outcome, after, briefly=briefly)
    headers = {"ETag": after.text.etag, "Vary": "Prefer"}
    if briefly:
        headers["Preference-Applied"] = "return=minimal"
    return Response(text, media_type="application/json", headers=headers)
