"""Packed blocks over HTTP: what never changes, for any cache to keep."""

import asyncio
import math
from typing import Annotated

from fastapi import APIRouter, Path, Query, Request, Response

from reina.api.http.access import Watched
from reina.api.http.files import IMMUTABLE
from reina.api.http.problems import ProblemError
from reina.performance import BLOCK_FRAMES
from reina.sessions.packed_blocks import Form

router = APIRouter(tags=["frames"])

HEADERS = {
    "Cache-Control": IMMUTABLE,
    # Who has the address may watch: from a page or a cache of another origin, too.
    "Access-Control-Allow-Origin": "*",
    "Cross-Origin-Resource-Policy": "cross-origin",
}


@router.get(
    "/sessions/{session_id}/blocks/{revision}/{number}",
    response_class=Response,
    responses={
        200: {
            "content": {"application/octet-stream": {}},
            "description": "The block, as docs/protocol.md has it.",
        },
        410: {"description": "Score, cast or show are others by now; `detail` has the present revision."},
    },
)
async def get_block(
    request: Request,
    session: Watched,
    revision: Annotated[str, Path(description="That of `hello.blocks`: a state of score, cast and show.")],
    number: Annotated[int, Path(ge=0, description="Frames 60·number to 60·number + 59.")],
    form: Annotated[Form, Query(description="Rounded so that nobody sees it, or bit for bit.")] = "packed",
) -> Response:
    """Sixty frames in a few kilobytes; they never change, and may be kept for good."""
    blocks = session.blocks
    if revision != blocks.revision:
        raise ProblemError(
            410,
            "other-revision",
            "These frames are no longer played",
            f"score, cast or show are others than those of revision {revision[:20]!r}: the present one is "
            f"{blocks.revision!r}",
        )
    last = math.floor(session.clock.duration_s * blocks.fps) // BLOCK_FRAMES
    if number > last:
        raise ProblemError(
            404, "unknown-block", "There is no such block", f"the last block of this music is {last}"
        )
    data = blocks.packed(number, form)
    if data is None:
        async with request.app.state.computing.of(session.id):
            data = await asyncio.to_thread(blocks.block, number, form)
        if not len(session.audience):
            blocks.forget()
    return Response(data, media_type="application/octet-stream", headers=HEADERS)
