"""Where the server listens: bound before anything else is set up, so that what is wrong is told in a line."""

from __future__ import annotations

import errno
import ipaddress
import socket
from typing import TYPE_CHECKING

from reina.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterable

BACKLOG = 2048
UNSENT_BYTES = 64 * 1024
"""What the system takes over of a connection's data before it can be sent. Without this bound it grows to
megabytes, half a minute of frames that a slow viewer would have to read before it came to the present."""


def listen(host: str, port: int) -> list[socket.socket]:
    """Sockets that listen on every address of a host.

    Args:
        host: A name or an address.
        port: 0 picks a free one, the same for all of them.

    Raises:
        InputError: The host has no address here, or the port cannot be had.
    """
    if not 0 <= port <= 65535:
        raise _no_port(port, "--port")
    try:
        found = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)
    except socket.gaierror as error:
        raise InputError(f"no address is known for the host {host!r}; try --host 127.0.0.1") from error
    sockets: list[socket.socket] = []
    for family, kind, protocol, _, address in dict.fromkeys(found):
        taken = sockets[0].getsockname()[1] if sockets else port
        try:
            sockets.append(_bound(family, kind, protocol, (address[0], taken, *address[2:])))
        except OSError as error:
            # A machine without IPv6 still resolves `localhost` to ::1.
            if error.errno in (errno.EADDRNOTAVAIL, errno.EAFNOSUPPORT) and len(found) > 1:
                continue
            for opened in sockets:
                opened.close()
            raise explained(error, host, port) from error
    if not sockets:
        raise InputError(f"this machine has no address of the host {host!r}; try --host 127.0.0.1")
    return sockets


def are_loopback(sockets: Iterable[socket.socket]) -> bool:
    """Whether only this machine can reach what listens there."""
    return all(ipaddress.ip_address(one.getsockname()[0]).is_loopback for one in sockets)


def _bound(family: int, kind: int, protocol: int, address: tuple[str | int, ...]) -> socket.socket:
    listening = socket.socket(family, kind, protocol)
    try:
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        if hasattr(socket, "TCP_NOTSENT_LOWAT"):
            # Those who are accepted inherit it.
            listening.setsockopt(socket.IPPROTO_TCP, socket.TCP_NOTSENT_LOWAT, UNSENT_BYTES)
        if family == socket.AF_INET6:
            listening.setsockopt(socket.IPPROTO_IPV6, socket.IPV6_V6ONLY, 1)
        listening.bind(address)
        # Two that share an address find out here at the latest.
        listening.listen(BACKLOG)
    except OSError:
        listening.close()
        raise
    return listening


def _no_port(port: int, option: str) -> InputError:
    return InputError(f"ports are 0 to 65535, not {port}; choose another with {option}")


def explained(error: OSError | OverflowError, host: str, port: int, *, option: str = "--port") -> InputError:
    """Why nothing can listen there, and what would help.

    Args:
        error: What the system says.
        host: The host that was asked for.
        port: The port that was asked for.
        option: What chooses another.
    """
    if isinstance(error, OverflowError):
        return _no_port(port, option)
    reasons = {
        errno.EADDRINUSE: f"port {port} is in use: stop what listens there, or choose another with {option} "
        "(0 picks a free one)",
        errno.EACCES: f"port {port} needs more rights than this user has: choose one from 1024 on "
        f"by {option}",
        errno.EADDRNOTAVAIL: f"this machine has no address {host}; "
        f"try {option.replace('port', 'host')} 127.0.0.1",
    }
    return InputError(
        reasons.get(error.errno or 0, f"cannot listen on {host}, port {port}: {error.strerror}")
    )
