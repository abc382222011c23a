"""`reina migrate`: take over what an earlier version kept."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from reina.api.settings import require_writable, settings_of
from reina.cli.kept import take_over_told
from reina.errors import InputError
from reina.sessions.storage.directory_lock import locked
from reina.sessions.storage.session_storage import SessionStorage

if TYPE_CHECKING:
    import argparse


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes; each is also read from the environment."""
    parser.add_argument("--data-dir", type=Path, default=None, help="where sessions are kept (data)")
    parser.add_argument("--database", default=None, metavar="URL", help="as of `reina serve`")


def run(arguments: argparse.Namespace) -> int:
    """Take over; returns 0 when nothing stays behind, else 1."""
    try:
        settings = settings_of(arguments.data_dir, arguments.database)
        require_writable(settings.data_dir)
        with locked(settings.data_dir):
            storage = SessionStorage.open(settings.data_dir, settings.database, settings.files)
            try:
                outcome = take_over_told(storage)
            finally:
                storage.close()
    except InputError as error:
        print(f"reina migrate: {error}", file=sys.stderr)
        return 1
    print(f"{outcome.taken} sessions taken over, {len(outcome.left)} left")
    return int(bool(outcome.left))
