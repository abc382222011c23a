from __future__ import annotations

import json

import pytest
from pydantic import TypeAdapter, ValidationError

from reina.protocol.documentation import FROM_SERVER
from reina.protocol.links import session_links, stream_links
from reina.protocol.messages import Ping, Pong, ServerMessage, Transport, server_message
from reina.protocol.transport import Loop, TransportCommand


def test_each_message_is_told_by_its_type() -> None:
    types = [model.model_fields["type"].default for model in FROM_SERVER]
    assert len(set(types)) == len(types)
    assert set(types) == {
        "hello",
        "transport",
        "show_changed",
        "score_changed",
        "blocks_changed",
        "alignment_changed",
        "song_ready",
        "note_on",
        "note_off",
        "pong",
        "error",
    }


@pytest.mark.parametrize(
    "message",
    [
        Pong(id=7, server_time_s=12.5),
        Transport(
            playing=True,
            song_time_s=1.5,
            server_time_s=100.0,
            rate=0.5,
            loop=Loop(start_s=1.0, end_s=2.0),
            epoch=300,
        ),
    ],
)
def test_a_message_reads_back_as_it_was(message: ServerMessage) -> None:
    assert server_message.validate_json(message.model_dump_json()) == message


def test_numbers_that_json_has_not_are_never_sent() -> None:
    with pytest.raises(ValidationError):
        Pong(id=1, server_time_s=float("nan"))


@pytest.mark.parametrize(
    "text", ["", "null", "[]", '{"type": "ping"}', '{"id": 1}', '{"type": "ping", "id": 1, "x": 2}']
)
def test_a_ping_is_exactly_that(text: str) -> None:
    assert Ping.model_validate_json('{"type": "ping", "id": 1}').id == 1
    with pytest.raises(ValidationError):
        Ping.model_validate_json(text)


COMMANDS: TypeAdapter[TransportCommand] = TypeAdapter(TransportCommand)


@pytest.mark.parametrize(
    "command",
    [
        {"action": "play"},
        {"action": "pause"},
        {"action": "seek", "song_time_s": 3.5},
        {"action": "rate", "rate": 0.25},
        {"action": "loop", "start_s": 1.0, "end_s": 2.0},
        {"action": "loop", "start_s": None, "end_s": None},
        {"action": "loop"},
    ],
)
def test_commands_of_the_transport(command: dict[str, object]) -> None:
    assert COMMANDS.validate_python(command).model_dump(exclude_unset=True) == command


@pytest.mark.parametrize(
    "command",
    [
        {"action": "stop"},
        {"action": "seek"},
        {"action": "seek", "song_time_s": -0.1},
        {"action": "rate", "rate": 4.01},
        {"action": "loop", "start_s": 1.0},
        {"action": "play", "song_time_s": 1.0},
    ],
)
def test_commands_that_are_none(command: dict[str, object]) -> None:
    with pytest.raises(ValidationError):
        COMMANDS.validate_json(json.dumps(command))


def test_links_lead_where_the_routes_are() -> None:
    links = session_links("abc")
    assert links.stream == "/api/v1/sessions/abc/stream"
    assert links.page == "/s/abc"
    assert stream_links("abc", ["trumpet"]).rigs == {"trumpet": "/api/v1/rigs/trumpet"}
