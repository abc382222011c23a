"""Find the servers that tests start, and with --install make sure that they are there."""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

POSTGRESQL = Path("/usr/lib/postgresql")
"""Where Debian keeps PostgreSQL, a folder a version."""


class ServerNotFoundError(RuntimeError):
    """A server is not there, and could not be installed."""


def find_postgresql() -> Path | None:
    """The folder of PostgreSQL's programs, of the newest version; None without one."""
    versions = sorted(POSTGRESQL.glob("*/bin/initdb"), key=lambda path: int(path.parts[-3]))
    if versions:
        return versions[-1].parent
    found = shutil.which("initdb")
    return Path(found).resolve().parent if found else None


def find_program(name: str) -> Path | None:
    """A program on PATH, or where Debian keeps those of the administrator; None without it."""
    found = shutil.which(name) or shutil.which(name, path="/usr/sbin:/usr/local/sbin")
    return Path(found) if found else None


SERVERS: dict[str, Callable[[], Path | None]] = {
    "postgresql": find_postgresql,
    "nginx-light": partial(find_program, "nginx"),
    "caddy": partial(find_program, "caddy"),
    "redis-server": partial(find_program, "redis-server"),
}
"""Debian's package -> what finds the server that it brings."""
COMPOSE = "docker-compose"
"""Debian's package of Docker Compose, which reads compose files without an engine too."""


def find_compose() -> list[str] | None:
    """The command of Docker Compose: Docker's plugin, else the program of its own; None without either."""
    if shutil.which("docker") is not None:
        plugin = ["docker", "compose"]
        if subprocess.run([*plugin, "version"], capture_output=True, check=False).returncode == 0:
            return plugin
    program = shutil.which("docker-compose")
    return [program] if program is not None else None


def server_path(package: str) -> Path:
    """Where a server is.

    Raises:
        ServerNotFoundError: It is not there.
    """
    found = SERVERS[package]()
    if found is None:
        raise ServerNotFoundError(
            f"there is no {package}; run `make .venv/.servers`, or install Debian's package {package}"
        )
    return found


def install() -> None:
    """Install what is missing, where Debian's packages can be; nothing of it is started as a service."""
    missing = [package for package, find in SERVERS.items() if find() is None]
    if find_compose() is None:
        missing.append(COMPOSE)
    if not missing or shutil.which("apt-get") is None or os.geteuid() != 0:
        return
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive", "RUNLEVEL": "1"}
    packages = ["apt-get", "install", "--yes", "--no-install-recommends", *missing]
    for command in (["apt-get", "update"], packages):
        if subprocess.run(command, env=environment, check=False).returncode != 0:
            return


def main() -> int:
    """Print where the servers are; 1 when one is not there."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--install", action="store_true", help="install what is missing")
    if parser.parse_args().install:
        install()
    try:
        for package in SERVERS:
            print(server_path(package))
    except ServerNotFoundError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
