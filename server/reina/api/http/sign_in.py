"""Who asks: known by a password or by a proxy where the server was started so; else nobody is told apart."""

from __future__ import annotations

import asyncio
import time
from dataclasses import dataclass
from http.cookies import CookieError, SimpleCookie
from typing import TYPE_CHECKING, Literal

from reina.api.accounts import LONGEST_PASSWORD, Accounts
from reina.api.http.attempts import Attempts
from reina.api.http.problems import ProblemError
from reina.api.http.proxies import client_address, comes_by_proxy, is_secure, only_header
from reina.api.http.signed_cookie import claimed, is_sealed, sealed
from reina.api.signing_key import signing_key

if TYPE_CHECKING:
    from collections.abc import Callable

    from starlette.responses import Response
    from starlette.types import Scope

    from reina.api.accounts import Account
    from reina.api.settings import Settings

COOKIE, SECURE_COOKIE = "reina-sign-in", "__Host-reina-sign-in"
"""By TLS it has a name that no other host, nor a page without TLS, can set."""
KEPT_S = 30 * 24 * 3600
LONGEST_NAME = 200
MOST_WAITING = 16
"""So many passwords are looked at one after the other; of each the next takes a tenth of a second."""


@dataclass(frozen=True)
class Person:
    """Somebody who is signed in.

    Attributes:
        name: Who it is; None where all have one password.
        by: What says so.
    """

    name: str | None
    by: Literal["password", "proxy"]


class SignIn:
    """Tells who asks.

    Args:
        settings: Whether there are passwords or a proxy, and which.
        now: Seconds; never goes back.
    """

    def __init__(self, settings: Settings, now: Callable[[], float]) -> None:
        path = settings.upload_password_file
        self._accounts = None if path is None else Accounts.read(path)
        self._key = b"" if path is None else signing_key(settings.data_dir, settings.signing_key_file)
        self._header = settings.user_header.lower().encode()
        self._attempts = Attempts(now)
        self._looking = asyncio.Lock()
        self._waiting = 0

    @property
    def is_needed(self) -> bool:
        """Whether uploads are for those alone who are signed in."""
        return self._accounts is not None or bool(self._header)

    @property
    def asks(self) -> Literal["password", "name-and-password", "proxy"] | None:
        """By what somebody signs in."""
        if self._accounts is not None:
            return "name-and-password" if self._accounts.have_names else "password"
        return "proxy" if self._header else None

    def person(self, scope: Scope) -> Person | None:
        """Who asks; None where that is not known."""
        if self._header and comes_by_proxy(scope):
            name = only_header(scope, self._header)
            if name and len(name) <= LONGEST_NAME and name.isprintable():
                return Person(name, "proxy")
        return self._remembered(scope)

    def require(self, scope: Scope) -> Person | None:
        """Who asks, where that has to be known.

        Raises:
            ProblemError: 401, it is not.
        """
        person = self.person(scope)
        if person is None and self.is_needed:
            raise not_signed_in()
        return person

    async def attempt(self, scope: Scope, name: str | None, password: str, response: Response) -> Person:
        """Let somebody in by a password, and have the browser keep that.

        Args:
            scope: Of the request.
            name: Whose password it is said to be.
            password: The password.
            response: Gets the cookie, which no script of a page can read.

        Raises:
            ProblemError: 401, it is wrong; 404, there are no passwords; 429, too many were tried.
        """
        accounts = self._accounts
        if accounts is None:
            raise ProblemError(
                404, "no-sign-in", "Nobody signs in here", "the server was started without passwords"
            )
        address = client_address(scope)
        if self._waiting >= MOST_WAITING:
            raise ProblemError(
                429,
                "too-many-attempts",
                "Too many passwords are tried",
                "others sign in at this moment; try again in a few seconds",
                headers={"Retry-After": "3"},
            )
        self._attempts.begin(address)
        self._waiting += 1
        try:
            async with self._looking:
                tried = password[: LONGEST_PASSWORD + 1]
                account = await asyncio.to_thread(accounts.admitted, name, tried)
        finally:
            self._waiting -= 1
        if account is None:
            raise ProblemError(
                401,
                "wrong-password",
                "The password is wrong",
                "name or password is wrong" if accounts.have_names else "this is not the server's password",
                headers={"WWW-Authenticate": "Reina"},
            )
        self._attempts.succeeded(address)
        self._give(scope, account, response)
        return Person(account.name, "password")

    def _give(self, scope: Scope, account: Account, response: Response) -> None:
        said = {"name": account.name, "until": int(time.time()) + KEPT_S}
        secure = is_secure(scope)
        response.set_cookie(
            SECURE_COOKIE if secure else COOKIE,
            sealed(self._key, said, account.line),
            max_age=KEPT_S,
            path="/",
            secure=secure,
            httponly=True,
            samesite="strict",
        )

    def forget(self, scope: Scope, response: Response) -> None:
        """Have the browser forget who was let in."""
        secure = is_secure(scope)
        response.delete_cookie(
            SECURE_COOKIE if secure else COOKIE, path="/", secure=secure, httponly=True, samesite="strict"
        )

    def _remembered(self, scope: Scope) -> Person | None:
        if self._accounts is None:
            return None
        kept = _cookie(scope, SECURE_COOKIE if is_secure(scope) else COOKIE)
        said = None if kept is None else claimed(kept)
        if kept is None or said is None:
            return None
        name, until = said.get("name"), said.get("until")
        if not (name is None or isinstance(name, str)) or not isinstance(until, int):
            return None
        account = self._accounts.of(name)
        if account is None or not is_sealed(self._key, kept, account.line) or until < time.time():
            return None
        return Person(account.name, "password")


def not_signed_in() -> ProblemError:
    """The problem of something that only people do who are signed in."""
    return ProblemError(
        401,
        "sign-in-needed",
        "Sign in first",
        "this server takes uploads from people who are signed in: by `POST /api/v1/sign-in`, or by the proxy "
        "before it, as `GET /api/v1/sign-in` says",
        headers={"WWW-Authenticate": "Reina"},
    )


def _cookie(scope: Scope, name: str) -> str | None:
    header = only_header(scope, b"cookie")
    if header is None:
        return None
    try:
        morsel = SimpleCookie(header).get(name)
    except CookieError:
        return None
    return None if morsel is None else morsel.value
