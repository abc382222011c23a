"""Who may what: watching needs a session's id, changing it needs its control token, or to be its owner.

Uploads are for everybody, unless the server was started to ask who somebody is.
"""

from collections.abc import AsyncGenerator
from typing import Annotated

from fastapi import Depends, Path, Request
from fastapi.dependencies.models import Dependant
from fastapi.security import APIKeyCookie, HTTPAuthorizationCredentials, HTTPBearer

from reina.api.http.problems import ProblemError
from reina.api.http.sign_in import COOKIE, Person, SignIn
from reina.api.settings import Settings
from reina.sessions.session import Session
from reina.sessions.storage.errors import SessionDamagedError
from reina.sessions.store import SessionStore
from reina.system.tokens import token_matches

_bearer = HTTPBearer(
    auto_error=False, scheme_name="control_token", description="Of the session, told at its creation."
)


_cookie = APIKeyCookie(
    auto_error=False,
    name=COOKIE,
    scheme_name="sign_in",
    description="Of who is signed in, where the server asks for that; `GET /api/v1/sign-in` says whether.",
)


def _store(request: Request) -> SessionStore:
    store: SessionStore = request.app.state.store
    return store


def _settings(request: Request) -> Settings:
    settings: Settings = request.app.state.settings
    return settings


def _people(request: Request) -> SignIn:
    people: SignIn = request.app.state.sign_in
    return people


def _uploader(request: Request, _: Annotated[str | None, Depends(_cookie)] = None) -> Person | None:
    return _people(request).require(request.scope)


People = Annotated[SignIn, Depends(_people)]
Uploader = Annotated[Person | None, Depends(_uploader)]
"""Who uploads; None where the server does not ask."""
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


async def _found(session_id: str, store: SessionStore) -> Session:
    session = await store.get(session_id)
    if session is None:
        raise unknown_session(session_id)
    return session


async def _watched(request: Request, session_id: SessionId, store: Store) -> AsyncGenerator[Session]:
    session = await _found(session_id, store)
    credentials = await _bearer(request)
    if credentials is not None and token_matches(session.record.token_sha256, credentials.credentials):
        store.sightings.note(session.id)
    with session.asked():
        yield session


Watched = Annotated[Session, Depends(_watched)]
"""The session of the path, for everybody who has its id."""


def is_owner(request: Request, session: Session) -> bool:
    """Whether who asks is signed in as the person whose session it is."""
    owner = session.record.owner
    if owner is None:
        return False
    person = _people(request).person(request.scope)
    return person is not None and person.name == owner


async def _controlled(
    request: Request,
    session: Watched,
    credentials: Annotated[HTTPAuthorizationCredentials | None, Depends(_bearer)],
) -> Session:
    if not is_owner(request, session):
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
            "the token is another session's or mistyped, or has been made anew since",
        )


Controlled = Annotated[Session, Depends(_controlled)]
"""The session of the path, for who has its control token, and for the person whose it is."""


async def _doomed(
    request: Request,
    session_id: SessionId,
    store: Store,
    credentials: Annotated[HTTPAuthorizationCredentials | None, Depends(_bearer)],
) -> AsyncGenerator[Session | SessionDamagedError]:
    session: Session | SessionDamagedError
    try:
        session = await _found(session_id, store)
    except SessionDamagedError as damaged:
        session = damaged
    if isinstance(session, SessionDamagedError):
        _require_token(session.token_sha256, credentials)
        yield session
        return
    if not is_owner(request, session):
        _require_token(session.record.token_sha256, credentials)
    with session.asked():
        yield session


Doomed = Annotated[Session | SessionDamagedError, Depends(_doomed)]
"""The session of the path, to be ended by who has its control token, whether it can be read or not."""


async def admit(request: Request, dependant: Dependant) -> None:
    """Refuse whoever a route's session is not there for, before anything of the request's body is read.

    Args:
        request: What was asked.
        dependant: What the route depends on: on a session that may be watched or controlled, on somebody who
            may upload, or on none.

    Raises:
        ProblemError: As the route itself would.
    """
    needed = {dependency.call for dependency in dependant.dependencies}
    if _uploader in needed:
        _uploader(request)
    if not needed & {_watched, _controlled}:
        return
    session = await _found(request.path_params["session_id"], _store(request))
    if _controlled in needed:
        await _controlled(request, session, await _bearer(request))
