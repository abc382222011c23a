"""Every error leaves as problem details (RFC 9457)."""

from __future__ import annotations

from http import HTTPStatus
from typing import TYPE_CHECKING, Any

from fastapi.exceptions import RequestValidationError
from fastapi.responses import Response
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect
from starlette.routing import Match

from reina.api.http.request_id import instance
from reina.errors import InputError
from reina.instruments import CastError
from reina.music.errors import NotInScoreError, ScoreError, ScoreLimitError
from reina.protocol.resources import Fault, Problem
from reina.sessions.bus.bus import BusAwayError
from reina.sessions.limit_errors import (
    LimitError,
    NoRoomError,
    PieceTooLargeError,
    SenderLimitError,
    ServerBusyError,
)
from reina.sessions.session_edits import SessionEndedError
from reina.sessions.storage.errors import ChangedElsewhereError, DatabaseError, SessionDamagedError
from reina.sessions.storage.file_store import StoreAwayError, StoredFileLostError, StoreFullError
from reina.sessions.transcriptions import BusyError
from reina.show.errors import KeyNotFoundError, ShowError
from reina.sound.transcription.posteriors import NoRuntimeError
from reina.system.disk_room import NO_ROOM, is_disk_full
from reina.system.metrics import limit_hit

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from fastapi import FastAPI, Request
    from pydantic import ValidationError
    from starlette.routing import BaseRoute

KINDS = "urn:reina:problem:"
"""What the types of all problems begin with."""
LIMITS = frozenset({408, 413, 429, 431, 503, 507})
"""The statuses of who is refused because there is, or would be, too much of something."""
MEDIA_TYPE = "application/problem+json"
MAX_FAULTS = 20
"""So many are told of one request, and how many more there are."""
LONGEST_DETAIL = 2000
"""Characters of what was wrong; what was sent is repeated in part at most."""
LONGEST_LOCATION = 100
LONGEST_FAULT = 300
RETRY_AFTER_S = "5"
"""When what is away for the moment may be asked again, seconds."""
METHODS = ("GET", "POST", "PUT", "PATCH", "DELETE")
"""What an address may answer to of itself."""
READING = ("HEAD", "OPTIONS")
"""What it answers to besides."""


RESPONSES: dict[int | str, dict[str, Any]] = {
    "4XX": {"model": Problem, "description": "Why not, as problem details (RFC 9457)."}
}
"""What every route may answer with, for the description of the interface."""


class ProblemError(Exception):
    """A request that is refused.

    Args:
        status: HTTP status.
        kind: Stable name of the kind of problem, for programs: ``"unknown-session"``.
        title: The kind in a few words, for people.
        detail: What was wrong, where, and what would be right.
        errors: Each fault, where there are several.
        headers: Beside the content type.
    """

    def __init__(
        self,
        status: int,
        kind: str,
        title: str,
        detail: str,
        *,
        errors: Sequence[Fault] = (),
        headers: Mapping[str, str] | None = None,
    ) -> None:
        super().__init__(detail)
        self.status = status
        self.problem = Problem(
            type=f"{KINDS}{kind}",
            title=title,
            status=status,
            detail=_sendable(detail, LONGEST_DETAIL),
            errors=_told(errors),
        )
        self.headers = dict(headers or {})

    def response(self) -> Response:
        """The problem as a response."""
        if self.status in LIMITS:
            limit_hit(self.problem.type.removeprefix(KINDS))
        told = self.problem.model_copy(update={"instance": instance()})
        left_out = {"instance"} if told.instance is None else None
        return Response(
            told.model_dump_json(exclude=left_out), self.status, headers=self.headers, media_type=MEDIA_TYPE
        )


def _sendable(text: str, longest: int) -> str:
    """What came in, repeated in part, and without half a character (a lone surrogate), which is no UTF-8."""
    told = text[:longest].encode("utf-8", "backslashreplace").decode()
    return told if len(told) <= longest and len(text) <= longest else f"{told[: longest - 1]}…"


def _told(faults: Sequence[Fault]) -> list[Fault]:
    """The first of several faults."""
    return [
        Fault(
            detail=_sendable(fault.detail, LONGEST_FAULT),
            location=_sendable(fault.location or "", LONGEST_LOCATION) or None,
        )
        for fault in faults[:MAX_FAULTS]
    ]


def _in_words(faults: Sequence[Fault], count: int) -> str:
    """Several faults in one line, and how many more there are."""
    told: list[str] = []
    room = LONGEST_DETAIL - len(f"; and {count} more")
    for fault in _told(faults):
        words = f"{fault.location}: {fault.detail}" if fault.location else fault.detail
        room -= len(words) + 2
        if told and room < 0:
            break
        told.append(words)
    more = count - len(told)
    return "; ".join([*told, f"and {more} more"] if more > 0 else told)


INPUT_PROBLEMS: tuple[tuple[type[InputError], int, str, str], ...] = (
    (SessionEndedError, 404, "unknown-session", "There is no such session"),
    (ServerBusyError, 503, "busy", "The server has too much at hand"),
    (NoRoomError, 507, "no-room", "The server has no room for it"),
    (SenderLimitError, 429, "sender-limit", "You have as much here as one may have"),
    (PieceTooLargeError, 413, "piece-too-large", "The piece is larger than the server can play"),
    (ScoreLimitError, 413, "score-too-large", "The score is larger than Reina reads"),
    (NotInScoreError, 422, "not-in-score", "The score does not hold that"),
    (ScoreError, 422, "score-unreadable", "The score cannot be read"),
    (KeyNotFoundError, 404, "unknown-keyframe", "There is no such track or keyframe"),
    (CastError, 422, "cast-unusable", "The cast cannot play"),
    (ShowError, 422, "show-unusable", "The show cannot be used"),
    (NoRuntimeError, 501, "no-transcription", "The server cannot find notes yet"),
    (BusyError, 503, "transcription-busy", "The server is listening to other recordings"),
    (SessionDamagedError, 409, "session-damaged", "The session cannot be read"),
    (ChangedElsewhereError, 503, "busy", "The session is changed elsewhere all the time"),
    (BusAwayError, 503, "bus-away", "The servers cannot reach one another now"),
    (DatabaseError, 503, "database-away", "The sessions' database cannot be used now"),
    (StoreFullError, 507, "storage-full", "There is no room on the server's disk"),
    (StoreAwayError, 503, "files-away", "What keeps the large files does not answer"),
    (StoredFileLostError, 409, "file-lost", "A file of the session is lost"),
    (InputError, 422, "input-unusable", "The input cannot be used"),
)
"""What an input error is told as: the first row that fits."""


AWAY = (DatabaseError, StoreAwayError, BusAwayError, ChangedElsewhereError)
"""What is there again soon: it is said when to ask again."""


def storage_full(detail: str = NO_ROOM) -> ProblemError:
    """The problem of what needs room where there is none."""
    return problem_of_input(StoreFullError(detail))


def problem_of_input(error: InputError) -> ProblemError:
    """The problem that an input error is told as."""
    status, kind, title = next(
        (status, kind, title) for cls, status, kind, title in INPUT_PROBLEMS if isinstance(error, cls)
    )
    faults: list[Fault] = []
    if isinstance(error, ScoreError) and len(error.problems) > 1:
        faults = [Fault(detail=what, location=place) for place, what in error.problems]
    if isinstance(error, ShowError) and error.others:
        faults = [Fault(detail=each.detail, location=each.location) for each in (error, *error.others)]
    more = max(len(faults) - MAX_FAULTS, 0) + (error.more if isinstance(error, ShowError) else 0)
    detail = f"{str(error)[:LONGEST_FAULT]}; {more} more faults are not told" if more else str(error)
    headers = {"Retry-After": RETRY_AFTER_S} if isinstance(error, AWAY) else None
    if isinstance(error, LimitError) and error.retry_after_s is not None:
        headers = {"Retry-After": str(error.retry_after_s)}
    return ProblemError(status, kind, title, detail, errors=faults, headers=headers)


def _location(parts: Sequence[str | int]) -> str:
    """("body", "loop", "start_s") -> "body/loop/start_s"."""
    return "/".join(str(part) for part in parts)


def problem_of_validation(error: RequestValidationError | ValidationError) -> ProblemError:
    """The problem of fields that do not fit."""
    found: Sequence[Mapping[str, Any]] = error.errors()
    faults = [
        Fault(detail=str(fault["msg"]), location=_location(fault["loc"])) for fault in found[:MAX_FAULTS]
    ]
    detail = _in_words(faults, len(found))
    return ProblemError(422, "request-invalid", "The request does not fit", detail, errors=faults)


def _problem_of_status(error: HTTPException) -> ProblemError:
    phrase = HTTPStatus(error.status_code).phrase
    details = {
        404: "there is nothing at this address; /docs lists what there is",
        405: "this address does not answer to that method",
    }
    detail = details.get(error.status_code, str(error.detail))
    kind = phrase.lower().replace(" ", "-")
    return ProblemError(error.status_code, kind, phrase, detail, headers=error.headers)


def _not_answered(request: Request) -> Response:
    """To a method that an address does not have: which it has; OPTIONS asks for nothing else."""
    scope = {name: request.scope[name] for name in ("type", "path", "root_path", "headers")}
    routes: list[BaseRoute] = request.app.routes
    methods = {
        method
        for method in METHODS
        if any(route.matches({**scope, "method": method})[0] is Match.FULL for route in routes)
    }
    # HEAD is answered as GET is.
    methods |= {"OPTIONS"} | ({"HEAD"} if "GET" in methods else set())
    allow = {"Allow": ", ".join(sorted(methods))}
    if request.method == "OPTIONS":
        return Response(status_code=204, headers=allow)
    return _problem_of_status(HTTPException(405, headers=allow)).response()


def _asks_the_server(request: Request) -> bool:
    """Whether it is the server as a whole that is asked what it answers to (RFC 9110, 9.3.7)."""
    return request.method == "OPTIONS" and request.scope["path"] == "*"


def install(app: FastAPI) -> None:
    """Make the application answer every error so; what nobody expected is answered by `Observed`."""

    async def refused(request: Request, error: Exception) -> Response:
        match error:
            case ProblemError():
                return error.response()
            case InputError():
                return problem_of_input(error).response()
            case OSError() if is_disk_full(error):
                return storage_full().response()
            case RequestValidationError():
                return problem_of_validation(error).response()
            case ClientDisconnect():
                # Nobody hears it: the body broke off with the connection.
                return ProblemError(400, "broken-off", "Bad Request", "the body breaks off").response()
            case HTTPException(status_code=405):
                return _not_answered(request)
            case HTTPException(status_code=404) if _asks_the_server(request):
                return Response(status_code=204, headers={"Allow": ", ".join(sorted({*METHODS, *READING}))})
            case HTTPException():
                return _problem_of_status(error).response()
            case _:
                raise error

    for kind in (ProblemError, InputError, OSError, RequestValidationError, ClientDisconnect, HTTPException):
        app.add_exception_handler(kind, refused)
