"""`reina serve`: start the server and print its address."""

from __future__ import annotations

import argparse
import asyncio
import contextlib
import gc
import os
import signal
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import uvicorn

from reina.api.app import create_app
from reina.api.http.proxies import TrustedProxies
from reina.api.http.rates import Rates
from reina.api.settings import (
    days,
    require_blocks_origin,
    require_page,
    require_scheduler,
    require_shared,
    require_sign_in,
    require_writable,
    settings_of,
)
from reina.cli.connection_limits import ConnectionLimits, raise_file_limit
from reina.cli.connections import Connections
from reina.cli.environment import switch
from reina.cli.http_protocol import ProblemProtocol
from reina.cli.kept import open_storage
from reina.cli.listening import BACKLOG, are_loopback, listen
from reina.cli.metrics import METRICS_HOST, serve_metrics
from reina.cli.server_config import Config
from reina.cli.websocket_protocol import TextProtocol
from reina.errors import InputError
from reina.sessions.sightings import DAY_S
from reina.sessions.stage import Stage
from reina.sessions.storage.directory_lock import locked
from reina.sound.font import SoundError
from reina.sound.provide_soundfont import provide_soundfont
from reina.system.heap import return_large_blocks
from reina.system.logs import configure
from reina.system.resources import default_data_dir

if TYPE_CHECKING:
    import socket
    from collections.abc import Generator, Sequence

    from reina.api.http.ending import Ending
    from reina.api.settings import Settings

HOST = "127.0.0.1"
PORT = 8000
EVERY_ADDRESS = frozenset({"0.0.0.0", "::"})  # noqa: S104 - told apart, not bound to
LOOKING_S = 0.1
"""How often it is looked whether a second signal has come."""
CLOSING_S = 3
"""How long streams and downloads that are under way may take to end."""
LARGEST_MESSAGE = 64 * 1024
"""Bytes of one message from a viewer, who has little to say."""
SWITCH_S = 0.0005
"""How long a thread that computes may keep the event loop waiting at a time; Python's own choice is ten times
it, and the loop waits anew after every frame that it sends."""
NO_FILES = "socket.accept() out of system resource"
"""How asyncio tells that no file is left for who comes; it tries again a second later."""
SELDOM = 1000
"""Collections of the middle generation for one of all objects, in which everything stands still."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes; each is also read from the environment."""
    environment = os.environ
    parser.add_argument(
        "--host", default=environment.get("REINA_HOST", HOST), help=f"address to listen on ({HOST})"
    )
    parser.add_argument(
        "--port",
        type=int,
        # A text is held to the type as if it had been given.
        default=environment.get("REINA_PORT", str(PORT)),
        help=f"port to listen on; 0 picks a free one ({PORT})",
    )
    parser.add_argument(
        "--data-dir",
        type=Path,
        default=None,
        help=f"where sessions are kept ({str(default_data_dir()).replace('%', '%%')})",
    )
    add_database_argument(parser)
    parser.add_argument(
        "--bus",
        default=None,
        metavar="URL",
        help="Redis that connects servers which serve the same sessions, redis://host:6379 (there is one "
        "server alone)",
    )
    parser.add_argument(
        "--allow-host",
        action="append",
        default=environment.get("REINA_ALLOW_HOST", "").split(),
        metavar="NAME",
        help="a host name to answer to, beside localhost; may be repeated",
    )
    parser.add_argument(
        "--allow-origin",
        action="append",
        default=environment.get("REINA_ALLOW_ORIGIN", "").split(),
        metavar="ORIGIN",
        help="an origin whose pages may write and watch, beside the server's own; may be repeated",
    )
    parser.add_argument(
        "--trusted-proxy",
        action="append",
        default=environment.get("REINA_TRUSTED_PROXY", "").split(),
        metavar="ADDRESS",
        help="a proxy's address or network (10.0.0.0/8) that is believed who asks; may be repeated",
    )
    parser.add_argument(
        "--lab",
        action=argparse.BooleanOptionalAction,
        default=None,
        help="answer at /lab and under /api/v1/lab (only where it listens on this machine's own address)",
    )
    parser.add_argument(
        "--metrics-port",
        type=int,
        default=environment.get("REINA_METRICS_PORT"),
        metavar="PORT",
        help="answer to Prometheus there, at /metrics; not at all by default",
    )
    parser.add_argument(
        "--metrics-host",
        default=environment.get("REINA_METRICS_HOST", METRICS_HOST),
        metavar="HOST",
        help=f"address to answer to Prometheus on ({METRICS_HOST}); whoever reaches it reads all metrics",
    )
    parser.add_argument(
        "--log-requests",
        action=argparse.BooleanOptionalAction,
        default=switch("REINA_LOG_REQUESTS") or False,
        help="write a line into the log for each request (--no-log-requests)",
    )
    parser.add_argument(
        "--drain",
        type=float,
        default=environment.get("REINA_DRAIN_S", "0"),
        metavar="SECONDS",
        help="go on answering for so long after SIGTERM, while /api/v1/health/ready says 503 (0)",
    )
    parser.add_argument(
        "--end-unseen",
        default=None,
        metavar="DAYS",
        help="end sessions that nobody has seen for so many days; 0 for never (0)",
    )
    parser.add_argument(
        "--scheduler",
        default=None,
        metavar="URL",
        help="a Dask scheduler, tcp://host:8786, on whose workers songs are rendered and put in time (here)",
    )
    parser.add_argument(
        "--no-page", action="store_true", help="serve the API alone, whether the page is built or not"
    )


def add_database_argument(parser: argparse.ArgumentParser) -> None:
    """Declare the option that names the database."""
    parser.add_argument(
        "--database",
        default=None,
        metavar="URL",
        help="PostgreSQL to keep sessions in, postgresql+psycopg://user:password@host/name (SQLite in the "
        "data directory)",
    )


def run(arguments: argparse.Namespace) -> int:
    """Serve until SIGINT or SIGTERM; returns the exit status.

    What keeps the server from starting is told in a line on standard error, with status 1.
    """
    with contextlib.ExitStack() as held:
        # What is written is for nobody else to read.
        held.callback(os.umask, os.umask(0o077))
        return _run(arguments, held)


def _run(arguments: argparse.Namespace, held: contextlib.ExitStack) -> int:
    try:
        configure()
        settings = _settings(arguments)
        lab = switch("REINA_LAB") if arguments.lab is None else arguments.lab
        proxies = TrustedProxies.named(settings.trusted_proxies)
        # What is wrong is told before anything listens.
        Rates.named(settings.rates)
        connections = Connections(ConnectionLimits.of_environment(raise_file_limit()), proxies)
        if not arguments.no_page:
            require_page(settings)
        require_writable(settings.data_dir)
        require_sign_in(settings)
        require_blocks_origin(settings)
        require_shared(settings)
        require_scheduler(settings)
        held.enter_context(locked(settings.data_dir))
        _provide_soundfont(settings)
        stage = _stage(settings)
        sockets = listen(arguments.host, arguments.port)
        serve_metrics(arguments.metrics_host, arguments.metrics_port)
        settings = replace(settings, lab=are_loopback(sockets) if lab is None else lab)
        storage = open_storage(settings)
        held.callback(storage.close)
    except InputError as error:
        print(f"reina serve: {error}", file=sys.stderr)
        return 1
    share_interpreter()
    return_large_blocks()
    app = create_app(settings, stage=stage, storage=storage)
    server = Server(
        Config(
            app,
            connections,
            http=ProblemProtocol,
            ws=TextProtocol,
            # Deflate saves 3 % of the frames' bytes at ten times the cost.
            ws_per_message_deflate=False,
            ws_max_size=LARGEST_MESSAGE,
            timeout_graceful_shutdown=CLOSING_S,
            log_config=None,
            log_level="warning",
            access_log=False,
            server_header=False,
        ),
        app.state.ending,
        connections,
        drain_s=arguments.drain,
    )
    server.run(sockets)
    return 0 if server.started else 1


def share_interpreter() -> None:
    """Let the event loop have the interpreter's lock, and keep it from being held up by the collector."""
    sys.setswitchinterval(SWITCH_S)
    gc.collect()
    # What is loaded by now stays: nothing of it is ever looked through again.
    gc.freeze()
    young, middle, _ = gc.get_threshold()
    gc.set_threshold(young, middle, SELDOM)


def _settings(arguments: argparse.Namespace) -> Settings:
    settings = settings_of(arguments.data_dir, arguments.database)
    if arguments.end_unseen is not None:
        settings = replace(settings, end_unseen_s=days(arguments.end_unseen) * DAY_S)
    if arguments.scheduler is not None:
        settings = replace(settings, scheduler=arguments.scheduler)
    hosts = {*settings.allowed_hosts, *(name.lower() for name in arguments.allow_host)}
    if arguments.host not in EVERY_ADDRESS:
        hosts.add(arguments.host.lower())
    return replace(
        settings,
        allowed_hosts=frozenset(hosts),
        allowed_origins=frozenset(arguments.allow_origin),
        bus=settings.bus if arguments.bus is None else arguments.bus,
        page=not arguments.no_page,
        log_requests=arguments.log_requests,
        trusted_proxies=tuple(arguments.trusted_proxy),
    )


def _provide_soundfont(settings: Settings) -> None:
    """See that scores can be heard; a server that cannot have them heard starts, and says so."""
    try:
        provide_soundfont(settings.data_dir, tell=_tell)
    except SoundError as error:
        _tell(f"pieces without a recording will have no sound: {error}")


def _tell(line: str) -> None:
    print(f"reina serve: {line}", file=sys.stderr, flush=True)


def _stage(settings: Settings) -> Stage:
    try:
        return Stage.load(settings.rigs_dir)
    except InputError as error:
        raise InputError(
            f"the rigs in {settings.rigs_dir} cannot be used: {error}; they come with Reina, "
            "and REINA_RIGS names another folder"
        ) from error


class Server(uvicorn.Server):
    """Prints its address once it answers, and takes a signal for a request, not for a failure.

    Args:
        config: How it serves.
        ending: Hears when it ends.
        connections: All connections.
        drain_s: How long it still answers after a signal, while it says that it is not ready, seconds.
    """

    def __init__(
        self,
        config: uvicorn.Config,
        ending: Ending,
        connections: Connections,
        *,
        drain_s: float = 0.0,
    ) -> None:
        super().__init__(config)
        self._drain_s = drain_s
        self._ending = ending
        self._connections = connections

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Listen, then say where."""
        asyncio.get_running_loop().set_exception_handler(self._failed)
        await super().startup(sockets)
        for listening in sockets or []:
            # How many may wait to be taken in, however few are taken in at once.
            listening.listen(BACKLOG)
        for listening in self.servers[:1]:
            host, port = listening.sockets[0].getsockname()[:2]
            shown = "localhost" if host in EVERY_ADDRESS else host
            print(f"http://[{shown}]:{port}" if ":" in shown else f"http://{shown}:{port}", flush=True)

    async def on_tick(self, counter: int) -> bool:
        """See to the connections that keep us waiting, ten times a second a tenth of them."""
        self._connections.sweep(asyncio.get_running_loop().time())
        return await super().on_tick(counter)

    def _failed(self, loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        """What fails outside of any task; where files run out, one connection makes room for the next."""
        if context["message"] == NO_FILES:
            self._connections.make_room()
        else:
            loop.default_exception_handler(context)

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Tell whoever still sends or waits, and end."""
        await self._drain()
        self._ending.begin()
        await super().shutdown(sockets)

    async def _drain(self) -> None:
        """Answer on, not ready, so that a load balancer sends nobody any more; a second SIGINT ends it."""
        self._ending.announced = True
        until = time.monotonic() + self._drain_s
        while time.monotonic() < until and not self.force_exit:  # noqa: ASYNC110 - uvicorn's own flag
            await asyncio.sleep(min(LOOKING_S, self._drain_s))

    @contextlib.contextmanager
    def capture_signals(self) -> Generator[None]:
        """End on SIGINT and SIGTERM with status 0, where uvicorn would raise the signal again at the end."""
        handled = (signal.SIGINT, signal.SIGTERM)
        before = {number: signal.signal(number, self.handle_exit) for number in handled}
        try:
            yield
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command alone."""
    parser = argparse.ArgumentParser(prog="reina serve", description=__doc__)
    add_arguments(parser)
    return run(parser.parse_args(argv))
