"""Bodies are read strictly: true is no number, nor is "3", and 1 is not true."""

from __future__ import annotations

import asyncio
import json
from typing import TYPE_CHECKING, Any

import pytest
import websockets
from tests.integration.scores import scale

if TYPE_CHECKING:
    import httpx
    from tests.integration.server import Owned, Running

ORIENTATION = {"kind": "quaternion", "quaternion": [0, 0, 0, 1]}
CHOICE = {"solver": "ccd"}
WRONG: list[tuple[str, str, dict[str, Any]]] = [
    ("POST", "/transport", {"action": "seek", "song_time_s": True}),
    ("POST", "/transport", {"action": "seek", "song_time_s": "1"}),
    ("POST", "/transport", {"action": "rate", "rate": True}),
    ("POST", "/transport", {"action": "play", "count_in_s": "1"}),
    ("POST", "/transport", {"action": "loop", "start_s": False, "end_s": True}),
    ("PATCH", "", {"public": 1}),
    ("PATCH", "", {"public": "yes"}),
    ("PATCH", "", {"part": "0"}),
    ("PATCH", "", {"part": False}),
    ("PATCH", "", {"transposition": True}),
    ("PATCH", "", {"joined_parts": ["1"]}),
    ("PATCH", "", {"written": "true"}),
    ("PUT", "/cast", {"castings": [{"part": True}]}),
    ("PUT", "/cast", {"castings": [{"transposition": "2"}]}),
    ("PUT", "/cast", {"castings": [{"octave_fit": 1}]}),
    ("PUT", "/cast", {"cast": "auto", "sequence": "0"}),
    ("PUT", "/alignment", {"offset_s": True}),
    ("PUT", "/alignment", {"anchors": [{"score_s": "0", "song_s": 1}]}),
]
LAB: list[tuple[str, dict[str, Any]]] = [
    ("interpolations", {"start": ORIENTATION, "end": {**ORIENTATION, "quaternion": [True, 0, 0, 1]}}),
    ("interpolations", {"start": ORIENTATION, "end": ORIENTATION, "samples": "9"}),
    ("interpolations", {"start": ORIENTATION, "end": ORIENTATION, "tip": ["1", 0, 0]}),
    ("inverse", {"chain": "rightIndex", "target": ["0", 0, 0], "choice": CHOICE}),
    ("inverse", {"chain": "rightIndex", "target": [0, 0, 0], "choice": CHOICE, "start_rad": [True]}),
    ("reach", {"chain": "rightIndex", "through": [0, 0, 0], "choice": {**CHOICE, "iterations": True}}),
    ("reach", {"chain": "rightIndex", "through": [0, 0, 0], "choice": {**CHOICE, "limits": 1}}),
    ("forward", {"chain": "rightIndex", "angles_rad": ["0"]}),
]


def refused(answer: httpx.Response) -> None:
    assert answer.status_code == 422, answer.text
    assert answer.json()["type"] == "urn:reina:problem:request-invalid"


@pytest.mark.parametrize(("method", "below", "body"), WRONG)
def test_what_changes_a_session(owned: Owned, method: str, below: str, body: dict[str, Any]) -> None:
    refused(owned.change(method, below, json=body))


@pytest.mark.parametrize(("call", "body"), LAB)
def test_what_the_laboratory_is_asked(client: httpx.Client, call: str, body: dict[str, Any]) -> None:
    refused(client.post(f"/api/v1/lab/{call}", json=body))


def test_whole_numbers_and_lists_are_what_they_were(owned: Owned, client: httpx.Client) -> None:
    assert owned.control("seek", song_time_s=1)["song_time_s"] == 1.0
    assert owned.change("PATCH", "", json={"transposition": 2, "joined_parts": []}).status_code == 200
    body = {"start": ORIENTATION, "end": {**ORIENTATION, "quaternion": [0, 1, 0, 0]}, "tip": [0, 1, 0]}
    assert client.post("/api/v1/lab/interpolations", json=body).status_code == 200


@pytest.mark.parametrize("cast", ['{"castings": [{"part": "0"}]}', '{"castings": [{"written": 0}]}'])
def test_the_cast_of_a_form(client: httpx.Client, cast: str) -> None:
    refused(client.post("/api/v1/sessions", files={"score": ("s.mid", scale(4))}, data={"cast": cast}))


def test_what_viewers_say(server: Running, owned: Owned) -> None:
    async def said(*messages: str) -> list[str]:
        kinds: list[str] = []
        protocols = [websockets.Subprotocol("reina.v1")]
        async with websockets.connect(server.stream(owned.id), subprotocols=protocols) as socket:
            for message in messages:
                await socket.send(message)
            async for answer in socket:
                if isinstance(answer, str):
                    kinds.append(json.loads(answer)["type"])
                    if kinds[-1] == "pong":
                        break
        return kinds

    messages = (
        '{"type": "ping", "id": true}',
        '{"type": "ping", "id": "1"}',
        '{"type": "lead", "lead_s": true}',
    )
    kinds = asyncio.run(said(*messages, '{"type": "ping", "id": 1}'))
    assert kinds.count("error") == 3
