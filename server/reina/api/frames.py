"""Frames over HTTP: the same bytes as the stream's, as fast as they can be computed."""

import asyncio
from collections.abc import AsyncIterator
from typing import Annotated

from fastapi import APIRouter, Query, Request
from fastapi.responses import StreamingResponse

from reina.api.http.access import Watched
from reina.api.http.answers import LARGE_ANSWER
from reina.api.http.problems import ProblemError
from reina.performance import BLOCK_FRAMES
from reina.protocol.messages import Hello
from reina.sessions.frames import EncodedFrames
from reina.sessions.production import Production
from reina.sessions.schedule import frame_from
from reina.sessions.session import Session
from reina.system.turns import Turns

router = APIRouter(tags=["frames"])

LONGEST_S = 600.0
LATEST_S = 7 * 24 * 3600.0
"""No music lasts so long, and every frame up to here has an index of 32 bits."""
FASTEST_FPS = 240

FramesPerSecond = Annotated[int, Query(ge=1, le=FASTEST_FPS, description="Frames a second of song time.")]
StartS = Annotated[float, Query(ge=0, le=LATEST_S, description="Song time of the first frame.")]
EndS = Annotated[
    float | None,
    Query(ge=0, le=LATEST_S, description="Song time before which they end; the music's end by default."),
]


@router.get("/sessions/{session_id}/manifest")
async def get_manifest(session: Watched, fps: FramesPerSecond = 60) -> Hello:
    """What the stream's `hello` says: where everything in a frame is."""
    return session.hello().model_copy(update={"fps": fps})


@router.get(
    "/sessions/{session_id}/frames",
    dependencies=[LARGE_ANSWER],
    response_class=StreamingResponse,
    responses={
        200: {"content": {"application/octet-stream": {}}, "description": "Whole frames, back to back."}
    },
)
async def get_frames(
    request: Request,
    session: Watched,
    start_s: StartS = 0.0,
    end_s: EndS = None,
    fps: FramesPerSecond = 60,
) -> StreamingResponse:
    """The frames k with start_s ≤ k / fps < end_s, epoch 0, due time 0."""
    first, end = frame_span(session, start_s, end_s, fps)
    production = session.production
    return StreamingResponse(
        _frames(production, first, end, fps, request.app.state.computing, session.id),
        media_type="application/octet-stream",
        headers={
            "Content-Length": str((end - first) * production.manifest.frame_size),
            "Cache-Control": "no-store",
        },
    )


def frame_span(session: Session, start_s: float, end_s: float | None, fps: int) -> tuple[int, int]:
    """The first frame at or after a song time, and the first at or after another, where the span ends.

    Raises:
        ProblemError: 422 when it ends before it begins, or is too long.
    """
    end_s = session.clock.duration_s if end_s is None else end_s
    if not start_s <= end_s <= start_s + LONGEST_S:
        raise ProblemError(
            422,
            "span-invalid",
            "These frames cannot be sent",
            f"end_s lies between start_s and start_s + {LONGEST_S:g}, not at {end_s:g}; "
            "longer spans are asked for piecewise",
        )
    return frame_from(start_s, fps), frame_from(end_s, fps)


async def _frames(
    production: Production, first: int, end: int, fps: int, computing: Turns, owner: str
) -> AsyncIterator[bytes]:
    frames: EncodedFrames | None = None
    while first < end:
        # Up to the end of an aligned block at a time; a thread, since a viewer's frames come first.
        last = min(end, (first // BLOCK_FRAMES + 1) * BLOCK_FRAMES) - 1
        # Whoever computes, one block at a time: a hundred exports slow one another and nobody else.
        async with computing.of(owner):
            if frames is None:
                production = await asyncio.to_thread(production.at_rate, fps)
                frames = EncodedFrames(production.performance, production.manifest, kept=1)
            span = await asyncio.to_thread(frames.span, first, last)
        yield span.tobytes()
        first = last + 1
