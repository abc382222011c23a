"""`reina serve`: start the server and print its address."""

from __future__ import annotations

import argparse
import contextlib
import gc
import logging
import os
import signal
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import uvicorn

from reina.api.app import create_app
from reina.api.settings import require_page, require_writable, settings_of
from reina.cli.http_protocol import ProblemProtocol
from reina.cli.kept import open_storage
from reina.cli.listening import are_loopback, listen
from reina.cli.websocket_protocol import TextProtocol
from reina.errors import InputError
from reina.sessions.stage import Stage
from reina.sessions.storage.directory_lock import locked

if TYPE_CHECKING:
    import socket
    from collections.abc import Generator, Sequence

    from reina.api.http.ending import Ending
    from reina.api.settings import Settings

HOST = "127.0.0.1"
PORT = 8000
EVERY_ADDRESS = frozenset({"0.0.0.0", "::"})  # noqa: S104 - told apart, not bound to
CLOSING_S = 3
"""How long streams and downloads that are under way may take to end."""
LARGEST_MESSAGE = 64 * 1024
"""Bytes of one message from a viewer, who has little to say."""
SWITCH_S = 0.0005
"""How long a thread that computes may keep the event loop waiting at a time; Python's own choice is ten times
it, and the loop waits anew after every frame that it sends."""
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
    parser.add_argument("--data-dir", type=Path, default=None, help="where sessions are kept (data)")
    add_database_argument(parser)
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
        "--lab",
        action=argparse.BooleanOptionalAction,
        default=_switch(environment.get("REINA_LAB", "")),
        help="answer at /lab and under /api/v1/lab (only where it listens on this machine's own address)",
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


def _switch(text: str) -> bool | None:
    """A switch in the environment: 1 or 0; else it is as by default."""
    return {"1": True, "0": False}.get(text.strip())


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
        settings = _settings(arguments)
        if not arguments.no_page:
            require_page(settings)
        require_writable(settings.data_dir)
        held.enter_context(locked(settings.data_dir))
        stage = _stage(settings)
        sockets = listen(arguments.host, arguments.port)
        settings = replace(settings, lab=are_loopback(sockets) if arguments.lab is None else arguments.lab)
        storage = open_storage(settings)
        held.callback(storage.close)
    except InputError as error:
        print(f"reina serve: {error}", file=sys.stderr)
        return 1
    share_interpreter()
    logging.basicConfig(level=logging.INFO, format="%(levelname)s %(name)s: %(message)s", stream=sys.stderr)
    # A viewer that goes in the middle of some frames is no news.
    logging.getLogger("asyncio").setLevel(logging.ERROR)
    app = create_app(settings, stage=stage, storage=storage)
    server = Server(
        uvicorn.Config(
            app,
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
    hosts = {*settings.allowed_hosts, *(name.lower() for name in arguments.allow_host)}
    if arguments.host not in EVERY_ADDRESS:
        hosts.add(arguments.host.lower())
    return replace(
        settings,
        allowed_hosts=frozenset(hosts),
        allowed_origins=frozenset(arguments.allow_origin),
    )


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
    """

    def __init__(self, config: uvicorn.Config, ending: Ending) -> None:
        super().__init__(config)
        self._ending = ending

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Listen, then say where."""
        await super().startup(sockets)
        for listening in self.servers[:1]:
            host, port = listening.sockets[0].getsockname()[:2]
            shown = "localhost" if host in EVERY_ADDRESS else host
            print(f"http://[{shown}]:{port}" if ":" in shown else f"http://{shown}:{port}", flush=True)

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Tell whoever still sends or waits, and end."""
        self._ending.begin()
        await super().shutdown(sockets)

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
