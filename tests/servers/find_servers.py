"""Find the servers that tests keep sessions in, and with --install make sure that they are there."""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
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


SERVERS: dict[str, Callable[[], Path | None]] = {"postgresql": find_postgresql}
"""Debian's package -> what finds the server that it brings."""


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
    """Install what is missing, where Debian's packages can be."""
    missing = [package for package, find in SERVERS.items() if find() is None]
    if not missing or shutil.which("apt-get") is None or os.geteuid() != 0:
        return
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    for command in (["apt-get", "update"], ["apt-get", "install", "-y", *missing]):
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
