"""Where Prometheus reads the metrics: on a port of their own, which strangers do not reach."""

from __future__ import annotations

from prometheus_client import start_http_server

import reina.system.process_metrics  # pyright: ignore[reportUnusedImport]  # noqa: F401 - registers what is told of processes
from reina.cli.listening import explained
from reina.system.logs import logger
from reina.system.metrics import REGISTRY

METRICS_HOST = "127.0.0.1"

_log = logger(__name__)


def serve_metrics(host: str, port: int | None) -> None:
    """Answer at /metrics, on a thread of its own, until the process ends.

    Args:
        host: The address to listen on.
        port: 0 picks a free one, which the log says; None: nothing is answered.

    Raises:
        InputError: The port cannot be had there.
    """
    if port is None:
        return
    try:
        server, _ = start_http_server(port, host, REGISTRY)
    except (OSError, OverflowError) as error:
        raise explained(error, host, port, option="--metrics-port") from error
    _log.info("metrics", address=f"http://{host}:{server.server_port}/metrics")
