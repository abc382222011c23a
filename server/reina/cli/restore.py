"""`reina restore FILE`: a data directory as it was backed up."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from reina.api.settings import Settings
from reina.errors import InputError
from reina.sessions.storage.restore import restore

if TYPE_CHECKING:
    import argparse

STANDARD_INPUT = Path("-")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument(
        "file", type=Path, metavar="FILE", help="what `reina backup` wrote; - is standard input"
    )
    parser.add_argument(
        "--data-dir",
        type=Path,
        default=None,
        help="where to: a directory that is not there yet, or empty; REINA_DATA_DIR, else data",
    )


def run(arguments: argparse.Namespace) -> int:
    """Restore it; return 1, with the reason on stderr, if it cannot be, and nothing is changed then."""
    data_dir: Path = arguments.data_dir or Settings().data_dir
    file: Path = arguments.file
    try:
        if file == STANDARD_INPUT:
            held = restore(sys.stdin.buffer, data_dir)
        else:
            with file.open("rb") as archive:
                held = restore(archive, data_dir)
    except (InputError, OSError) as error:
        reason = f"{error.filename or data_dir}: {error.strerror}" if isinstance(error, OSError) else error
        print(f"reina restore: {reason}", file=sys.stderr)
        return 1
    print(f"{len(held.files):,} files, as they were at {held.created_at}, in {data_dir}", file=sys.stderr)
    return 0
