"""Where the laboratory is by itself."""

from __future__ import annotations

import socket
from contextlib import closing

import pytest

from reina.cli.listening import are_loopback, listen


@pytest.mark.parametrize(("host", "alone"), [("127.0.0.1", True), ("localhost", True), ("0.0.0.0", False)])
def test_what_listens_beyond_this_machine(host: str, alone: bool) -> None:
    sockets = listen(host, 0)
    try:
        assert are_loopback(sockets) is alone
    finally:
        for one in sockets:
            one.close()


def test_one_address_beyond_it_is_enough() -> None:
    with closing(socket.socket()) as one, closing(socket.socket()) as other:
        one.bind(("127.0.0.1", 0))
        other.bind(("0.0.0.0", 0))
        assert not are_loopback([one, other])
