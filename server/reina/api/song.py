"""A session's sound."""

from pathlib import Path, PurePath
from typing import Annotated, Literal

import numpy as np
from fastapi import APIRouter, Depends, Query, Response
from fastapi.responses import FileResponse, JSONResponse, StreamingResponse
from starlette.concurrency import run_in_threadpool

from reina.api.http.access import Store, Watched
from reina.api.http.files import IMMUTABLE, ServedFile
from reina.api.http.problems import ProblemError, storage_full
from reina.protocol.messages import SongState
from reina.protocol.timeline import SongPeaks
from reina.sessions.session import Session
from reina.sessions.song import Song
from reina.sound.encode import SEGMENT_MEDIA_TYPE, WAV_MEDIA_TYPE, wav_of
from reina.sound.hearing import AS_WRITTEN, MOST_SEMITONES, Hearing, Stem
from reina.sound.recording.probe import media_type_of
from reina.sound.renderer import NoRoomError

router = APIRouter(tags=["song"])

MAX_PEAKS = 20_000
PEAK_DIGITS = 4
SEGMENT_PATIENCE_S = 1.0
"""How long a request waits for a segment that is not there yet; then it is told how far the rendering is."""
# What was uploaded as sound is never to be taken for a page.
ATTACHED = {"Content-Disposition": "attachment"}
HEADERS = {"Cache-Control": "no-cache", **ATTACHED}


TOLD_APART = "Tells the renderings apart; what is sent is always the song of what is played now."


def _hearing(
    session: Watched,
    stem: Annotated[
        Stem,
        Query(
            description="Of a rendered song everything, one player's part alone, or everything else; the two "
            "together are the whole, as loud as it is."
        ),
    ] = "all",
    player: Annotated[int, Query(ge=0, description="Whose part, a place in the cast.")] = 0,
    semitones: Annotated[
        int,
        Query(
            ge=-MOST_SEMITONES,
            le=MOST_SEMITONES,
            description="How much higher all but the drums of a rendered song sounds.",
        ),
    ] = 0,
) -> Hearing:
    if stem != "all" and player >= len(session.production.performers):
        last = len(session.production.performers) - 1
        raise ProblemError(
            422, "unknown-player", "There is no such player", f"`player` is 0 to {last}, not {player}"
        )
    hearing = Hearing(stem, player if stem != "all" else 0, semitones)
    if session.record.song is not None and not hearing.is_whole:
        raise ProblemError(
            422,
            "recording-is-whole",
            "A recording is heard as it is",
            "its parts cannot be told apart, nor moved: leave `stem` and `semitones` out",
        )
    return hearing


Heard = Annotated[Hearing, Depends(_hearing)]


def _rendering(
    sequence: Annotated[int | None, Query(description=TOLD_APART)] = None,
    part: Annotated[list[int] | None, Query(description=TOLD_APART)] = None,
    transposition: Annotated[list[int] | None, Query(description=TOLD_APART)] = None,
    joined_parts: Annotated[list[str] | None, Query(description=TOLD_APART)] = None,
) -> None:
    """What the links of rendered songs say, so that each has an address of its own."""


@router.get(
    "/sessions/{session_id}/song",
    response_class=FileResponse,
    dependencies=[Depends(_rendering)],
    responses={
        200: {"content": {"audio/*": {}}, "description": "The song; ranges may be asked for, but of a WAV."},
        202: {"model": SongState, "description": "It is still being made."},
    },
)
async def get_song(
    session: Watched,
    store: Store,
    hearing: Heard,
    format: Annotated[  # noqa: A002
        Literal["wav", "original"] | None,
        Query(
            description="`wav`: a rendered song as WAV instead of FLAC. `original`: an uploaded one as it "
            "came, which is what is sent anyway but of kinds that browsers do not play (AIFF, some WAV): "
            "these are sent as FLAC."
        ),
    ] = None,
) -> Response:
    """The audio; while the server still makes it from the score, how far it is."""
    song, path = _song_and_path(session, hearing)
    if path is None:
        return _under_way(session, hearing)
    if format == "wav" and song.media_type != WAV_MEDIA_TYPE:
        if song.source == "uploaded":
            raise ProblemError(
                422,
                "not-converted",
                "The song is no WAV",
                f"it was uploaded as {song.media_type} and is sent as it came: leave `format` out",
            )
        return await run_in_threadpool(_as_wav, path)
    record, is_original = session.record.song, format == "original"
    if record is None:
        return ServedFile(path, media_type=song.media_type, headers=HEADERS)
    uploaded = await store.recordings.file(session, is_original=is_original)
    media_type = record.media_type
    if is_original and record.original is not None:
        media_type = media_type_of(PurePath(record.original).suffix)
    return ServedFile(uploaded or path, media_type=media_type, headers=HEADERS)


@router.get("/sessions/{session_id}/song/state")
async def get_song_state(session: Watched, hearing: Heard) -> SongState:
    """How far the sound is, and where its segments are; what was not asked for before is begun."""
    _song_and_path(session, hearing)
    return session.song_state(hearing)


@router.get(
    "/sessions/{session_id}/song/segments/{rendering}/{number}",
    response_class=FileResponse,
    responses={
        200: {"content": {SEGMENT_MEDIA_TYPE: {}}, "description": "The segment, with its overlaps."},
        202: {"model": SongState, "description": "It is not rendered yet; it is the next to be."},
        410: {"description": "The sound is another now; `song/state` says where its segments are."},
    },
)
async def get_segment(session: Watched, rendering: str, number: int) -> Response:
    """A segment of a rendered song, to be heard before the whole is rendered.

    One that is not there yet is rendered next, and the rest after it; the answer waits for it for a
    second. Where the sound becomes another meanwhile, the answer is 202 with the present one's state.
    """
    heard = session.heard.request(rendering)
    hearing, request = (AS_WRITTEN, None) if heard is None else heard
    if request is None:
        _song_and_path(session)
        request = session.song.request
        if request is None and session.song.source == "rendered":
            return _under_way(session)
    if request is None or request.rendering_id != rendering:
        state = session.song_state()
        present = "none" if state.segments is None else state.segments.href
        raise ProblemError(410, "another-sound", "The sound is another now", f"its segments: {present}")
    if not 0 <= number < request.segments.count:
        raise ProblemError(
            404, "unknown-segment", "Not Found", f"the song's segments are 0 to {request.segments.count - 1}"
        )
    path = await request.segment(number, within_s=SEGMENT_PATIENCE_S)
    if path is None:
        if request.given_up:
            return _under_way(session)
        if request.error is not None:
            raise _no_song(str(request.error), lacks_room=isinstance(request.error, NoRoomError))
        return _under_way(session, hearing)
    return ServedFile(path, media_type=SEGMENT_MEDIA_TYPE, caching=IMMUTABLE, headers=ATTACHED)


@router.get(
    "/sessions/{session_id}/song/peaks",
    response_model=SongPeaks,
    responses={
        202: {"model": SongState, "description": "The song is still being planned."},
        204: {"description": "M4A or WebM, not decoded here; `song/analysis` takes it decoded."},
    },
)
async def get_peaks(
    session: Watched,
    store: Store,
    points: Annotated[int, Query(ge=1, le=MAX_PEAKS, description="How many stretches.")] = 1000,
) -> Response:
    """The sound's shape, to be drawn: its lowest and highest sample in each of many equal stretches."""
    _, path = _song_and_path(session)
    if path is not None:
        uploaded = session.record.song is not None
        peaks = await (store.recordings.peaks(session) if uploaded else store.decoder.peaks(path))
        if peaks is None:
            return Response(status_code=204)
    else:
        request = session.song.request
        peaks = None if request is None else request.peaks
        if peaks is None:
            return _under_way(session)
    drawn = peaks.reduced(points)
    answer = SongPeaks(
        duration_s=drawn.duration_s,
        lowest=np.round(drawn.lowest, PEAK_DIGITS).tolist(),
        highest=np.round(drawn.highest, PEAK_DIGITS).tolist(),
        complete=path is not None,
    )
    return Response(answer.model_dump_json(), media_type="application/json", headers=HEADERS)


def _song_and_path(session: Session, hearing: Hearing = AS_WRITTEN) -> tuple[Song, Path | None]:
    """A song and its file; None while it is being made.

    Raises:
        ProblemError: There will be none.
    """
    song = session.song if hearing.is_whole else session.heard.song(hearing)
    if hearing.is_whole and song.source == "rendered" and song.path is not None and not song.path.is_file():
        # Removed to make room, or by hand.
        session.renew_song()
        song = session.song
    if song.error is not None:
        raise _no_song(song.error, lacks_room=song.lacks_room)
    return song, song.path


def _no_song(why: str, *, lacks_room: bool) -> ProblemError:
    if lacks_room:
        return storage_full(why)
    return ProblemError(502, "no-song", "There is no sound", f"no song could be made: {why}")


def _as_wav(path: Path) -> Response:
    """A rendered song as WAV, decoded while it is sent."""
    size, content = wav_of(path)
    headers = {
        "Content-Length": str(size),
        "ETag": f'"{path.parent.name[:24]}-wav"',
        "Accept-Ranges": "none",
        **HEADERS,
    }
    return StreamingResponse(content, media_type=WAV_MEDIA_TYPE, headers=headers)


def _under_way(session: Session, hearing: Hearing = AS_WRITTEN) -> Response:
    return JSONResponse(
        session.song_state(hearing).model_dump(),
        202,
        headers={"Retry-After": "1", "Cache-Control": "no-store"},
    )
