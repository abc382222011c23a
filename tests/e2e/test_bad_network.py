"""The bad network of the browser tests: it carries what is sent, and leaves nothing behind."""

from __future__ import annotations

import gc
import socket
import socketserver
import struct
import threading
from contextlib import contextmanager
from typing import TYPE_CHECKING

from tests.e2e.bad_network import Weather, bad_network

if TYPE_CHECKING:
    from collections.abc import Generator

RESET = struct.pack("ii", 1, 0)
"""SO_LINGER of a socket that breaks its connection off instead of ending it."""


class Echo(socketserver.BaseRequestHandler):
    """Sends back what comes."""

    def handle(self) -> None:
        while sent := self.request.recv(4096):
            self.request.sendall(sent)


class Echoes(socketserver.ThreadingTCPServer):
    daemon_threads = True

    def handle_error(self, request: object, client_address: object) -> None:
        """Connections break here."""


@contextmanager
def echoes() -> Generator[str]:
    """The address of a server that sends back what comes."""
    with Echoes(("127.0.0.1", 0), Echo) as server:
        thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01})
        thread.start()
        yield f"http://127.0.0.1:{server.server_address[1]}"
        server.shutdown()
        thread.join()


def test_connections_that_break_leave_nothing_behind() -> None:
    sent = b"reina" * 4000
    with (
        echoes() as address,
        bad_network(address, Weather(delay_s=0.01, jitter_s=0.005, loss=0.0)) as network,
    ):
        host, port = network.address.removeprefix("http://").split(":")
        lines = [socket.create_connection((host, int(port)), timeout=30) for _ in range(6)]
        # More is on its way when a line is broken off, and when the network ends.
        for line in lines:
            line.sendall(2 * sent)
        for line in lines[:3]:
            assert line.recv(1)
            line.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, RESET)
            line.close()
        for line in lines[3:]:
            come = b""
            while len(come) < 2 * len(sent):
                come += line.recv(65536)
            assert come == 2 * sent
            line.sendall(sent)
    for line in lines:
        line.close()
    # What was left behind would be told here, as a warning.
    gc.collect()
