"""What a file is, asked over HTTP; the file that a session was made of; what is sent as what it is not."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import pytest
from tests.integration.scores import scale, show, song

if TYPE_CHECKING:
    import httpx
    from tests.integration.server import Owned

TONE = json.dumps({"tracks": [{"notes": [{"midi": 60, "time": 0, "duration": 1}]}]}).encode()


@pytest.mark.parametrize(
    ("data", "name", "role"),
    [
        (TONE, "a.json", "score"),
        (show(), "a.json", "show"),
        (song(), "a.mid", "song"),
        (b"%PDF", "a.mid", None),
    ],
)
def test_the_server_says_what_a_file_is(
    client: httpx.Client, data: bytes, name: str, role: str | None
) -> None:
    answer = client.post("/api/v1/files/role", params={"filename": name}, content=data).raise_for_status()
    told = answer.json()
    assert told["role"] == role
    assert told["name"]
    assert (told["advice"] == "") == (role is not None)


def test_no_more_than_a_beginning_is_taken(client: httpx.Client) -> None:
    answer = client.post("/api/v1/files/role", content=bytes(1_000_001))
    assert (answer.status_code, answer.json()["type"]) == (413, "urn:reina:problem:file-too-large")


def test_the_score_comes_back_as_it_was_sent(client: httpx.Client, owned: Owned) -> None:
    answer = client.get(f"/api/v1/sessions/{owned.id}/score/file").raise_for_status()
    assert answer.content == scale()
    assert answer.headers["content-type"] == "application/octet-stream"
    assert client.get(f"/api/v1/sessions/{'x' * 22}/score/file").status_code == 404


@pytest.mark.parametrize(
    ("files", "told"),
    [
        ({"score": ("a.json", show())}, "this is a show; send it as the show, beside a score"),
        ({"score": ("a.mid", scale()), "show": ("s.json", TONE)}, "this is a score in JSON, not a show"),
        ({"score": ("a.mid", scale()), "show": ("s.json", scale())}, "this is a MIDI file, not a show"),
    ],
)
def test_what_is_sent_as_another_kind_is_named(
    client: httpx.Client, files: dict[str, tuple[str, bytes]], told: str
) -> None:
    answer = client.post("/api/v1/sessions", files=files)
    assert answer.status_code == 422
    assert told in answer.json()["detail"]
