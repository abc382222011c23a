"""Every route of the description is sent what it does not expect: it refuses as a problem, or takes it."""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING, Any

import pytest
from tests.integration.scores import scale, song
from tests.integration.server import upload

from reina.api.app import create_app

if TYPE_CHECKING:
    from collections.abc import Iterator

    import httpx
    from tests.integration.server import Owned

PATHS: dict[str, dict[str, Any]] = create_app().openapi()["paths"]
METHODS = ("GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS", "TRACE", "PROPFIND")
SEGMENTS = ("%00", "%ff", "%2e%2e", "a" * 300, "%e6%9c%88", "%0d%0a", "-1", "%20", "%25")
VALUES = (
    "",
    "x",
    "-1",
    "nan",
    "inf",
    "-inf",
    "1e999",
    "9" * 30,
    "9" * 5000,
    "%00",
    "%ff",
    "true",
    "[]",
    "1&{}=2",
)
BODIES: tuple[tuple[str, bytes], ...] = (
    ("application/json", b""),
    ("application/json", b"{"),
    ("application/json", b"null"),
    ("application/json", b"[]"),
    ("application/json", b"{}"),
    ("application/json", b"\xff\xfe"),
    ("application/json", b"[" * 5000),
    ("application/json", b'{"\\ud800": NaN}'),
    ("application/json", b"9" * 5000),
    ("text/plain", b"x"),
    ("application/x-www-form-urlencoded", b"a=%ff"),
    ("multipart/form-data", b"x"),
    ("multipart/form-data; boundary=x", b"--x\r\nContent-Disposition: form-data\r\n\r\n\r\n--x--\r\n"),
    ("application/json; charset=utf-7", b"{}"),
    ("\u00ff", b"{}"),
)
FILLED = {
    "name": "trumpet",
    "file": "rig.json",
    "folder": "scores",
    "path": "camera/fov",
    "key": "k1",
    "rendering": "0123456789abcdef",
    "transcription_id": "0123456789abcdef",
    "number": "0",
    "revision": "0123456789abcdef",
}


@pytest.fixture(scope="module")
def watched(client: httpx.Client) -> Iterator[Owned]:
    session = upload(client, scale(), song=("song.wav", song()))
    yield session
    session.change("DELETE")


def names(path: str) -> list[str]:
    return re.findall(r"{(\w+)", path)


def filled(path: str, session: Owned, others: dict[str, str] | None = None) -> str:
    values = FILLED | {"session_id": session.id} | (others or {})
    return re.sub(r"{(\w+)[^}]*}", lambda match: values[match[1]], path)


def check(answer: httpx.Response, asked: object) -> None:
    assert answer.status_code < 500, (asked, answer.text)
    if answer.status_code < 400:
        return
    assert answer.headers["content-type"] == "application/problem+json", (asked, answer.status_code)
    if answer.request.method == "HEAD":
        return
    problem = answer.json()
    assert problem["status"] == answer.status_code, asked
    assert problem["type"].startswith("urn:reina:problem:"), asked
    assert problem["title"], asked
    assert len(problem["detail"]) > 10, asked


@pytest.mark.parametrize("path", PATHS)
def test_methods(client: httpx.Client, watched: Owned, path: str) -> None:
    operations: set[str] = {method.upper() for method in PATHS[path]}
    for method in METHODS:
        answer = client.request(method, filled(path, watched))
        check(answer, (method, path))
        answered = operations | {"OPTIONS", *(["HEAD"] if "GET" in operations else [])}
        assert (answer.status_code == 405) == (method not in answered), (method, path)
        if answer.status_code == 405:
            assert answer.headers["allow"] == ", ".join(sorted(answered)), (method, path)


@pytest.mark.parametrize("path", [path for path in PATHS if names(path)])
def test_segments(client: httpx.Client, watched: Owned, path: str) -> None:
    for method in PATHS[path]:
        for name in names(path):
            for segment in SEGMENTS:
                asked = filled(path, watched, {name: segment})
                check(client.request(method, asked, headers=watched.headers), (method, asked))


QUERIES = [
    (path, method, [entry["name"] for entry in operation.get("parameters", []) if entry["in"] == "query"])
    for path, operations in PATHS.items()
    for method, operation in operations.items()
]


@pytest.mark.parametrize(("path", "method", "asked"), [query for query in QUERIES if query[2]])
def test_queries(client: httpx.Client, watched: Owned, path: str, method: str, asked: list[str]) -> None:
    right = {"start_s": "0", "end_s": "0.1", "parameter": "camera/fov"}
    for name in asked:
        rest = "&".join(f"{other}={right[other]}" for other in asked if other in right and other != name)
        for value in VALUES:
            address = f"{filled(path, watched)}?{name}={value.format(name)}&{rest}"
            check(client.request(method, address, headers=watched.headers), (method, address[:200]))


@pytest.mark.parametrize(
    ("path", "method"),
    [
        (path, method)
        for path, operations in PATHS.items()
        for method in operations
        if method in {"post", "put", "patch"}
    ],
)
def test_bodies(client: httpx.Client, watched: Owned, path: str, method: str) -> None:
    address = filled(path, watched)
    for kind, body in BODIES:
        told = watched.headers | {"Content-Type": kind}
        headers = {name.encode(): value.encode("latin-1") for name, value in told.items()}
        answer = client.request(method, address, content=body, headers=headers)
        check(answer, (method, path, kind, body[:40]))
        if path.endswith("/control_token"):
            watched.body["control_token"] = answer.json()["control_token"]


def test_fields_of_an_upload(client: httpx.Client) -> None:
    form = PATHS["/api/v1/sessions"]["post"]["requestBody"]["content"]["multipart/form-data"]["schema"]
    fields = form["properties"].keys() - {"score", "song", "show"}
    assert "player" in fields
    for field in fields:
        for value in ("", "\x00", "..", "../trumpeter", "a" * 190, "nan", "9" * 10, "\u6708", json.dumps({})):
            files = {"score": ("a.mid", scale(2)), "song": ("s.wav", song(0.1))}
            answer = client.post("/api/v1/sessions", files=files, data={field: value})
            check(answer, (field, value))
            if answer.status_code == 201:
                token = {"Authorization": f"Bearer {answer.json()['control_token']}"}
                client.delete(f"/api/v1/sessions/{answer.json()['id']}", headers=token).raise_for_status()
