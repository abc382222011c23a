"""Motion and music in files that other programs read."""

import asyncio
import re
from collections.abc import AsyncIterator
from typing import Annotated
from urllib.parse import quote

from fastapi import APIRouter, Query, Request, Response
from fastapi.responses import StreamingResponse

from reina.api.frames import EndS, FramesPerSecond, StartS, frame_span
from reina.api.http.access import Store, Watched
from reina.api.http.answers import LARGE_ANSWER
from reina.sessions.motion_export import BvhExport, player_skeleton
from reina.system.turns import Turns

router = APIRouter(tags=["frames"])


@router.get(
    "/sessions/{session_id}/export.bvh",
    dependencies=[LARGE_ANSWER],
    response_class=StreamingResponse,
    responses={200: {"content": {"text/plain": {}}, "description": "A BVH file."}},
)
async def export_bvh(
    request: Request,
    session: Watched,
    start_s: StartS = 0.0,
    end_s: EndS = None,
    fps: FramesPerSecond = 60,
    player: Annotated[
        int, Query(ge=0, description="Whose motion: the player's place in the cast, 0 being the first.")
    ] = 0,
    skeleton: Annotated[
        str | None,
        Query(description="The skeleton's name in the manifest: an instrument's too, in place of `player`."),
    ] = None,
) -> StreamingResponse:
    """The motion of one player, or of another skeleton, frame by frame the stream's, in metres and degrees.

    BVH knows no rest rotations: at rest every joint's frame stands along the world's axes. Joints are where
    the frames have them.
    """
    first, end = frame_span(session, start_s, end_s, fps)
    computing: Turns = request.app.state.computing
    async with computing.of(session.id):
        production = await asyncio.to_thread(session.production.at_rate, fps)
    name = player_skeleton(production, player) if skeleton is None else skeleton
    export = BvhExport(production, name, first, end)
    return StreamingResponse(
        _lines(export, computing, session.id),
        media_type="text/plain; charset=utf-8",
        headers=attachment(f"{session.record.title} - {name}", "bvh"),
    )


@router.get(
    "/sessions/{session_id}/export.mid",
    dependencies=[LARGE_ANSWER],
    response_class=Response,
    responses={200: {"content": {"audio/midi": {}}, "description": "A Standard MIDI File of format 1."}},
)
async def export_midi(session: Watched, store: Store) -> Response:
    """The score as MIDI, with the players' parts as they are played: moved, one note at a time.

    What no player plays stays as the score has it.
    """
    data = await store.reader.midi(session.production, owner=session.id)
    return Response(data, media_type="audio/midi", headers=attachment(session.record.title, "mid"))


def attachment(name: str, ending: str) -> dict[str, str]:
    """The headers of a file that is to be kept under a name."""
    words = re.sub(r"[^\w.-]+", " ", name).split()
    filename = quote(f"{' '.join(words) or 'reina'}.{ending}", safe="")
    return {"Content-Disposition": f"attachment; filename*=UTF-8''{filename}", "Cache-Control": "no-store"}


async def _lines(export: BvhExport, computing: Turns, owner: str) -> AsyncIterator[bytes]:
    for block in export.blocks:
        # As for frames over HTTP: on a thread, one block at a time, whoever computes.
        async with computing.of(owner):
            text = await asyncio.to_thread(export.text, block)
        yield text.encode()
