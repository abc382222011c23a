"""Where the server would listen."""

from __future__ import annotations

import http.client
import json
from typing import TYPE_CHECKING, Any

from reina.cli.doctor.finding import fail, ok, warn
from reina.cli.listening import are_loopback, listen
from reina.errors import InputError
from reina.protocol.links import API

if TYPE_CHECKING:
    from collections.abc import Iterator

    from reina.cli.doctor.finding import Finding

ASKING_S = 3.0
HERE = {"0.0.0.0": "127.0.0.1", "::": "::1"}  # noqa: S104 - told apart, not bound to
LONGEST_ANSWER = 100_000


def network_checks(host: str, port: int) -> Iterator[Finding]:
    """Whether the port is free, or whose it is, and who could reach it."""
    where = f"{host}, port {port}"
    try:
        sockets = listen(host, port)
    except InputError as error:
        version = running_version(HERE.get(host, host), port)
        if version is not None:
            yield ok("port", f"Reina {version} answers on {where}")
        else:
            yield fail("port", str(error), "something else listens there, or this address cannot be had")
        return
    try:
        yield ok("port", f"{where} is free")
        addresses = ", ".join(sorted({one.getsockname()[0] for one in sockets}))
        if are_loopback(sockets):
            yield ok("addresses", f"{addresses}: this machine alone reaches it")
        else:
            yield warn(
                "addresses",
                f"{addresses}: other machines reach it",
                "put a proxy with TLS in front of it where they are not all yours (docs/proxy.md)",
            )
    finally:
        for one in sockets:
            one.close()


def running_version(host: str, port: int) -> str | None:
    """The version of the Reina that answers there; None if nobody answers, or somebody else."""
    connection = http.client.HTTPConnection(host, port, timeout=ASKING_S)
    try:
        connection.request("GET", f"{API}/health", headers={"Host": "localhost"})
        health: Any = json.loads(connection.getresponse().read(LONGEST_ANSWER))
        version = health["version"] if "reina.v1" in health["streams"] else None
    except (OSError, http.client.HTTPException, ValueError, LookupError, TypeError):
        return None
    else:
        return version if isinstance(version, str) else None
    finally:
        connection.close()
