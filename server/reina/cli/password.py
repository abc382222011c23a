"""`reina password`: make a line for the file that says who may upload."""

from __future__ import annotations

import getpass
import sys
from typing import TYPE_CHECKING

from reina.api.accounts import SHORTEST_PASSWORD, is_name
from reina.system.passwords import hash_password

if TYPE_CHECKING:
    import argparse


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument(
        "--name", default=None, help="whose password it is; without it, everybody's who may upload"
    )


def run(arguments: argparse.Namespace) -> int:
    """Ask for a password, or read it from standard input, and print the line; returns the exit status."""
    name: str | None = arguments.name
    if name is not None and not is_name(name):
        print(
            f"reina password: a name has 1 to 64 letters, digits or any of . _ @ + -, not {name!r}",
            file=sys.stderr,
        )
        return 1
    asked = getpass.getpass("Password: ") if sys.stdin.isatty() else sys.stdin.readline().rstrip("\r\n")
    if len(asked) < SHORTEST_PASSWORD:
        print(f"reina password: it needs at least {SHORTEST_PASSWORD} characters", file=sys.stderr)
        return 1
    print(hash_password(asked) if name is None else f"{name}:{hash_password(asked)}")
    return 0
