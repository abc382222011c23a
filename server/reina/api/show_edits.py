"""Several edits of a show at once, and the way back."""

import json
from typing import Any

from fastapi import APIRouter, Request, Response

from reina.api.access import Controlled, Store
from reina.api.body import read_show_body
from reina.api.conditions import IfMatch
from reina.api.problems import ProblemError
from reina.api.show_change import ShowChange
from reina.keyframes import KeyNotFoundError, Show, ShowError, ShowHistory, with_edits
from reina.protocol.resources import ShowEdited

router = APIRouter(tags=["show"])

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
]


@router.post(
    "/sessions/{session_id}/show/edits",
    openapi_extra={
        "requestBody": {
            "required": True,
            "content": {
                "application/json": {
                    "schema": {
                        "type": "array",
                        "items": {
                            "type": "object",
                            "required": ["edit"],
                            "properties": {
                                "edit": {
                                    "enum": [
                                        "add_keyframe",
                                        "change_keyframe",
                                        "remove_keyframe",
                                        "put_track",
                                        "remove_track",
                                    ]
                                },
                                "parameter": {"type": "string"},
                                "key": {"type": "string"},
                                "keyframe": {"type": "object"},
                                "changes": {"type": "object"},
                                "track": {"type": "object"},
                            },
                        },
                    },
                    "example": EXAMPLE,
                }
            },
        }
    },
)
async def edit_show(
    session: Controlled, store: Store, request: Request, response: Response, if_match: IfMatch = None
) -> ShowEdited:
    """Several edits in their order as one step: all of them are made, or none.

    Only their outcome has to be a show, so that keyframes may change places.
    """
    try:
        edits: object = json.loads(await read_show_body(request))
    except (ValueError, RecursionError) as error:
        raise ShowError(f"the edits are no JSON: {error}") from error

    def edit(show: Show) -> Show:
        try:
            return with_edits(show, edits, store.stage.registry)
        except KeyNotFoundError as error:
            raise ProblemError(
                409, "unknown-keyframe", "There is no such track or keyframe", str(error)
            ) from error

    change = ShowChange(session, store, if_match)
    return _told(response, change.outcome(await change.edit(edit)))


@router.post("/sessions/{session_id}/show/undo")
async def undo(session: Controlled, store: Store, response: Response, if_match: IfMatch = None) -> ShowEdited:
    """Take the last edit back, whoever made it."""

    def step(history: ShowHistory) -> ShowHistory:
        if not history.past:
            raise ProblemError(
                409,
                "nothing-to-undo",
                "There is nothing to take back",
                "the show is as it was when the server loaded the session, or the history goes no further",
            )
        return history.undone()

    change = ShowChange(session, store, if_match)
    return _told(response, change.outcome(await change.step(step)))


@router.post("/sessions/{session_id}/show/redo")
async def redo(session: Controlled, store: Store, response: Response, if_match: IfMatch = None) -> ShowEdited:
    """Do again what was taken back last; an edit in between has ended that."""

    def step(history: ShowHistory) -> ShowHistory:
        if not history.future:
            raise ProblemError(
                409,
                "nothing-to-redo",
                "There is nothing to do again",
                "nothing was taken back since the last edit",
            )
        return history.redone()

    change = ShowChange(session, store, if_match)
    return _told(response, change.outcome(await change.step(step)))


def _told(response: Response, edited: ShowEdited) -> ShowEdited:
    response.headers["ETag"] = edited.etag
    return edited
