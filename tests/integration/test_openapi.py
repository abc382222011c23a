"""The description of the HTTP interface, and its examples against the server itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

import pytest
from tests.integration.scores import scale, song
from tests.integration.server import upload

from reina.api.app import create_app
from reina.show import EDITS

if TYPE_CHECKING:
    from collections.abc import Iterator

    import httpx
    from tests.integration.server import Owned

DOCUMENT: dict[str, Any] = create_app().openapi()
METHODS = ("get", "put", "post", "patch", "delete")
SESSION = "/api/v1/sessions/{session_id}"
PREVIEW = f"{SESSION}/show/curves"
"""Is sent a track, and keeps nothing of it."""


def operations() -> list[tuple[str, str, dict[str, Any]]]:
    return [
        (path, method, operation)
        for path, item in DOCUMENT["paths"].items()
        for method, operation in item.items()
        if method in METHODS
    ]


def examples_of(content: dict[str, Any]) -> dict[str, Any]:
    """A request body's examples by name, wherever the description may put them."""
    named = {name: entry["value"] for name, entry in content.get("examples", {}).items()}
    if "example" in content:
        named["example"] = content["example"]
    listed: list[Any] = content.get("schema", {}).get("examples", [])
    return named | {f"example {number}": value for number, value in enumerate(listed, start=1)}


BODIES = [
    (path, method, name, value)
    for path, method, operation in operations()
    for name, value in examples_of(
        operation.get("requestBody", {}).get("content", {}).get("application/json", {})
    ).items()
    if path.startswith(SESSION)
]


@pytest.fixture(scope="module")
def shown(client: httpx.Client) -> Iterator[Owned]:
    session = upload(client, scale(), song=("song.wav", song()))
    yield session
    session.change("DELETE")


@pytest.mark.parametrize(
    ("path", "method", "name", "value"), BODIES, ids=[f"{m} {p} {n}" for p, m, n, _ in BODIES]
)
def test_an_example_can_be_sent_as_it_stands(
    shown: Owned, path: str, method: str, name: str, value: Any
) -> None:
    below = path.removeprefix(SESSION)
    operation = DOCUMENT["paths"][path][method]
    for parameter in operation["parameters"]:
        if parameter["in"] == "path" and parameter["name"] != "session_id":
            example = parameter.get("example", parameter["schema"].get("examples", [None])[0])
            below = below.replace(f"{{{parameter['name']}}}", str(example))
    if method == "patch" and "{key}" in path:
        # What is changed has to be there: the example of adding it is sent first.
        added = next(value for p, m, _, value in BODIES if m == "post" and f"{p}/{{key}}" == path)
        shown.change("DELETE", below)
        shown.change("POST", below.rsplit("/", 1)[0], json=added).raise_for_status()
    elif method == "post" and below.endswith("/keyframes"):
        shown.change("DELETE", below.removesuffix("/keyframes"))
    elif below == "" and "part" in value:
        value = {**value, "part": 0}  # this score has one
    query = {"start_s": 0, "end_s": 4} if path == PREVIEW else {}
    answer = shown.change(method.upper(), below, json=value, params=query)
    expected = next(int(status) for status in operation["responses"] if status.startswith("2"))
    assert answer.status_code == expected, answer.text


def test_every_body_in_json_has_an_example() -> None:
    without = [
        f"{method} {path}"
        for path, method, operation in operations()
        if "application/json" in (content := operation.get("requestBody", {}).get("content", {}))
        and path.startswith(SESSION)
        and not examples_of(content["application/json"])
    ]
    assert without == []
    assert {method for _, method, _, _ in BODIES} == {"post", "put", "patch"}


def test_every_operation_says_what_it_does_and_how_it_fails() -> None:
    for path, method, operation in operations():
        assert operation.get("description"), f"{method} {path}"
        assert "application/problem+json" in operation["responses"]["4XX"]["content"], f"{method} {path}"


def test_what_changes_a_session_says_that_it_needs_the_token() -> None:
    for path, method, operation in operations():
        needs = {"control_token": []} in operation.get("security", [])
        assert needs == (path.startswith(SESSION) and method != "get"), f"{method} {path}"


def test_what_takes_an_upload_says_that_a_server_may_ask_who_sends_it() -> None:
    asked = {path: operation.get("security") for path, method, operation in operations() if method == "post"}
    for path in ("/api/v1/sessions", "/api/v1/transcriptions"):
        assert asked[path] == [{}, {"sign_in": []}]


def test_what_changes_a_show_takes_a_condition() -> None:
    conditional = {
        (path, method)
        for path, method, operation in operations()
        if any(parameter["name"] == "if-match" for parameter in operation.get("parameters", []))
    }
    assert conditional == {
        (path, method)
        for path, method, _ in operations()
        if path.startswith(f"{SESSION}/show") and method != "get" and path != PREVIEW
    }


def test_conditions_are_described_and_hold(shown: Owned) -> None:
    described = 0
    for path, method, operation in operations():
        taken = {parameter["name"] for parameter in operation.get("parameters", [])}
        assert ("if-match" in taken) == ("412" in operation["responses"]), f"{method} {path}"
        assert ("if-none-match" in taken) == ("304" in operation["responses"]), f"{method} {path}"
        described += "412" in operation["responses"]
    assert described >= 9
    answer = shown.client.get(f"{shown.path}/show", headers={"If-None-Match": "*"})
    assert (answer.status_code, answer.content) == (304, b"")


def test_every_kind_of_edit_has_an_example_and_a_schema() -> None:
    content = DOCUMENT["paths"][f"{SESSION}/show/edits"]["post"]["requestBody"]["content"]["application/json"]
    components = DOCUMENT["components"]["schemas"]
    assert content["schema"]["items"] == {"$ref": "#/components/schemas/Edit"}
    references: dict[str, str] = components["Edit"]["discriminator"]["mapping"]
    assert set(references) == set(EDITS) == {edit["edit"] for edit in content["example"]}
    for edit in content["example"]:
        schema = components[references[edit["edit"]].rsplit("/", 1)[-1]]
        assert set(schema["required"]) <= set(edit) <= set(schema["properties"])


def test_every_reference_leads_somewhere() -> None:
    def references(value: Any) -> list[str]:
        if isinstance(value, list):
            return [found for item in cast("list[Any]", value) for found in references(item)]
        if not isinstance(value, dict):
            return []
        fields = cast("dict[str, Any]", value)
        own = [fields["$ref"]] if isinstance(fields.get("$ref"), str) else []
        return own + [found for item in fields.values() for found in references(item)]

    known = {f"#/components/schemas/{name}" for name in DOCUMENT["components"]["schemas"]}
    found = set(references(DOCUMENT))
    assert "#/components/schemas/ShowDocument" in found
    assert found <= known
