"""Where the server listens, and what is said when it cannot."""

from __future__ import annotations

import socket
from contextlib import closing

import pytest

from reina.cli.listening import listen
from reina.errors import InputError


def ports(sockets: list[socket.socket]) -> set[int]:
    found = {int(listening.getsockname()[1]) for listening in sockets}
    for listening in sockets:
        listening.close()
    return found


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "0.0.0.0"])
def test_a_free_port_is_one_port_on_every_address(host: str) -> None:
    [port] = ports(listen(host, 0))
    assert port > 0


def test_it_answers_at_once() -> None:
    [listening] = listen("127.0.0.1", 0)
    with closing(listening), socket.create_connection(listening.getsockname(), 2):
        pass


def test_a_port_that_was_just_left_can_be_had_again() -> None:
    [first] = listen("127.0.0.1", 0)
    port = first.getsockname()[1]
    with closing(first), socket.create_connection(first.getsockname(), 2):
        first.accept()[0].close()
    assert ports(listen("127.0.0.1", port)) == {port}


def test_a_port_in_use_is_told() -> None:
    [taken] = listen("127.0.0.1", 0)
    port = taken.getsockname()[1]
    with closing(taken), pytest.raises(InputError, match=rf"port {port} is in use.*--port"):
        listen("127.0.0.1", port)


@pytest.mark.parametrize(
    ("host", "port", "told"),
    [
        ("127.0.0.1", 70000, "ports are 0 to 65535, not 70000"),
        ("no-such-host.invalid", 0, "no address is known for the host 'no-such-host.invalid'"),
        ("192.0.2.1", 0, "this machine has no address 192.0.2.1"),
    ],
)
def test_an_address_that_cannot_be_is_told(host: str, port: int, told: str) -> None:
    with pytest.raises(InputError, match=told):
        listen(host, port)
