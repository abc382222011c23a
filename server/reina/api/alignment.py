"""Where a session's score is heard in its song."""

import asyncio
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Annotated, Any

from fastapi import APIRouter, Body, Request
from pydantic import Discriminator, Tag

from reina.api.http.access import Controlled, Store, Watched
from reina.api.http.body import BoundedRoute
from reina.api.http.problems import ProblemError
from reina.api.http.proxies import client_address
from reina.protocol.alignment import Alignment as AlignmentResource
from reina.protocol.alignment import AlignmentCorrections, AlignmentDocument
from reina.sessions.record import UNDECODED
from reina.sessions.session import Session
from reina.sound.alignment import Alignment, Anchor, alignment_of, document_of
from reina.sound.alignment.bars import aligned_bars

router = APIRouter(tags=["alignment"], route_class=BoundedRoute)


def _kind(body: Any) -> str:
    return "document" if isinstance(body, dict) and "points" in body else "corrections"


Fields = Annotated[
    Annotated[AlignmentCorrections, Tag("corrections")] | Annotated[AlignmentDocument, Tag("document")],
    Discriminator(_kind),
]
EXAMPLES = [{"offset_s": 0.12}, {"follows_key": True}, {"anchors": [{"score_s": 0.5, "song_s": 0.75}]}]


@router.get("/sessions/{session_id}/alignment")
async def get_alignment(session: Watched) -> AlignmentResource:
    """Whether the score is in time with the song, how sure that is, and the whole map."""
    return await _resource(session)


@router.put("/sessions/{session_id}/alignment")
async def put_alignment(
    session: Controlled, fields: Annotated[Fields, Body(examples=EXAMPLES)], store: Store
) -> AlignmentResource:
    """Put right where the score is heard, or put in place what was kept of it; everybody sees it at once.

    Anchors, offset and key stand beside what was found, and replace those that were there; `{}` takes back
    all that was put right. A document with `points` replaces what was found too.
    """
    if session.record.song is None:
        raise _no_song()

    def put(known: Alignment | None) -> Alignment:
        if isinstance(fields, AlignmentDocument):
            return alignment_of(fields)
        anchors = [Anchor(**anchor.model_dump()) for anchor in fields.anchors]
        corrected = (known or _unknown(session)).with_anchors(anchors).with_offset(fields.offset_s)
        return corrected.with_key(follows=fields.follows_key)

    await store.edits.change_alignment(session, put)
    return await _resource(session)


@router.post("/sessions/{session_id}/alignment/search", status_code=202)
async def search_alignment(session: Controlled, store: Store) -> AlignmentResource:
    """Look for the score in the song anew; what was put right by hand stays."""
    if session.record.song is None:
        raise _no_song()
    if not store.edits.search_alignment(session):
        raise ProblemError(
            409,
            "undecoded-song",
            "The server does not decode this song",
            f"{session.record.song.media_type} is decoded by browsers alone: open the session in one, which "
            "sends what it decodes, or `PUT` it to song/analysis as WAV or FLAC; or put anchors",
        )
    return await _resource(session)


@router.put(
    "/sessions/{session_id}/song/analysis",
    status_code=202,
    openapi_extra={
        "requestBody": {
            "required": True,
            "content": {"audio/wav": {"schema": {"type": "string", "format": "binary"}}},
        }
    },
)
async def put_song_analysis(request: Request, session: Controlled, store: Store) -> AlignmentResource:
    """Send an M4A's or WebM's sound, decoded, to have the score looked for in it.

    The server does not decode these two; a page that plays them does. WAV or FLAC, one channel of 22,050
    samples a second being enough, as long as the song. It is listened to and drawn, and never served.
    """
    song = session.record.song
    if song is None:
        raise _no_song()
    if song.media_type not in UNDECODED:
        raise ProblemError(
            409,
            "decoded-song",
            "The server decodes this song itself",
            f"{song.media_type} is listened to as it was sent; POST alignment/search looks again",
        )
    async with store.staging.folder(client_address(request.scope)) as folder:
        sent = folder / "song"
        await _write(request, sent, partial(store.staging.room.grow, folder))
        await store.recordings.hear(session, sent)
    return await _resource(session)


async def _write(request: Request, path: Path, grow: Callable[[int], None]) -> None:
    """Write a body to a file, as it comes in; `grow` is told of its bytes before."""
    with path.open("wb") as file:
        async for chunk in request.stream():
            if chunk:
                grow(len(chunk))
                await asyncio.to_thread(file.write, chunk)


async def _resource(session: Session) -> AlignmentResource:
    known, song = session.alignment.alignment, session.record.song
    score = session.production.written_score
    bars = [] if song is None else await asyncio.to_thread(aligned_bars, score, known)
    return AlignmentResource(
        **dict(session.alignment.state()),
        is_searchable=song is not None and song.is_heard,
        song_duration_s=None if song is None else song.duration_s,
        bars=bars,
        alignment=None if known is None else document_of(known),
    )


def _unknown(session: Session) -> Alignment:
    score_s = session.production.written_score.duration_s
    song_s = session.record.song.duration_s if session.record.song else None
    return Alignment.identity(score_s, song_s or score_s, is_same_music=False)


def _no_song() -> ProblemError:
    return ProblemError(
        409,
        "no-recording",
        "There is no recording",
        "the song is rendered from the score and in time with it; upload a recording to align both",
    )
