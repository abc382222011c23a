"""The description of the HTTP interface (OpenAPI), where FastAPI's own is not quite right."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from reina.api.problems import MEDIA_TYPE

if TYPE_CHECKING:
    from fastapi import FastAPI


def describe(app: FastAPI) -> None:
    """Have the application describe its errors with the media type that they are sent with."""
    generate = app.openapi

    def openapi() -> dict[str, Any]:
        document = generate()
        for operations in document["paths"].values():
            for operation in operations.values():
                problem: dict[str, Any] = operation["responses"].get("4XX", {})
                # FastAPI gives it the media type of the route's good answers.
                if "content" in problem:
                    (body,) = problem["content"].values()
                    problem["content"] = {MEDIA_TYPE: body}
        return document

    app.openapi = openapi
