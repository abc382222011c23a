"""Files: what one is, and the one that a session was made of."""

import asyncio
from typing import Annotated

from fastapi import APIRouter, Query, Request
from fastapi.responses import FileResponse

from reina.api.http.access import Store, Watched
from reina.api.http.body import BoundedRoute
from reina.api.http.files import ServedFile
from reina.protocol import resources
from reina.sessions.file_role import role_of

router = APIRouter(tags=["files"], route_class=BoundedRoute)


@router.post(
    "/files/role",
    openapi_extra={
        "requestBody": {
            "required": True,
            "description": "The file, or its first 64 kB; at most 1 MB.",
            "content": {"application/octet-stream": {"schema": {"type": "string", "format": "binary"}}},
        }
    },
)
async def tell_role(
    request: Request,
    filename: Annotated[
        str | None, Query(max_length=1000, description="Its name, for where its content says nothing.")
    ] = None,
) -> resources.FileRole:
    """Whether a file is a score, a song or a show, by its content; nothing of it is kept."""
    body = await request.body()
    role = await asyncio.to_thread(role_of, body, filename)
    return resources.FileRole(role=role.role, name=role.name, advice=role.advice)


@router.get(
    "/sessions/{session_id}/score/file",
    response_class=FileResponse,
    responses={200: {"content": {"application/octet-stream": {}}, "description": "The file as it was sent."}},
)
async def get_score_file(session: Watched, store: Store) -> ServedFile:
    """The file that the session was made of, as it was sent."""
    # What somebody sent is never to be taken for a page.
    return ServedFile(
        await store.reading.score_file(session.record),
        media_type="application/octet-stream",
        headers={"Content-Disposition": "attachment"},
    )
