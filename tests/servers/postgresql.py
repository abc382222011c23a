"""A PostgreSQL of the tests' own: in a folder that is removed, on a socket in it, without a port."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING
from uuid import uuid4

from tests.servers.find_servers import server_path

if TYPE_CHECKING:
    from collections.abc import Generator

USER = "reina"


@dataclass
class PostgreSQL:
    """A server that runs.

    Attributes:
        programs: The folder of its programs.
        folder: Holds its data and its socket.
        options: What it is started with.
    """

    programs: Path
    folder: Path
    options: tuple[str, ...]

    def database(self) -> str:
        """The address of a new, empty database."""
        name = f"d{uuid4().hex}"
        self._run("createdb", "-h", str(self.folder), "-U", USER, name)
        return f"postgresql+psycopg://{USER}@/{name}?host={self.folder}"

    def sql(self, url: str, statement: str) -> str:
        """Run a statement on a database; returns what it gives, a row a line."""
        name = url.rpartition("/")[0] and url.split("@/")[1].split("?")[0]
        command = ("psql", "-h", str(self.folder), "-U", USER, "-d", name, "-Atqc", statement)
        return self._run(*command)

    def start(self) -> None:
        """Start it, and wait until it answers."""
        options = " ".join(("-c listen_addresses=", f"-k {self.folder}", *self.options))
        log = self.folder / "log"
        self._run("pg_ctl", "start", "-w", "-D", str(self.folder / "data"), "-l", str(log), "-o", options)

    def stop(self) -> None:
        """End it at once, as a crash does."""
        self._run("pg_ctl", "stop", "-D", str(self.folder / "data"), "-m", "immediate")

    def initialize(self) -> None:
        """Make its data."""
        self._run("initdb", "-D", str(self.folder / "data"), "-U", USER, "-A", "trust", "-E", "UTF8", "-N")

    def _run(self, program: str, *arguments: str) -> str:
        command = [str(self.programs / program), *arguments]
        if os.geteuid() == 0:
            # PostgreSQL does not run as root.
            command = ["runuser", "-u", "postgres", "--", *command]
        # What it starts would hold a pipe open.
        with tempfile.TemporaryFile("w+") as said:
            status = subprocess.run(
                command, cwd="/", stdin=subprocess.DEVNULL, stdout=said, stderr=said, check=False
            ).returncode
            said.seek(0)
            output = said.read()
        assert status == 0, f"{program} failed: {output}"
        return output


@contextmanager
def postgresql(*, fsync: bool = False) -> Generator[PostgreSQL]:
    """Run a server.

    Args:
        fsync: Whether it waits for the disk, which no test here can see.
    """
    folder = Path(tempfile.mkdtemp(prefix="reina-postgresql-", dir="/tmp"))
    options = () if fsync else ("-c fsync=off",)
    server = PostgreSQL(server_path("postgresql"), folder, options)
    try:
        if os.geteuid() == 0:
            shutil.chown(folder, "postgres", "postgres")
        server.initialize()
        server.start()
        try:
            yield server
        finally:
            server.stop()
    finally:
        shutil.rmtree(folder, ignore_errors=True)
