"""Signing in and out, where uploads are for some people alone."""

from typing import Annotated

from fastapi import APIRouter, Body, Request, Response

from reina.api.http.access import People
from reina.api.http.body import BoundedRoute
from reina.api.http.sign_in import Person
from reina.protocol import resources

router = APIRouter(tags=["sign-in"], route_class=BoundedRoute, prefix="/sign-in")


def _told(people: People, person: Person | None) -> resources.SignIn:
    return resources.SignIn(
        needed=people.is_needed,
        asks=people.asks,
        signed_in=person is not None,
        name=None if person is None else person.name,
        by=None if person is None else person.by,
    )


@router.get("")
async def get_sign_in(request: Request, response: Response, people: People) -> resources.SignIn:
    """Whether uploads need a sign-in, by what, and who asks."""
    response.headers["Cache-Control"] = "no-store"
    return _told(people, people.person(request.scope))


@router.post("")
async def sign_in(
    request: Request, response: Response, people: People, given: Annotated[resources.Password, Body()]
) -> resources.SignIn:
    """Sign in by a password: the answer sets a cookie, which only the server can read.

    Five wrong ones within five minutes are taken from an address.
    """
    response.headers["Cache-Control"] = "no-store"
    return _told(people, await people.attempt(request.scope, given.name, given.password, response))


@router.delete("", status_code=204, response_class=Response)
async def sign_out(request: Request, response: Response, people: People) -> None:
    """Sign out: the cookie is taken back."""
    people.forget(request.scope, response)
