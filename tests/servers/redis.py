"""A Redis of the tests' own: in a folder that is removed, on a socket in it, without a port."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
import time
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from tests.servers.find_servers import server_path

if TYPE_CHECKING:
    from collections.abc import Generator

PATIENCE_S = 30.0


@dataclass
class Redis:
    """A server that can be started and ended; nothing of it is kept.

    Attributes:
        folder: Holds its socket.
    """

    folder: Path
    _process: subprocess.Popen[bytes] | None = field(default=None, repr=False)

    @property
    def url(self) -> str:
        """Its address."""
        return f"unix://{self.folder}/socket"

    def start(self) -> None:
        """Start it, and wait until it answers."""
        command = [str(server_path("redis-server")), "--port", "0", "--save", "", "--dir", str(self.folder)]
        command += ["--unixsocket", str(self.folder / "socket")]
        with (self.folder / "log").open("a") as log:
            self._process = subprocess.Popen(command, stdout=log, stderr=log)
        until = time.monotonic() + PATIENCE_S
        while not (self.folder / "socket").exists():
            assert self._process.poll() is None, (self.folder / "log").read_text()
            assert time.monotonic() < until, "it does not answer"
            time.sleep(0.01)

    def stop(self) -> None:
        """End it at once, as a crash does: what it held is lost."""
        if self._process is not None:
            self._process.kill()
            self._process.wait(PATIENCE_S)
            self._process = None
            (self.folder / "socket").unlink(missing_ok=True)


@contextmanager
def redis_server() -> Generator[Redis]:
    """Run a server."""
    server = Redis(Path(tempfile.mkdtemp(prefix="reina-redis-", dir="/tmp")))
    try:
        server.start()
        yield server
    finally:
        server.stop()
        shutil.rmtree(server.folder, ignore_errors=True)
