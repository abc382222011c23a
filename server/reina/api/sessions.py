"""Sessions: made from an upload, listed, changed and ended."""

import asyncio
from collections.abc import AsyncIterator, Iterable
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from fastapi import APIRouter, Body, Query, Request, Response
from fastapi.responses import StreamingResponse
from pydantic import ValidationError

from reina.api.cast import cast_of_fields, refuse_twice
from reina.api.http.access import (
    Controlled,
    Doomed,
    People,
    ServerSettings,
    Store,
    Uploader,
    Watched,
    is_owner,
)
from reina.api.http.answers import LARGE_ANSWER
from reina.api.http.body import BoundedRoute
from reina.api.http.problems import ProblemError, problem_of_validation
from reina.api.http.proxies import client_address
from reina.api.http.sign_in import Person, not_signed_in
from reina.api.http.upload_limits import FILE_LIMITS, MEGABYTE
from reina.api.http.work import in_turn
from reina.api.upload import Upload, receive_upload
from reina.music import Score
from reina.protocol import resources
from reina.protocol.links import session_links
from reina.protocol.transport import TransportCommand, TransportState
from reina.sessions.draft import Draft
from reina.sessions.score_text import packed_score
from reina.sessions.session import Session
from reina.sessions.storage.errors import SessionDamagedError

router = APIRouter(tags=["sessions"], route_class=BoundedRoute)

LISTED = 100
MAX_LISTED = 1000


def session_form() -> dict[str, Any]:
    """The form of POST /sessions: its files, and the fields as they are declared; nothing in it is null."""
    files = {
        "score": "MIDI, MusicXML or JSON, gzip'd or zipped if need be, at most {} MB",
        "song": "WAV, AIFF, MP3, Ogg, FLAC, M4A or WebM, at most {} MB; without it the score is rendered",
        "show": "JSON, at most {} MB",
    }
    properties: dict[str, Any] = {
        name: {
            "type": "string",
            "format": "binary",
            "description": text.format(FILE_LIMITS[name] // MEGABYTE),
        }
        for name, text in files.items()
    }
    for name, declared in resources.SessionFields.model_json_schema()["properties"].items():
        kinds = [kind for kind in declared.pop("anyOf", ()) if kind != {"type": "null"}]
        said = declared | (kinds[0] if kinds else {})
        properties[name] = {key: said[key] for key in said if key != "title" and said[key] is not None}
    schema = {"type": "object", "required": ["score"], "properties": properties}
    return {"requestBody": {"required": True, "content": {"multipart/form-data": {"schema": schema}}}}


_COMMANDS: dict[str, Any] = {
    "play": {"value": {"action": "play"}},
    "pause": {"value": {"action": "pause"}},
    "seek": {"value": {"action": "seek", "song_time_s": 12.5}},
    "rate": {"value": {"action": "rate", "rate": 0.5}},
    "loop": {"value": {"action": "loop", "start_s": 4.0, "end_s": 8.0}},
    "end the loop": {"value": {"action": "loop"}},
}


@router.post("/sessions", status_code=201)
async def create_session(
    request: Request, response: Response, store: Store, person: Uploader
) -> resources.CreatedSession:
    """Make a session of a score, and of a song and a show if there are any.

    The answer holds the control token, which is told this once: keep it.
    """
    sender = client_address(request.scope)
    await store.require_disk(sender)
    async with store.staging.folder(sender) as folder:
        upload = await receive_upload(request, folder, partial(store.staging.room.grow, folder))
        session, token = await store.create(_draft(folder, upload, request, person))
    if await request.is_disconnected():
        # Whoever sent it has given it up, and nobody else can come to know it.
        await store.delete(session)
    response.headers["Location"] = session_links(session.id).self
    return resources.CreatedSession(**dict(await _told(request, session)), control_token=token)


async def _told(request: Request, session: Session) -> resources.Session:
    """A session as it is told to who asks."""
    resource = await asyncio.to_thread(session.resource)
    return resource.model_copy(update={"mine": True}) if is_owner(request, session) else resource


def _draft(folder: Path, upload: Upload, request: Request, person: Person | None) -> Draft:
    if "score" not in upload.files:
        raise ProblemError(
            422,
            "no-score",
            "The form has no score",
            "send a MIDI, MusicXML or JSON file as the form's part `score`",
        )
    try:
        fields = resources.SessionFields.model_validate_strings(upload.fields)
    except ValidationError as error:
        raise problem_of_validation(error) from error
    return Draft(
        folder=folder,
        score="score",
        score_filename=upload.files["score"].filename,
        song="song" if "song" in upload.files else None,
        show="show" if "show" in upload.files else None,
        title=fields.title,
        public=fields.public,
        cast=cast_of_fields(fields),
        in_time=fields.in_time,
        sender=client_address(request.scope),
        owner=None if person is None else person.name,
    )


@router.get("/sessions")
async def list_sessions(
    request: Request,
    response: Response,
    people: People,
    store: Store,
    limit: Annotated[int, Query(ge=1, le=MAX_LISTED, description="How many at most.")] = LISTED,
    after: Annotated[
        str | None, Query(max_length=100, description="The `next` of the page before; leave it out at first.")
    ] = None,
    mine: Annotated[
        bool, Query(description="Those that were made by who is signed in, public or not, instead.")
    ] = False,
) -> resources.SessionList:
    """The public sessions, newest first, page by page."""
    owner: str | None = None
    if mine:
        person = people.person(request.scope)
        if person is None or person.name is None:
            raise not_signed_in()
        owner = person.name
        response.headers["Cache-Control"] = "no-store"
    entries, following = await store.listed(limit, after, owner=owner)
    return resources.SessionList(
        sessions=[
            resources.SessionSummary(
                id=entry.id, title=entry.title, created_at=entry.created_at, links=session_links(entry.id)
            )
            for entry in entries
        ],
        next=following,
    )


@router.get("/sessions/{session_id}")
async def get_session(
    request: Request, session: Watched, store: Store, settings: ServerSettings
) -> resources.Session:
    """One session."""
    ends_at = await store.ends_at(session, settings.end_unseen_s)
    resource = await _told(request, session)
    return resource.model_copy(update={"ends_at": ends_at})


@router.patch("/sessions/{session_id}")
async def change_session(
    request: Request,
    session: Controlled,
    change: Annotated[resources.SessionChange, Body(examples=[{"title": "Taps, slower", "part": 1}])],
    store: Store,
) -> resources.Session:
    """Rename it, list it or not, or have the player play other parts or another sequence, or elsewhere."""
    wanted = change.model_dump(exclude_none=True)
    named = {field: wanted.pop(field) for field in ("title", "public") if field in wanted}
    if "joined_parts" in wanted:
        wanted["joined_parts"] = tuple(wanted["joined_parts"])
    if wanted.pop("cast", None):
        sequence = wanted.pop("sequence", None)
        refuse_twice(wanted)
        await store.edits.change(session, **named, recast=lambda cast: cast.found_anew(sequence))
    else:
        await store.edits.change(session, **named, recast=lambda cast: cast.changed(**wanted))
    return await _told(request, session)


@router.delete("/sessions/{session_id}", status_code=204)
async def end_session(session: Doomed, store: Store) -> None:
    """End it, and remove everything of it; one that cannot be read, too."""
    if isinstance(session, SessionDamagedError):
        await store.delete_damaged(session)
    else:
        await store.delete(session)


@router.post("/sessions/{session_id}/control_token")
async def renew_control_token(session: Controlled, store: Store) -> resources.ControlToken:
    """Make the control token anew: the one before, and every link with it, controls nothing from then on.

    Who watches goes on watching: for that the id is enough, which stays.
    """
    return resources.ControlToken(control_token=await store.edits.renew_token(session))


@router.get("/sessions/{session_id}/score", response_model=resources.Score, dependencies=[LARGE_ANSWER])
async def get_score(
    request: Request,
    session: Watched,
    part: Annotated[int | None, Query(ge=0, description="The notes of this part alone.")] = None,
) -> Response:
    """The notes with their fingering, the parts, tempi, metres and bar lines."""
    production = session.production
    if part is not None and part >= len(production.score.parts):
        known = len(production.score.parts) - 1
        raise ProblemError(
            404, "unknown-part", "There is no such part", f"the score's parts are 0 to {known}, not {part}"
        )
    text = production.packed_score or await in_turn(request, session, lambda: packed_score(production))
    title = session.record.title
    headers = {
        "ETag": text.etag(title, part),
        "Cache-Control": "no-cache",
        "Vary": "Accept-Encoding",
    }
    if part is None and "gzip" in request.headers.get("accept-encoding", ""):
        pieces, size = text.gzipped(title)
        headers |= {"Content-Encoding": "gzip", "Content-Length": str(size)}
        return StreamingResponse(_each(pieces), media_type="application/json", headers=headers)
    wanted = None if part is None else await asyncio.to_thread(_of_part, production.score, part)
    return StreamingResponse(text.plain(title, wanted), media_type="application/json", headers=headers)


async def _each(pieces: Iterable[memoryview]) -> AsyncIterator[memoryview]:
    for piece in pieces:
        yield piece


def _of_part(score: Score, part: int) -> list[bool]:
    wanted = np.zeros(len(score.notes), bool)
    wanted[score.note_indices(part)] = True
    return wanted.tolist()


@router.get("/sessions/{session_id}/transport", tags=["transport"])
async def get_transport(session: Watched) -> TransportState:
    """Where the music clock is."""
    return session.transport()


@router.post("/sessions/{session_id}/transport", tags=["transport"])
async def control_transport(
    session: Controlled, command: Annotated[TransportCommand, Body(openapi_examples=_COMMANDS)]
) -> TransportState:
    """Play, pause, seek, or change rate or loop; every viewer follows at once."""
    return await session.follow(command)
