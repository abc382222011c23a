"""A session's sound."""

from fastapi import APIRouter, Response
from fastapi.responses import FileResponse, JSONResponse

from reina.api.access import Watched
from reina.api.problems import ProblemError
from reina.protocol.messages import SongState

router = APIRouter(tags=["song"])

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
    song = session.song
    if song.source == "rendered" and song.path is not None and not song.path.is_file():
        # Removed to make room, or by hand.
        session.renew_song()
        song = session.song
    if song.error is not None:
        raise ProblemError(502, "no-song", "There is no sound", f"no song could be made: {song.error}")
    if song.path is None:
        return JSONResponse(
            session.song_state().model_dump(), 202, headers={"Retry-After": "1", "Cache-Control": "no-store"}
        )
    return FileResponse(song.path, media_type=song.media_type, headers=HEADERS)
