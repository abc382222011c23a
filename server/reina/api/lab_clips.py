"""The laboratory's third table: motion clips, shipped or uploaded."""

import base64
from functools import lru_cache
from pathlib import Path

import numpy as np
from fastapi import APIRouter, Request
from fastapi.responses import PlainTextResponse, Response

from reina.api.access import ServerSettings
from reina.api.lab_work import compute
from reina.api.problems import ProblemError
from reina.lab import clip_points
from reina.protocol.lab import LabClip, LabClipList, ParsedClip
from reina.protocol.links import rig_href
from reina.protocol.resources import Fault
from reina.skeleton import BvhError, MotionClip, read_bvh, write_bvh

router = APIRouter()

MEGABYTE = 1_000_000
MOST_BYTES = 20 * MEGABYTE
READ_ON = 32 * MEGABYTE
"""How much of a file that is too large is still read, so that its sender comes to hear why."""
CLIPS = "*/clips/*.bvh"
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
async def read_clip(request: Request) -> Response:
    """Read a BVH file: its joints, and where everything is in the world; long clips are thinned."""
    data = await _body(request)
    # Megabytes: written as JSON in the thread too, where no viewer waits for it.
    text = await compute(request, lambda: _parsed(_read(data)).model_dump_json())
    return Response(text, media_type="application/json")


@router.post("/bvh/rewritten", response_class=PlainTextResponse, openapi_extra=BODY)
async def rewrite_clip(request: Request) -> PlainTextResponse:
    """The same motion as a plain BVH file, without what other programs may stumble over."""
    data = await _body(request)
    text = await compute(request, lambda: write_bvh(_read(data)))
    return PlainTextResponse(text, headers={"Cache-Control": "no-store"})


async def _body(request: Request) -> bytes:
    data = bytearray()
    refused = 0
    async for chunk in request.stream():
        if len(data) <= MOST_BYTES:
            data += chunk
        else:
            refused += len(chunk)
            if refused > READ_ON:
                break
    if len(data) > MOST_BYTES:
        raise ProblemError(
            413,
            "clip-too-large",
            "Content Too Large",
            f"a motion file may have {MOST_BYTES // MEGABYTE} MB; this one is larger",
        )
    return bytes(data)


def _read(data: bytes) -> MotionClip:
    try:
        return read_bvh(data)
    except BvhError as error:
        fault = Fault(detail=error.detail, location=error.where)
        raise ProblemError(
            422, "clip-unreadable", "The BVH file cannot be read", str(error), errors=[fault]
        ) from error


def _parsed(clip: MotionClip) -> ParsedClip:
    if len(clip) == 0:
        fault = Fault(detail="the file has no frame to show", location="Frames")
        raise ProblemError(
            422, "clip-unreadable", "The BVH file cannot be read", fault.detail, errors=[fault]
        )
    points = clip_points(clip)
    positions = points.positions.astype("<f4")
    if not np.all(np.isfinite(positions)):
        fault = Fault(detail="its numbers are too large to be drawn", location=None)
        raise ProblemError(
            422, "clip-unreadable", "The BVH file cannot be read", fault.detail, errors=[fault]
        )
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
