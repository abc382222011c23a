"""The laboratory's third table: motion clips, shipped or uploaded."""

import asyncio
import base64
from collections.abc import AsyncIterator
from dataclasses import asdict, replace
from functools import lru_cache
from pathlib import Path
from typing import Annotated

from fastapi import APIRouter, Query, Request
from fastapi.responses import PlainTextResponse, Response, StreamingResponse

from reina.api.http.access import ServerSettings
from reina.api.http.body import BoundedRoute
from reina.api.http.problems import ProblemError
from reina.api.lab.work import compute
from reina.lab import clip_points
from reina.protocol.lab import LabClip, LabClipList, ParsedClip
from reina.protocol.links import rig_href
from reina.protocol.resources import Fault
from reina.skeleton import BvhError, MotionClip, PositionMeaning, bvh_head, bvh_rows, read_bvh

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
    # Megabytes: written as JSON in the thread too, where no viewer waits for it.
    text = await compute(request, lambda: _parsed(read_clip_file(data, positions)).model_dump_json())
    return Response(text, media_type="application/json")


@router.post("/bvh/rewritten", response_class=PlainTextResponse, openapi_extra=BODY)
async def rewrite_clip(request: Request, positions: Positions = "replace") -> StreamingResponse:
    """The same motion as a plain BVH file, without what other programs may stumble over.

    Joints with position channels have the OFFSET 0 in it, so that it is the same motion for programs that
    add the two as for those that do not.
    """
    data = await request.body()
    clip = await compute(request, lambda: read_clip_file(data, positions).without_still_positions())
    return StreamingResponse(
        _written(clip, request.app.state.computing),
        media_type="text/plain; charset=utf-8",
        headers={"Cache-Control": "no-store"},
    )


async def _written(clip: MotionClip, computing: asyncio.Semaphore) -> AsyncIterator[str]:
    """A file's text in pieces, which is several times what was sent where its numbers are short."""
    yield bvh_head(clip, len(clip))
    rows = max(1, VALUES_A_PIECE // max(1, clip.values.shape[1]))
    for begin in range(0, len(clip), rows):
        piece = replace(clip, values=clip.values[begin : begin + rows])
        async with computing:
            text = await asyncio.to_thread(bvh_rows, piece)
        yield text


def read_clip_file(data: bytes, positions: PositionMeaning) -> MotionClip:
    """The clip in an uploaded BVH file.

    Raises:
        ProblemError: 422, it cannot be read.
    """
    try:
        return read_bvh(data, positions=positions)
    except BvhError as error:
        fault = Fault(detail=error.detail, location=error.location)
        raise ProblemError(
            422, "clip-unreadable", "The BVH file cannot be read", str(error), errors=[fault]
        ) from error


def _parsed(clip: MotionClip) -> ParsedClip:
    points = clip_points(clip)
    positions = points.positions.astype("<f4")
    return ParsedClip.model_validate(
        {
            "joints": [
                {
                    "name": name,
                    "parent": None if parent < 0 else parent,
                    "offset": offset,
                    "channels": channels,
                }
                for name, parent, offset, channels in zip(
                    clip.names,
                    clip.parents.tolist(),
                    clip.offsets.tolist(),
                    map(list, clip.channels),
                    strict=True,
                )
            ],
            "frames": len(clip),
            "frame_time_s": clip.frame_time_s,
            "duration_s": len(clip) * clip.frame_time_s,
            "warnings": [asdict(warning) for warning in clip.warnings],
            "points": list(points.names),
            "point_parents": points.parents.tolist(),
            "frame_step": points.frame_step,
            "sampled_frames": len(positions),
            "minimum": positions.min(axis=(0, 1)).tolist(),
            "maximum": positions.max(axis=(0, 1)).tolist(),
            "positions": base64.b64encode(positions.tobytes()).decode("ascii"),
        }
    )


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
