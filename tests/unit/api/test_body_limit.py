"""Bodies that are too large, without a network."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

import pytest
from fastapi import FastAPI, Request

from reina.api import problems
from reina.api.body_limit import MOST_BYTES, BodyLimit

if TYPE_CHECKING:
    from starlette.types import Message

CHUNK = 1_000_000


def application() -> FastAPI:
    app = FastAPI()
    problems.install(app)
    app.add_middleware(BodyLimit)

    @app.post("/read")
    @app.post("/api/v1/sessions")
    async def read(request: Request) -> int:
        return len(await request.body())

    @app.post("/json")
    async def parse(body: dict[str, str]) -> int:
        return len(body)

    return app


def answer(path: str, size: int, *, declared: bool) -> tuple[int, int]:
    """Status, and how many bytes of the body were taken."""
    taken = 0
    statuses: list[int] = []

    async def receive() -> Message:
        nonlocal taken
        length = min(CHUNK, size - taken)
        taken += length
        return {"type": "http.request", "body": bytes(length), "more_body": taken < size}

    async def send(message: Message) -> None:
        if message["type"] == "http.response.start":
            statuses.append(message["status"])

    headers = [(b"content-type", b"application/json")]
    if declared:
        headers.append((b"content-length", str(size).encode()))
    scope = {"type": "http", "method": "POST", "path": path, "query_string": b"", "headers": headers}
    asyncio.run(application()(scope, receive, send))
    return statuses[0], taken


@pytest.mark.parametrize("path", ["/read", "/json"])
@pytest.mark.parametrize("declared", [True, False])
def test_a_body_that_is_too_large_is_not_read_on(path: str, declared: bool) -> None:
    status, taken = answer(path, 20 * MOST_BYTES, declared=declared)
    assert status == 413
    assert taken <= (0 if declared else MOST_BYTES + CHUNK)


def test_a_large_body_within_the_bound_is_read() -> None:
    assert answer("/read", MOST_BYTES, declared=False) == (200, MOST_BYTES)


def test_uploads_have_their_own_limits() -> None:
    assert answer("/api/v1/sessions", 2 * MOST_BYTES, declared=True) == (200, 2 * MOST_BYTES)
