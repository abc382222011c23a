"""What uvicorn is told, and what the protocols share."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import uvicorn

if TYPE_CHECKING:
    from reina.cli.connections import Connections

ACCEPTED_AT_ONCE = 32
"""Connections that are taken in before the event loop turns to others: some milliseconds."""


class Config(uvicorn.Config):
    """How it is served, with the connections that all protocols share.

    Args:
        app: What answers.
        connections: All connections.
        options: As uvicorn takes them.
    """

    def __init__(self, app: Any, connections: Connections, **options: Any) -> None:
        # Half of the time until the next ping, and half to answer it.
        silent_s = connections.limits.silent_s / 2
        super().__init__(
            app,
            ws_ping_interval=silent_s,
            ws_ping_timeout=silent_s,
            backlog=ACCEPTED_AT_ONCE,
            # `BehindProxies` sees to what stands before us; uvicorn believes everybody on this machine.
            proxy_headers=False,
            **options,
        )
        self.connections = connections


def connections_of(config: uvicorn.Config) -> Connections:
    """The connections that a protocol belongs to."""
    if not isinstance(config, Config):
        raise TypeError("these protocols are served with reina.cli.server_config.Config")
    return config.connections
