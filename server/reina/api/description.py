"""The description of the HTTP interface (OpenAPI), where FastAPI's own is not quite right."""

from __future__ import annotations

import asyncio
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from fastapi.responses import Response
from pydantic import TypeAdapter
from starlette.routing import Route

from reina.api.http.conditions import IF_NONE_MATCH_TEXT
from reina.api.http.problems import MEDIA_TYPE
from reina.api.sessions import session_form
from reina.show.document import ShowDocument
from reina.show.edits import Edit
from reina.system.json_text import json_text

if TYPE_CHECKING:
    from fastapi import FastAPI, Request

IF_NONE_MATCH: dict[str, Any] = {
    "name": "if-none-match",
    "in": "header",
    "required": False,
    "description": IF_NONE_MATCH_TEXT,
    "schema": {"anyOf": [{"type": "string"}, {"type": "null"}], "title": "If-None-Match"},
}


OPENAPI = "/openapi.json"
SIGNED_IN: dict[str, list[str]] = {"sign_in": []}


@dataclass(frozen=True)
class Made:
    """What a POST makes: the answer's field that names it, and the path parameter that takes the name."""

    field: str
    parameter: str
    status: str = "201"


MAKERS = {
    "/api/v1/sessions": Made("id", "session_id"),
    "/api/v1/sessions/{session_id}/stances": Made("name", "name"),
    "/api/v1/sessions/{session_id}/show/tracks/{path}/keyframes": Made("key", "key"),
    "/api/v1/transcriptions": Made("id", "transcription_id", "202"),
}


def describe(app: FastAPI) -> None:
    """Have the application describe its errors with the media type that they are sent with.

    It is described once, on a thread, since that takes a second: FastAPI would on the event loop.
    """
    generate = app.openapi
    made: list[bytes] = []
    making = asyncio.Lock()

    async def answer(_: Request) -> Response:
        async with making:
            if not made:
                made.append(await asyncio.to_thread(lambda: json_text(app.openapi())))
        return Response(made[0], media_type="application/json")

    app.router.routes = [route for route in app.router.routes if getattr(route, "path", "") != OPENAPI]
    app.router.routes.insert(0, Route(OPENAPI, answer, include_in_schema=False))

    def openapi() -> dict[str, Any]:
        document = generate()
        document["components"]["schemas"] |= _show_schemas()
        for operations in document["paths"].values():
            for method, operation in operations.items():
                responses: dict[str, Any] = operation["responses"]
                problem: dict[str, Any] = responses.get("4XX", {})
                # FastAPI gives it the media type of the route's good answers.
                if "content" in problem:
                    (body,) = problem["content"].values()
                    problem["content"] = {MEDIA_TYPE: body}
                if method == "get":
                    _add_if_none_match(operation)
                _describe_conditions(operation, problem)
                if (security := operation.get("security")) == [SIGNED_IN]:
                    # FastAPI cannot say that a server may ask for it, and need not.
                    security.insert(0, {})
        # It follows from a model's schema, which takes a while: not when the route is declared.
        document["paths"]["/api/v1/sessions"]["post"].update(session_form())
        _describe_links(document["paths"])
        return document

    app.openapi = openapi


def _describe_links(paths: dict[str, Any]) -> None:
    """Say what is made where, and which calls take its name then (OpenAPI's links)."""
    for maker, made in MAKERS.items():
        links: dict[str, Any] = {}
        for path, operations in paths.items():
            if not path.startswith(f"{maker}/{{{made.parameter}}}"):
                continue
            given = {name: f"$request.path.{name}" for name in _names(maker)}
            for operation in operations.values():
                links[operation["operationId"]] = {
                    "operationId": operation["operationId"],
                    "parameters": {**given, made.parameter: f"$response.body#/{made.field}"},
                }
        paths[maker]["post"]["responses"][made.status]["links"] = links


def _names(path: str) -> list[str]:
    return re.findall(r"{(\w+)", path)


def _show_schemas() -> dict[str, Any]:
    """What is read when it is known what it is for: shows, tracks, edits."""
    described = TypeAdapter(Edit | ShowDocument).json_schema(ref_template="#/components/schemas/{model}")
    definitions: dict[str, Any] = described["$defs"]
    definitions["Edit"] = TypeAdapter(Edit).json_schema(ref_template="#/components/schemas/{model}")
    del definitions["Edit"]["$defs"]
    return definitions


def _add_if_none_match(operation: dict[str, Any]) -> None:
    """Which every GET takes, whether its route looks at it or not."""
    parameters: list[dict[str, Any]] = operation.setdefault("parameters", [])
    if all(parameter["name"] != IF_NONE_MATCH["name"] for parameter in parameters):
        parameters.append(dict(IF_NONE_MATCH))


def _describe_conditions(operation: dict[str, Any], problem: dict[str, Any]) -> None:
    """What the answer to a conditional request may be (RFC 9110, 13)."""
    taken = {parameter["name"] for parameter in operation.get("parameters", [])}
    responses: dict[str, Any] = operation["responses"]
    if not taken & {"if-match", "if-none-match"}:
        return
    for status, response in responses.items():
        if status.startswith("2"):
            response.setdefault("headers", {})["ETag"] = {
                "description": "The validator of what is answered, for conditions.",
                "schema": {"type": "string"},
            }
    if "if-none-match" in taken:
        responses["304"] = {"description": "It is still what `If-None-Match` names; there is no body."}
    if "if-match" in taken:
        responses["412"] = {**problem, "description": "It has changed since; nothing was changed by this."}
