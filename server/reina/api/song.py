"""A session's sound."""

from pathlib import Path
from typing import Annotated

import numpy as np
from fastapi import APIRouter, Query, Response
from fastapi.responses import FileResponse, JSONResponse

from reina.api.http.access import Store, Watched
from reina.api.http.files import ServedFile
from reina.api.http.problems import ProblemError
from reina.protocol.messages import SongState
from reina.protocol.timeline import SongPeaks
from reina.sessions.session import Session

router = APIRouter(tags=["song"])

MAX_PEAKS = 20_000
PEAK_DIGITS = 4
# What was uploaded as sound is never to be taken for a page.
HEADERS = {"Cache-Control": "no-cache", "X-Content-Type-Options": "nosniff"}


@router.get(
    "/sessions/{session_id}/song",
    response_class=FileResponse,
    responses={
        200: {"content": {"audio/*": {}}, "description": "The song; ranges may be asked for."},
        202: {"model": SongState, "description": "It is still being made."},
    },
)
async def get_song(session: Watched) -> Response:
    """The audio; while the server still makes it from the score, how far it is."""
    path = _song_path(session)
    if path is None:
        return _under_way(session)
    return ServedFile(path, media_type=session.song.media_type, headers=HEADERS)


@router.get(
    "/sessions/{session_id}/song/peaks",
    response_model=SongPeaks,
    responses={
        202: {"model": SongState, "description": "The song is still being made."},
        204: {"description": "The server does not decode M4A and WebM; the page, which plays them, does."},
    },
)
async def get_peaks(
    session: Watched,
    store: Store,
    points: Annotated[int, Query(ge=1, le=MAX_PEAKS, description="How many stretches.")] = 1000,
) -> Response:
    """The sound's shape, to be drawn: its lowest and highest sample in each of many equal stretches."""
    path = _song_path(session)
    if path is None:
        return _under_way(session)
    peaks = await store.decoder.peaks(path)
    if peaks is None:
        return Response(status_code=204)
    drawn = peaks.reduced(points)
    answer = SongPeaks(
        duration_s=drawn.duration_s,
        lowest=np.round(drawn.lowest, PEAK_DIGITS).tolist(),
        highest=np.round(drawn.highest, PEAK_DIGITS).tolist(),
    )
    return Response(answer.model_dump_json(), media_type="application/json", headers=HEADERS)


def _song_path(session: Session) -> Path | None:
    """The song's file; None while it is being made.

    Raises:
        ProblemError: There will be none.
    """
    song = session.song
    if song.source == "rendered" and song.path is not None and not song.path.is_file():
        # Removed to make room, or by hand.
        session.renew_song()
        song = session.song
    if song.error is not None:
        raise ProblemError(502, "no-song", "There is no sound", f"no song could be made: {song.error}")
    return song.path


def _under_way(session: Session) -> Response:
    return JSONResponse(
        session.song_state().model_dump(), 202, headers={"Retry-After": "1", "Cache-Control": "no-store"}
    )
