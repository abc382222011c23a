"""Bodies that are too large or not wanted, without a network."""

from __future__ import annotations

import asyncio
import json
from typing import TYPE_CHECKING, Any

import pytest
from fastapi import APIRouter, FastAPI, Request
from fastapi.routing import iter_route_contexts

from reina.api.app import create_app
from reina.api.http import body, problems
from reina.api.http.body import AT_ONCE, BODY_LIMITS, SMALL, BoundedRoute
from reina.api.http.unread_body import READ_ON, UnreadBody
from reina.protocol.links import API

if TYPE_CHECKING:
    from starlette.types import Message

CHUNK = 500_000


def application() -> FastAPI:
    app = FastAPI()
    router = APIRouter(route_class=BoundedRoute)

    @router.put("/sessions/{session_id}/show")
    async def read(request: Request) -> int:
        return len(await request.body())

    @router.post("/sessions")
    async def unread() -> int:
        raise problems.ProblemError(403, "no", "No", "not here")

    @router.post("/json")
    async def parse(body: dict[str, Any]) -> int:
        return len(body)

    app.include_router(router, prefix=API)
    problems.install(app)
    app.add_middleware(UnreadBody)
    return app


class Sender:
    """Sends a body of a size, and hears the answer."""

    def __init__(self, content: bytes | int) -> None:
        self.content = bytes(content) if isinstance(content, int) else content
        self.taken = 0
        self.taken_before_answer: int | None = None
        self.status = 0
        self.answer = b""
        self.headers: dict[bytes, bytes] = {}

    def send(self, method: str, path: str, *, declared: bool = True) -> int:
        headers = [(b"content-type", b"application/json")]
        length = str(len(self.content)).encode()
        headers.append((b"content-length", length) if declared else (b"transfer-encoding", b"chunked"))
        scope = {
            "type": "http",
            "method": method,
            "path": API + path,
            "query_string": b"",
            "headers": headers,
        }
        asyncio.run(application()(scope, self._receive, self._send))
        return self.status

    async def _receive(self) -> Message:
        piece = self.content[self.taken : self.taken + CHUNK]
        self.taken += len(piece)
        return {"type": "http.request", "body": piece, "more_body": self.taken < len(self.content)}

    async def _send(self, message: Message) -> None:
        if message["type"] == "http.response.start":
            self.status, self.headers = message["status"], dict(message["headers"])
            self.taken_before_answer = self.taken
        self.answer += message.get("body", b"")


@pytest.mark.parametrize("declared", [True, False])
@pytest.mark.parametrize(
    ("method", "path", "most"),
    [("PUT", "/sessions/x/show", 20_000_000), ("POST", "/json", SMALL.most_bytes)],
)
def test_a_body_that_is_too_large_is_refused_as_soon_as_that_is_known(
    method: str, path: str, most: int, declared: bool
) -> None:
    sender = Sender(most + 3 * CHUNK)
    assert sender.send(method, path, declared=declared) == 413
    assert sender.taken_before_answer is not None
    assert sender.taken_before_answer <= (0 if declared else most + CHUNK)
    assert b"kB" in sender.answer or b"20 MB" in sender.answer


def test_a_body_within_its_bound_is_read() -> None:
    sender = Sender(20_000_000)
    assert sender.send("PUT", "/sessions/x/show", declared=False) == 200
    assert sender.answer == b"20000000"
    assert b"connection" not in sender.headers


def test_who_is_refused_hears_it_at_once_and_the_rest_is_taken_within_a_bound() -> None:
    sender = Sender(5 * CHUNK)
    assert sender.send("POST", "/sessions") == 403
    assert sender.taken_before_answer == 0
    assert sender.taken == 5 * CHUNK, "so that the sender comes to read"
    assert sender.headers[b"connection"] == b"close"
    endless = Sender(2 * READ_ON)
    assert endless.send("POST", "/sessions") == 403
    assert READ_ON < endless.taken <= READ_ON + CHUNK


def test_json_that_is_long_is_parsed_on_a_thread(monkeypatch: pytest.MonkeyPatch) -> None:
    moved: list[int] = []
    to_thread = asyncio.to_thread

    async def noted(work: Any, *arguments: Any) -> Any:
        moved.append(len(arguments[0]))
        return await to_thread(work, *arguments)

    monkeypatch.setattr(body.asyncio, "to_thread", noted)
    monkeypatch.setattr(body, "AT_ONCE", 100)
    assert Sender(json.dumps({"a": "x" * 50}).encode()).send("POST", "/json") == 200
    assert moved == []
    assert Sender(json.dumps({"a": "x" * 150}).encode()).send("POST", "/json") == 200
    assert moved == [159]
    assert SMALL.most_bytes <= AT_ONCE, "what is small is parsed where it is"


def test_fields_of_what_stands_within_a_long_body_are_counted_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(body, "AT_ONCE", 100)
    many = {f"x{n}": 1 for n in range(body.MOST_FIELDS + 1)}
    assert Sender(json.dumps({"a": [{"b": many}]}).encode()).send("POST", "/json") == 422
    few = Sender(json.dumps({"a": [dict(list(many.items())[1:])] * 3}).encode())
    assert few.send("POST", "/json") == 200


def test_every_route_that_takes_a_body_has_a_bound_and_every_bound_a_route() -> None:
    writing = {
        (method, context.path.removeprefix(API)): context.original_route
        for context in iter_route_contexts(create_app().routes)
        for method in (context.methods or set[str]()) - {"GET", "HEAD"}
        if context.path
    }
    assert writing
    assert [place for place, route in writing.items() if not isinstance(route, BoundedRoute)] == []
    assert set(BODY_LIMITS) <= set(writing)
