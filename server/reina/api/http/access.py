"""Who may what: watching needs a session's id, changing it needs its control token."""

from typing import Annotated

from fastapi import Depends, Path, Request
from fastapi.dependencies.models import Dependant
from fastapi.security import HTTPAuthorizationCredentials, HTTPBearer

from reina.api.http.problems import ProblemError
from reina.api.settings import Settings
from reina.sessions.session import Session
from reina.sessions.storage.errors import SessionDamagedError
from reina.sessions.store import SessionStore
from reina.system.tokens import token_matches

_bearer = HTTPBearer(
    auto_error=False, scheme_name="control_token", description="Of the session, told at its creation."
)


def _store(request: Request) -> SessionStore:
    store: SessionStore = request.app.state.store
    return store


def _settings(request: Request) -> Settings:
    settings: Settings = request.app.state.settings
    return settings


Store = Annotated[SessionStore, Depends(_store)]
ServerSettings = Annotated[Settings, Depends(_settings)]
SessionId = Annotated[str, Path(description="The session's id.", examples=["q3Zt0bXJ5V2mC9yLk7wH1A"])]


def unknown_session(session_id: str) -> ProblemError:
    """The problem of a session that is not there."""
    return ProblemError(
        404,
        "unknown-session",
        "There is no such session",
        f"no session has the id {session_id!r}; it may have been ended",
    )


async def _watched(session_id: SessionId, store: Store) -> Session:
    session = await store.get(session_id)
    if session is None:
        raise unknown_session(session_id)
    return session


Watched = Annotated[Session, Depends(_watched)]
"""The session of the path, for everybody who has its id."""


async def _controlled(
    session: Watched, credentials: Annotated[HTTPAuthorizationCredentials | None, Depends(_bearer)]
) -> Session:
    _require_token(session.record.token_sha256, credentials)
    return session


def _require_token(token_sha256: str, credentials: HTTPAuthorizationCredentials | None) -> None:
    if credentials is None:
        raise ProblemError(
            401,
            "no-token",
            "This needs the session's control token",
            "send `Authorization: Bearer <control_token>`; the token was told when the session was made",
            headers={"WWW-Authenticate": "Bearer"},
        )
    if not token_matches(token_sha256, credentials.credentials):
        raise ProblemError(
            403,
            "wrong-token",
            "This is not the session's control token",
            "the token is another session's or mistyped",
        )


Controlled = Annotated[Session, Depends(_controlled)]
"""The session of the path, for who has its control token."""


async def _doomed(
    session_id: SessionId,
    store: Store,
    credentials: Annotated[HTTPAuthorizationCredentials | None, Depends(_bearer)],
) -> Session | SessionDamagedError:
    try:
        session = await _watched(session_id, store)
    except SessionDamagedError as damaged:
        _require_token(damaged.token_sha256, credentials)
        return damaged
    return await _controlled(session, credentials)


Doomed = Annotated[Session | SessionDamagedError, Depends(_doomed)]
"""The session of the path, to be ended by who has its control token, whether it can be read or not."""


async def admit(request: Request, dependant: Dependant) -> None:
    """Refuse whoever a route's session is not there for, before anything of the request's body is read.

    Args:
        request: What was asked.
        dependant: What the route depends on: on a session that may be watched or controlled, or on none.

    Raises:
        ProblemError: As the route itself would.
    """
    needed = {dependency.call for dependency in dependant.dependencies}
    if not needed & {_watched, _controlled}:
        return
    session = await _watched(request.path_params["session_id"], _store(request))
    if _controlled in needed:
        await _controlled(session, await _bearer(request))
