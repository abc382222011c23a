"""The laboratory's third table: motion clips, shipped or uploaded."""

import asyncio
from collections.abc import AsyncIterator
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Annotated

from fastapi import APIRouter, Query, Request
from fastapi.responses import PlainTextResponse, Response, StreamingResponse

from reina.api.http.access import ServerSettings
from reina.api.http.body import BoundedRoute
from reina.api.http.problems import ProblemError
from reina.api.lab.long_work import parsed_text, plain_clip
from reina.api.lab.work import OWNER, compute, compute_long
from reina.protocol.lab import LabClip, LabClipList, ParsedClip
from reina.protocol.links import rig_href
from reina.protocol.resources import Fault
from reina.skeleton import BvhError, MotionClip, PositionMeaning, bvh_head, bvh_rows, read_bvh
from reina.system.turns import Turns

router = APIRouter(route_class=BoundedRoute)

CLIPS = "*/clips/*.bvh"
VALUES_A_PIECE = 50_000
"""Numbers of a rewritten file that are written at a time."""
Positions = Annotated[
    PositionMeaning,
    Query(
        description="What a joint's position channels mean: its place in its parent's frame, in place of its "
        "OFFSET, as most programs write them (`replace`); or how far it is from its OFFSET (`add`)."
    ),
]
BODY = {
    "requestBody": {
        "required": True,
        "description": "The file itself, at most 20 MB.",
        "content": {"text/plain": {"schema": {"type": "string"}}},
    }
}


@router.get("/clips")
async def list_clips(request: Request, settings: ServerSettings) -> LabClipList:
    """The clips that ship with the rigs."""

    def work() -> LabClipList:
        paths = sorted(settings.rigs_dir.glob(CLIPS))
        return LabClipList(clips=[_summary(path, path.stat().st_mtime_ns) for path in paths])

    return await compute(request, work)


@router.post("/bvh", response_model=ParsedClip, openapi_extra=BODY)
async def read_clip(request: Request, positions: Positions = "replace") -> Response:
    """Read a BVH file: its joints, and where everything is in the world; long clips are thinned."""
    data = await request.body()
    try:
        text = await compute_long(request, len(data), parsed_text, data, positions)
    except BvhError as error:
        raise unreadable_clip(error) from error
    return Response(text, media_type="application/json")


@router.post("/bvh/rewritten", response_class=PlainTextResponse, openapi_extra=BODY)
async def rewrite_clip(request: Request, positions: Positions = "replace") -> StreamingResponse:
    """The same motion as a plain BVH file, without what other programs may stumble over.

    Joints with position channels have the OFFSET 0 in it, so that it is the same motion for programs that
    add the two as for those that do not.
    """
    data = await request.body()
    try:
        clip = await compute_long(request, len(data), plain_clip, data, positions)
    except BvhError as error:
        raise unreadable_clip(error) from error
    return StreamingResponse(
        _written(clip, request.app.state.computing),
        media_type="text/plain; charset=utf-8",
        headers={"Cache-Control": "no-store"},
    )


async def _written(clip: MotionClip, computing: Turns) -> AsyncIterator[str]:
    """A file's text in pieces, which is several times what was sent where its numbers are short."""
    yield bvh_head(clip, len(clip))
    rows = max(1, VALUES_A_PIECE // max(1, clip.values.shape[1]))
    for begin in range(0, len(clip), rows):
        piece = replace(clip, values=clip.values[begin : begin + rows])
        async with computing.of(OWNER):
            text = await asyncio.to_thread(bvh_rows, piece)
        yield text


def unreadable_clip(error: BvhError) -> ProblemError:
    """The problem of a BVH file that cannot be read."""
    fault = Fault(detail=error.detail, location=error.location)
    return ProblemError(422, "clip-unreadable", "The BVH file cannot be read", str(error), errors=[fault])


@lru_cache(maxsize=64)
def _summary(path: Path, modified_ns: int) -> LabClip:  # noqa: ARG001 - read anew when written anew
    clip = read_bvh(path.read_bytes())
    rig = path.parents[1].name
    return LabClip(
        rig=rig,
        name=path.stem,
        href=f"{rig_href(rig)}/clips/{path.name}",
        joints=len(clip.names),
        frames=len(clip),
        duration_s=len(clip) * clip.frame_time_s,
    )
