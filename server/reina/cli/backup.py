"""`reina backup FILE`: a copy of what a data directory keeps, while the server runs."""

from __future__ import annotations

import gzip
import secrets
import sys
from pathlib import Path
from typing import TYPE_CHECKING, cast

from reina.api.settings import Settings
from reina.errors import InputError
from reina.sessions.storage.backup import BackedUp, back_up
from reina.system.durable import open_own, put_in_place

if TYPE_CHECKING:
    import argparse
    from typing import IO

STANDARD_OUTPUT = Path("-")
PACKED = frozenset({".gz", ".tgz"})
QUICKLY = 1
"""Sound hardly shrinks, the database does by any level."""
WITHOUT_DATABASE = (
    "there is no database in it: where sessions are kept in PostgreSQL, back that up by pg_dump, before this"
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the command takes."""
    parser.add_argument(
        "file",
        type=Path,
        metavar="FILE",
        help="where to write it: .tar, or packed .tar.gz; - is standard output",
    )
    parser.add_argument(
        "--data-dir", type=Path, default=None, help="what is backed up; REINA_DATA_DIR, else data"
    )


def run(arguments: argparse.Namespace) -> int:
    """Write the backup; return 1, with the reason on stderr, if it cannot be made or is of damaged files."""
    data_dir: Path = arguments.data_dir or Settings().data_dir
    file: Path = arguments.file
    try:
        made = back_up(data_dir, sys.stdout.buffer) if file == STANDARD_OUTPUT else _write(data_dir, file)
    except (InputError, OSError) as error:
        reason = f"{error.filename or file}: {error.strerror}" if isinstance(error, OSError) else error
        print(f"reina backup: {reason}", file=sys.stderr)
        return 1
    print(f"{made.files:,} files, {made.size / 1e6:,.1f} MB, of {data_dir}", file=sys.stderr)
    if not made.has_database and not (data_dir / "sessions").is_dir():
        print(f"reina backup: {WITHOUT_DATABASE}", file=sys.stderr)
    for name in made.damaged:
        print(f"reina backup: {name} is damaged in the data directory itself", file=sys.stderr)
    return 1 if made.damaged else 0


def _write(data_dir: Path, file: Path) -> BackedUp:
    """Write a file that is there as a whole or not at all."""
    draft = file.with_name(f".{file.name}.{secrets.token_hex(4)}")
    try:
        with open_own(draft) as written:
            if file.suffix.lower() in PACKED:
                with gzip.GzipFile(fileobj=written, mode="wb", compresslevel=QUICKLY) as packed:
                    made = back_up(data_dir, cast("IO[bytes]", packed))
            else:
                made = back_up(data_dir, written)
        put_in_place(draft, file)
    finally:
        draft.unlink(missing_ok=True)
    return made
