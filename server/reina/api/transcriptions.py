"""The notes of a recording alone: looked for in the background, and taken as MIDI."""

import asyncio
from functools import partial
from pathlib import Path as FilePath
from typing import Annotated, Any

from fastapi import APIRouter, Depends, Path, Query, Request, Response

from reina.api.export import attachment
from reina.api.http.access import Store, Uploader
from reina.api.http.body import BoundedRoute
from reina.api.http.problems import ProblemError
from reina.api.http.proxies import client_address
from reina.api.http.upload_limits import FILE_LIMITS, MEGABYTE
from reina.api.upload import Upload, receive_upload
from reina.instruments import INSTRUMENTS
from reina.protocol import resources
from reina.sessions.transcriptions import Transcriptions, TranscriptionWork
from reina.sound.transcription.transcribe import Line, line_of

router = APIRouter(tags=["transcriptions"], route_class=BoundedRoute)

LONGEST_TITLE = 200
FORM: dict[str, Any] = {
    "requestBody": {
        "required": True,
        "content": {
            "multipart/form-data": {
                "schema": {
                    "type": "object",
                    "required": ["song"],
                    "properties": {
                        "song": {
                            "type": "string",
                            "format": "binary",
                            "description": "WAV, MP3, Ogg or FLAC, 15 minutes and "
                            f"{FILE_LIMITS['song'] // MEGABYTE} MB at most",
                        }
                    },
                }
            }
        },
    }
}


def _transcriptions(request: Request) -> Transcriptions:
    known: Transcriptions = request.app.state.transcriptions
    return known


Known = Annotated[Transcriptions, Depends(_transcriptions)]


def _work(
    known: Known, transcription_id: Annotated[str, Path(description="The search's id.")]
) -> TranscriptionWork:
    work = known.get(transcription_id)
    if work is None:
        raise ProblemError(
            404,
            "unknown-transcription",
            "There is no such search",
            f"no search for notes has the id {transcription_id!r}; the server keeps the last few",
        )
    return work


Work = Annotated[TranscriptionWork, Depends(_work)]


@router.post("/transcriptions", status_code=202, openapi_extra=FORM)
async def transcribe(
    request: Request,
    response: Response,
    store: Store,
    known: Known,
    _: Uploader,
    title: Annotated[
        str | None,
        Query(max_length=LONGEST_TITLE, description="What the score is called; else as the file."),
    ] = None,
    instrument: Annotated[
        str | None,
        Query(max_length=200, description="What plays, by its name; it bounds which pitches are looked for."),
    ] = None,
) -> resources.Transcription:
    """Look for the notes of a recording in which one instrument or voice alone is heard.

    It goes on in the background: ask for it again until `status` is not `searching`, then take the MIDI file
    and make a session of it with the recording (`in_time`). Of a mix the notes are not found, and `fault`
    says so.
    """
    known.require()
    line = _line(instrument)
    folder = await store.staging.begin(client_address(request.scope))
    discard = partial(store.staging.discard, folder)
    try:
        upload = await receive_upload(request, folder, partial(store.staging.room.grow, folder))
        song, filename = _song(upload)
        work = known.begin(song, line, title or FilePath(filename or "").stem or "Transcription", discard)
    except BaseException:
        await asyncio.shield(discard())
        raise
    answer = work.resource()
    response.headers["Location"] = answer.links.self
    return answer


def _line(instrument: str | None) -> Line:
    if instrument is None:
        return Line()
    if instrument not in INSTRUMENTS:
        raise ProblemError(
            422,
            "unknown-instrument",
            "There is no such instrument",
            f"there is no instrument {instrument!r}; there are {', '.join(INSTRUMENTS)}",
        )
    return line_of(INSTRUMENTS[instrument])


def _song(upload: Upload) -> tuple[FilePath, str | None]:
    others = sorted({*upload.files, *upload.fields} - {"song"})
    if others:
        raise ProblemError(
            422,
            "unknown-part",
            "The form does not fit",
            f"the form has {', '.join(others)}; it may have song",
        )
    if "song" not in upload.files:
        raise ProblemError(
            422, "no-song", "The form has no recording", "send an audio file as the form's part `song`"
        )
    return upload.files["song"].path, upload.files["song"].filename


@router.get("/transcriptions/{transcription_id}")
async def get_transcription(work: Work, response: Response) -> resources.Transcription:
    """How far the search is, and what came of it."""
    response.headers["Cache-Control"] = "no-store"
    return work.resource()


@router.get(
    "/transcriptions/{transcription_id}/score.mid",
    response_class=Response,
    responses={200: {"content": {"audio/midi": {}}, "description": "A Standard MIDI File of format 1."}},
)
async def get_transcribed_score(work: Work) -> Response:
    """The score that was found: its seconds are the recording's, its beats and bars go through the onsets."""
    if work.midi is None:
        detail = "the search is still under way" if work.error is None else str(work.error)
        raise ProblemError(409, "no-notes", "There is no score", detail)
    return Response(work.midi, media_type="audio/midi", headers=attachment(work.title, "mid"))


@router.delete("/transcriptions/{transcription_id}", status_code=204)
async def end_transcription(work: Work, known: Known) -> None:
    """Give it up, and forget what was found."""
    known.end(work.id)
